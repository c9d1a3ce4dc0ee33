# SPDX-License-Identifier: Apache-2.0
"""What a scenario says about one target, and what a simulation needs to know of all of them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from radar_common.parameters import ParameterError, Parameters, parameter
from radar_sim.fluctuation import FLUCTUATIONS
from radar_sim.motion import Fleet, Leg, Path


@dataclass(frozen=True, kw_only=True)
class LegSection(Parameters):
    """One entry of a target's `legs`."""

    duration: float = parameter(60.0, "time on this leg", unit="s", low=0.1, high=1e6)
    turn_rate_deg: float = parameter(
        0.0, "change of course, positive to the right", unit="deg/s", low=-45.0, high=45.0
    )
    acceleration: float = parameter(0.0, "change of speed", unit="m/s²", low=-50.0, high=50.0)

    def leg(self) -> Leg:
        """Convert to the units of the motion model."""
        return Leg(self.duration, math.radians(self.turn_rate_deg), self.acceleration)


@dataclass(frozen=True, kw_only=True)
class TargetSection(Parameters):
    """One entry of a scenario's `targets`; after its legs a target moves straight on."""

    x: float = parameter(
        0.0, "east of the map's origin when it appears", unit="m", low=-1e6, high=1e6
    )
    y: float = parameter(10_000.0, "north of the map's origin", unit="m", low=-1e6, high=1e6)
    speed: float = parameter(100.0, "speed when it appears", unit="m/s", low=0.0, high=3000.0)
    course_deg: float = parameter(
        0.0, "course when it appears, clockwise from north", unit="deg", low=-360.0, high=360.0
    )
    snr_db: float = parameter(
        15.0,
        "mean power signal-to-noise ratio at the radar's reference_range",
        unit="dB",
        low=-60.0,
        high=80.0,
    )
    fluctuation: str = parameter(
        "slow",
        "of the echo: none, slow (Swerling 1), fast (2), slow-dominant (3), fast-dominant (4)",
        choices=tuple(FLUCTUATIONS),
    )
    appears: float = parameter(
        0.0, "time after the start at which it takes off", unit="s", low=0.0, high=1e6
    )
    lifetime: float = parameter(
        0.0, "time from appearing to disappearing; 0 stays for ever", unit="s", low=0.0, high=1e6
    )

    def target(self, legs: Sequence[LegSection]) -> Target:
        """Put the target together with its legs.

        Args:
            legs: one after the other.

        Returns:
            The target.

        Raises:
            ParameterError: its speed would become negative on the way.
        """
        speed = self.speed
        for number, leg in enumerate(legs):
            speed += leg.acceleration * leg.duration
            if speed < 0.0:
                raise ParameterError(
                    f"legs[{number}] ends with the speed {speed:g} m/s, which must not be negative"
                )
        path = Path(
            x=self.x,
            y=self.y,
            speed=self.speed,
            course=math.radians(self.course_deg),
            legs=tuple(leg.leg() for leg in legs),
            appears=self.appears,
            disappears=self.appears + self.lifetime if self.lifetime else math.inf,
        )
        return Target(path, self.snr_db, self.fluctuation)


@dataclass(frozen=True, slots=True)
class Target:
    """One target.

    Attributes:
        path: its motion.
        snr_db: mean power ratio of one pulse at the radar's reference range, dB.
        fluctuation: name of the model of its echo.
    """

    path: Path
    snr_db: float
    fluctuation: str


class Targets:
    """All targets of a simulation as arrays; the index of a target plus one is its id."""

    def __init__(self, targets: Sequence[Target]) -> None:
        """Collect them.

        Args:
            targets: in order of their ids.
        """
        self.fleet = Fleet([target.path for target in targets])
        self.snr_db: npt.NDArray[np.float64] = np.array([t.snr_db for t in targets], dtype=float)
        self.fluctuation: npt.NDArray[np.str_] = np.array(
            [target.fluctuation for target in targets], dtype=str
        )

    def __len__(self) -> int:
        """Count them."""
        return len(self.fleet)
