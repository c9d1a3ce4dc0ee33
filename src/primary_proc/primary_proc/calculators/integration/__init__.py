# SPDX-License-Identifier: Apache-2.0
"""Sums over the pulses of a burst: their laws, thresholds, required signals."""
