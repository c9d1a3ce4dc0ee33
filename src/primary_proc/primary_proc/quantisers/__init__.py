# SPDX-License-Identifier: Apache-2.0
"""What stands between normalised cells and a detector."""
