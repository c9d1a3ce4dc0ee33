# SPDX-License-Identifier: Apache-2.0
"""What the nodes of the package have in common."""
