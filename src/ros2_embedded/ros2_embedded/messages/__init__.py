# SPDX-License-Identifier: Apache-2.0
"""ROS 2 message and service types: definitions, classes, serialisation, import."""
