# SPDX-License-Identifier: Apache-2.0
"""Emitters located from bearings that a moving observer takes."""

from __future__ import annotations

from bearing_tracker.emitters.filters import DEFAULT_FILTER, FILTERS
from bearing_tracker.emitters.interface import (
    Belief,
    CorrelatedError,
    EmitterFilter,
    Estimate,
    Expected,
    FilterSettings,
    Prior,
)

__all__ = [
    "DEFAULT_FILTER",
    "FILTERS",
    "Belief",
    "CorrelatedError",
    "EmitterFilter",
    "Estimate",
    "Expected",
    "FilterSettings",
    "Prior",
]
