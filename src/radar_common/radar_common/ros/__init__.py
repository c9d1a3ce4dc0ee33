# SPDX-License-Identifier: Apache-2.0
"""The part of the contract that needs ROS: messages, QoS, parameters, diagnostics."""
