# SPDX-License-Identifier: Apache-2.0
"""DDS as the ROS 2 middleware rmw_cyclonedds uses it, on the cyclonedds package."""
