# SPDX-License-Identifier: Apache-2.0
"""The place of the type description service, not offered."""

raise NotImplementedError("the type description service is not offered by ros2_embedded")
