# SPDX-License-Identifier: Apache-2.0
"""From bursts to plots."""
