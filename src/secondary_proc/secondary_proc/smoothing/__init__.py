# SPDX-License-Identifier: Apache-2.0
"""Filters of position and velocity, by the name that the parameter `smoother` gives them."""

from __future__ import annotations

from collections.abc import Callable

from secondary_proc.smoothing.alpha_beta import AlphaBetaSmoother
from secondary_proc.smoothing.interface import Measured, Smoothed, Smoother, joseph_update
from secondary_proc.smoothing.kalman import KalmanSmoother

SMOOTHERS: dict[str, Callable[[float, float, float], Smoother]] = {
    "kalman": lambda quiet, manoeuvre, period: KalmanSmoother(
        quiet**2 * period, manoeuvre**2 * period
    ),
    "alpha_beta": lambda quiet, manoeuvre, period: AlphaBetaSmoother(quiet, quiet**2 * period),
}

__all__ = ["SMOOTHERS", "Measured", "Smoothed", "Smoother", "joseph_update"]
