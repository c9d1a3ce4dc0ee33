# SPDX-License-Identifier: Apache-2.0
"""Noise levels that are estimated: their thresholds and losses."""
