# SPDX-License-Identifier: Apache-2.0
"""Filters of position and velocity, by the name that the parameter `smoother` gives them."""

from __future__ import annotations

from collections.abc import Callable

from secondary_proc.motion import noise_density
from secondary_proc.smoothing.alpha_beta import AlphaBetaSmoother
from secondary_proc.smoothing.interacting_models import InteractingModelsSmoother
from secondary_proc.smoothing.interface import Measured, Smoothed, Smoother, joseph_update
from secondary_proc.smoothing.kalman import KalmanSmoother
from secondary_proc.smoothing.manoeuvre import ManoeuvreDetector
from secondary_proc.smoothing.motion_models import CoordinatedTurn, MotionModel, UniformMotion
from secondary_proc.smoothing.parameters import SmoothingParameters
from secondary_proc.smoothing.polynomial import PolynomialSmoother
from secondary_proc.smoothing.speed_course import SpeedCourseSettings, SpeedCourseSmoother


def _models(p: SmoothingParameters) -> list[MotionModel]:
    quiet, manoeuvre = noise_density(p.acceleration), noise_density(p.manoeuvre_acceleration)
    models: list[MotionModel] = [UniformMotion(quiet)]
    if p.imm_manoeuvres == "turns":
        models.append(CoordinatedTurn(quiet, p.manoeuvre_duration))
    # Speed changes too, and no turn begins at its full rate.
    return [*models, UniformMotion(manoeuvre)]


SMOOTHERS: dict[str, Callable[[SmoothingParameters], Smoother]] = {
    "kalman": lambda p: KalmanSmoother(
        noise_density(p.acceleration),
        noise_density(p.manoeuvre_acceleration),
        ManoeuvreDetector(p.manoeuvre_sigmas),
    ),
    "alpha_beta": lambda p: AlphaBetaSmoother(
        p.acceleration, noise_density(p.acceleration), p.alpha_beta_criterion
    ),
    "polynomial": lambda p: PolynomialSmoother(
        p.polynomial_plots,
        p.polynomial_degree,
        noise_density(p.acceleration),
        ManoeuvreDetector(p.manoeuvre_sigmas),
    ),
    "speed_course": lambda p: SpeedCourseSmoother(
        SpeedCourseSettings(
            weights=p.speed_course_weights,
            acceleration=p.acceleration,
            manoeuvre_acceleration=p.manoeuvre_acceleration,
            feedback=p.position_feedback,
            noise_density=noise_density(p.acceleration),
        ),
        ManoeuvreDetector(p.manoeuvre_sigmas),
    ),
    "imm": lambda p: InteractingModelsSmoother(
        _models(p),
        p.manoeuvre_acceleration,
        p.manoeuvre_interval,
        p.manoeuvre_duration,
        ManoeuvreDetector(p.manoeuvre_sigmas),
    ),
}
"""Smoothers by name, each made of the parameters."""

__all__ = ["SMOOTHERS", "Measured", "Smoothed", "Smoother", "SmoothingParameters", "joseph_update"]
