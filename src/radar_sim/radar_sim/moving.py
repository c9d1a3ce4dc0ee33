# SPDX-License-Identifier: Apache-2.0
"""What a scenario says of anything that moves: first position and velocity, legs, random motion."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

from radar_common.parameters import ParameterError, Parameters, parameter
from radar_sim.motion import Leg, Path
from radar_sim.motion.correlated import WanderSection
from radar_sim.motion.model import MotionModel
from radar_sim.motion.sections import MOTIONS
from radar_sim.yaml_sections import read_entries, read_keys, read_section


@dataclass(frozen=True, kw_only=True)
class LegSection(Parameters):
    """One entry of `legs`: of a target, an emitter or a platform."""

    duration: float = parameter(60.0, "time on this leg", unit="s", low=0.1, high=1e6)
    turn_rate_deg: float = parameter(
        0.0, "change of course, positive to the right", unit="deg/s", low=-45.0, high=45.0
    )
    acceleration: float = parameter(0.0, "change of speed", unit="m/s²", low=-50.0, high=50.0)
    centripetal: float = parameter(
        0.0,
        "instead of a turn rate: acceleration across the course, positive to the right",
        unit="m/s²",
        low=-100.0,
        high=100.0,
    )
    jump_course_deg: float = parameter(
        0.0, "sudden change of course at its beginning", unit="deg", low=-180.0, high=180.0
    )
    jump_speed: float = parameter(
        0.0, "sudden change of speed at its beginning", unit="m/s", low=-3000.0, high=3000.0
    )

    def check(self) -> None:
        """Check that there is but one law of the turn.

        Raises:
            ParameterError: there are two.
        """
        if self.turn_rate_deg and self.centripetal:
            raise ParameterError("turn_rate_deg and centripetal exclude each other")

    def leg(self) -> Leg:
        """Convert to the units of the motion model."""
        return Leg(
            self.duration,
            math.radians(self.turn_rate_deg),
            self.acceleration,
            self.centripetal,
            math.radians(self.jump_course_deg),
            self.jump_speed,
        )


@dataclass(frozen=True, kw_only=True)
class PlacedSection(Parameters):
    """Where something begins; after its legs it moves straight on."""

    x: float = parameter(
        0.0, "east of the map's origin when it appears", unit="m", low=-1e6, high=1e6
    )
    y: float = parameter(10_000.0, "north of the map's origin", unit="m", low=-1e6, high=1e6)
    speed: float = parameter(100.0, "speed when it appears", unit="m/s", low=0.0, high=3000.0)
    course_deg: float = parameter(
        0.0, "course when it appears, clockwise from north", unit="deg", low=-360.0, high=360.0
    )

    def path(self, legs: Sequence[LegSection]) -> Path:
        """Put the path together with its legs.

        Args:
            legs: one after the other.

        Returns:
            The path, there for ever.

        Raises:
            ParameterError: its speed would become negative on the way, or it turns about itself at rest.
        """
        speed = self.speed
        for number, leg in enumerate(legs):
            speed += leg.jump_speed
            if leg.centripetal and speed <= 0.0:
                raise ParameterError(
                    f"legs[{number}] has a centripetal acceleration at the speed {speed:g} m/s"
                )
            ends = speed + leg.acceleration * leg.duration
            if min(speed, ends) < 0.0:
                raise ParameterError(
                    f"legs[{number}] ends with the speed {min(speed, ends):g} m/s, which must not be negative"
                )
            speed = ends
        return Path(
            x=self.x,
            y=self.y,
            speed=self.speed,
            course=math.radians(self.course_deg),
            legs=tuple(leg.leg() for leg in legs),
        )


@dataclass(frozen=True, kw_only=True)
class MovingSection(PlacedSection):
    """The same with the time for which it is there."""

    appears: float = parameter(
        0.0, "time after the start at which it takes off", unit="s", low=0.0, high=1e6
    )
    lifetime: float = parameter(
        0.0, "time from appearing to disappearing; 0 stays for ever", unit="s", low=0.0, high=1e6
    )

    def path(self, legs: Sequence[LegSection]) -> Path:
        """Put the path together; see `PlacedSection.path`.

        Args:
            legs: one after the other.

        Returns:
            The path.

        Raises:
            ParameterError: its speed would become negative on the way, or it turns about itself at rest.
        """
        ends = self.appears + self.lifetime if self.lifetime else math.inf
        return replace(super().path(legs), appears=self.appears, disappears=ends)


def read_path(
    section: PlacedSection,
    legs: Sequence[LegSection],
    motion: MotionModel | None,
    where: str,
) -> Path:
    """Put a path together.

    Args:
        section: first position and velocity.
        legs: one after the other.
        motion: that would take the place of the legs.
        where: it stands.

    Returns:
        The path.

    Raises:
        ParameterError: there are legs beside a motion, or impossible ones.
    """
    if legs and motion is not None:
        raise ParameterError(f"{where}: legs and motion exclude each other")
    try:
        return section.path(legs)
    except ParameterError as error:
        raise ParameterError(f"{where}: {error}") from error


def read_legs(keys: dict[Any, Any], where: str) -> list[LegSection]:
    """Take the legs out of an entry.

    Args:
        keys: keys and values, from which `legs` is taken.
        where: they stand.

    Returns:
        One after the other.

    Raises:
        ParameterError: a key is unknown or a value impossible.
    """
    legs = [
        read_section(LegSection, leg, at) for at, leg in read_entries(keys, "legs", f"{where}.")
    ]
    keys.pop("legs", None)
    return legs


def read_motion(
    keys: dict[Any, Any], where: str
) -> tuple[MotionModel | None, WanderSection | None]:
    """Take random motion and wander out of an entry.

    Args:
        keys: keys and values, from which `motion` and `wander` are taken.
        where: they stand.

    Returns:
        Both, None for one that is absent.

    Raises:
        ParameterError: a model or key is unknown or a value impossible.
    """
    motion, wander = None, None
    if "motion" in keys:
        values = read_keys(keys.pop("motion"), f"{where}.motion")
        name = values.pop("model", None)
        if name not in MOTIONS:
            raise ParameterError(f"{where}.motion: model must be one of {', '.join(MOTIONS)}")
        motion = read_section(MOTIONS[name], values, f"{where}.motion")
    if "wander" in keys:
        wander = read_section(WanderSection, keys.pop("wander"), f"{where}.wander")
    return motion, wander
