# SPDX-License-Identifier: Apache-2.0
"""The ROS 2 client library, messages and command line for machines without ROS 2.

Python reads this package at every start-up (see :mod:`ros2_embedded.activation`), so it
imports nothing.
"""
