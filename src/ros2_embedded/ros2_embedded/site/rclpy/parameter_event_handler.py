# SPDX-License-Identifier: Apache-2.0
"""The place of parameter event handlers, not offered."""

raise NotImplementedError("parameter event handlers are not offered by ros2_embedded")
