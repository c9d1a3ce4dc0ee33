# SPDX-License-Identifier: Apache-2.0
"""Filters of position and velocity, by the name that the parameter `smoother` gives them."""

from __future__ import annotations

from collections.abc import Callable

from secondary_proc.motion import noise_density
from secondary_proc.smoothing.alpha_beta import AlphaBetaSmoother
from secondary_proc.smoothing.interface import Measured, Smoothed, Smoother, joseph_update
from secondary_proc.smoothing.kalman import KalmanSmoother
from secondary_proc.smoothing.manoeuvre import ManoeuvreDetector
from secondary_proc.smoothing.parameters import SmoothingParameters

SMOOTHERS: dict[str, Callable[[SmoothingParameters], Smoother]] = {
    "kalman": lambda p: KalmanSmoother(
        noise_density(p.acceleration),
        noise_density(p.manoeuvre_acceleration),
        ManoeuvreDetector(p.manoeuvre_sigmas),
    ),
    "alpha_beta": lambda p: AlphaBetaSmoother(
        p.acceleration, noise_density(p.acceleration), p.alpha_beta_criterion
    ),
}
"""Smoothers by name, each made of the parameters."""

__all__ = ["SMOOTHERS", "Measured", "Smoothed", "Smoother", "SmoothingParameters", "joseph_update"]
