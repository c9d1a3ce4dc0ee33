# SPDX-License-Identifier: Apache-2.0
"""Filters of position and velocity, by the name that the parameter `smoother` gives them."""

from __future__ import annotations

from collections.abc import Callable

from secondary_proc.motion import noise_density
from secondary_proc.smoothing.alpha_beta import AlphaBetaSmoother
from secondary_proc.smoothing.interface import Measured, Smoothed, Smoother, joseph_update
from secondary_proc.smoothing.kalman import KalmanSmoother

SMOOTHERS: dict[str, Callable[[float, float], Smoother]] = {
    "kalman": lambda quiet, manoeuvre: KalmanSmoother(
        noise_density(quiet), noise_density(manoeuvre)
    ),
    "alpha_beta": lambda quiet, manoeuvre: AlphaBetaSmoother(quiet, noise_density(quiet)),
}
"""Smoothers by name; they are made of the accelerations between and in manoeuvres, m/s^2."""

__all__ = ["SMOOTHERS", "Measured", "Smoothed", "Smoother", "joseph_update"]
