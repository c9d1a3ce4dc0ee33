# SPDX-License-Identifier: Apache-2.0
"""The place of parameter clients, not offered."""

raise NotImplementedError("parameter clients are not offered by ros2_embedded")
