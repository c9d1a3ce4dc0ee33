# SPDX-License-Identifier: Apache-2.0
"""What a user may set about smoothing."""

from __future__ import annotations

from dataclasses import dataclass

from radar_common.parameters import ParameterError, Parameters, parameter
from secondary_proc.calculators.alpha_beta_gains import GAIN_RULES


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

    def check(self) -> None:
        """Refuse what no target does."""
        if self.acceleration > self.manoeuvre_acceleration:
            raise ParameterError(
                f"acceleration {self.acceleration} must not exceed manoeuvre_acceleration "
                f"{self.manoeuvre_acceleration}"
            )
