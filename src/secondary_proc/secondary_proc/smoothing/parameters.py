# SPDX-License-Identifier: Apache-2.0
"""What a user may set about smoothing."""

from __future__ import annotations

from dataclasses import dataclass

from radar_common.parameters import ParameterError, Parameters, parameter
from secondary_proc.calculators.alpha_beta_gains import GAIN_RULES
from secondary_proc.smoothing.speed_course import SPEED_COURSE_WEIGHTS


@dataclass(frozen=True, kw_only=True)
class SmoothingParameters(Parameters):
    """Parameters that the smoothers share, and those that one of them has for itself."""

    acceleration: float = parameter(
        0.3,
        "standard deviation of the accelerations of a target between manoeuvres",
        unit="m/s^2",
        low=0.0,
        high=100.0,
    )
    manoeuvre_acceleration: float = parameter(
        8.0,
        "standard deviation of the accelerations in a manoeuvre; gates stay open for it",
        unit="m/s^2",
        low=0.0,
        high=1000.0,
    )
    manoeuvre_sigmas: float = parameter(
        3.0,
        "surprise that counts as a manoeuvre; 3 is reached once in 370 plots of quiet flight, 2 once in 22",
        unit="sigma",
        low=0.5,
        high=10.0,
    )
    alpha_beta_criterion: str = parameter(
        "smoothed",
        "what the gains of alpha_beta are best for: the smoothed position, the predicted one, or a velocity that "
        "changes at random",
        choices=GAIN_RULES,
    )
    polynomial_plots: int = parameter(
        6, "plots that polynomial fits, the new one included", low=3, high=16
    )
    polynomial_degree: int = parameter(
        2, "1 for lines only, 2 for parabolas where a manoeuvre shows", low=1, high=2
    )
    speed_course_weights: str = parameter(
        "exponential",
        "memory of speed_course: one that fades, or a mean that grows until a manoeuvre shows",
        choices=SPEED_COURSE_WEIGHTS,
    )
    position_feedback: float = parameter(
        0.3,
        "share of the distance to the plot by which speed_course corrects the position; with 0, as the book draws it, "
        "the position drifts away",
        low=0.0,
        high=1.0,
    )
    imm_manoeuvres: str = parameter(
        "accelerations",
        "what imm expects beside quiet flight: accelerations to any side, or coordinated turns as well",
        choices=("accelerations", "turns"),
    )
    manoeuvre_interval: float = parameter(
        1000.0,
        "mean time of quiet flight between manoeuvres, for imm",
        unit="s",
        low=1.0,
        high=1e5,
    )
    manoeuvre_duration: float = parameter(
        30.0, "mean duration of a manoeuvre, for imm", unit="s", low=0.1, high=1e4
    )

    def check(self) -> None:
        """Refuse what no target does."""
        if self.acceleration > self.manoeuvre_acceleration:
            raise ParameterError(
                f"acceleration {self.acceleration} must not exceed manoeuvre_acceleration "
                f"{self.manoeuvre_acceleration}"
            )
