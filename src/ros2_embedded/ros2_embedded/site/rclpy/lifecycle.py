# SPDX-License-Identifier: Apache-2.0
"""The place of lifecycle nodes, which are not offered."""

raise NotImplementedError("lifecycle nodes are not offered by ros2_embedded")
