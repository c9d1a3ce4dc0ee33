# SPDX-License-Identifier: Apache-2.0
"""The place of waitables, which are not offered."""

raise NotImplementedError("waitables are not offered by ros2_embedded")
