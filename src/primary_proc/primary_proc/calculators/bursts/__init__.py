# SPDX-License-Identifier: Apache-2.0
"""Detectors on bits: how often noise and targets start a burst."""
