# SPDX-License-Identifier: Apache-2.0
"""The place of service introspection, not offered."""

raise NotImplementedError("service introspection is not offered by ros2_embedded")
