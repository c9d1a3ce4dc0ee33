# SPDX-License-Identifier: Apache-2.0
"""The place of waitables, not offered."""

raise NotImplementedError("waitables: not offered by ros2_embedded")
