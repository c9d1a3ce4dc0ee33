# SPDX-License-Identifier: Apache-2.0
"""Ways to find the azimuth of a burst."""
