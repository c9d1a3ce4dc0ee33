# SPDX-License-Identifier: Apache-2.0
"""Burst detectors with streaming state."""
