# SPDX-License-Identifier: Apache-2.0
"""The `ros2` command of the embedded runtime: one module a verb, written against rclpy alone."""
