# SPDX-License-Identifier: Apache-2.0
"""The sliding-window detectors by name."""

from __future__ import annotations

from primary_proc.methods.amplitude_window import (
    AmplitudeMethod,
    fast_scores,
    likelihood_scores,
    linear_scores,
    square_scores,
)
from primary_proc.methods.binary_window import CountMethod, WeightedCountMethod
from primary_proc.methods.detection_method import DetectionMethod
from primary_proc.methods.level_window import MultiLevelMethod

_LIKELIHOOD_CHANNELS = 2

WINDOW_METHODS: dict[str, DetectionMethod] = {
    "count": CountMethod(),
    "weighted-count": WeightedCountMethod(),
    "weight-peak": WeightedCountMethod(first_peak=True),
    "multi-level": MultiLevelMethod(),
    "likelihood": AmplitudeMethod(likelihood_scores, _LIKELIHOOD_CHANNELS),
    "linear-sum": AmplitudeMethod(linear_scores),
    "square-sum": AmplitudeMethod(square_scores),
    "fast-fluctuation": AmplitudeMethod(fast_scores),
}
"""Counts and weighted sums of ones, of levels, and of functions of the envelope."""
