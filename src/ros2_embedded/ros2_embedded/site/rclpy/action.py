# SPDX-License-Identifier: Apache-2.0
"""The place of actions, which are not offered."""

raise NotImplementedError("actions are not offered by ros2_embedded")
