# SPDX-License-Identifier: Apache-2.0
"""The generalised hypothesis: legs on which speed and course change in a simple way (Kuzmin 1967, § 4.2.1).

The book leaves the law of durations open ("Poisson"); its (4.5) makes the number of changes Poisson, so durations are
exponential.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from radar_common.parameters import ParameterError, parameter
from radar_sim.motion.legs import Leg
from radar_sim.motion.model import FloatArray, MotionModel, changes
from radar_sim.motion.pieces import Pieces


@dataclass(frozen=True, kw_only=True)
class SpeedCourseMotion(MotionModel):
    """`speed-course`, version A: legs uniform or with constant accelerations along and across the course."""

    manoeuvre: float = parameter(
        0.5,
        "probability that a leg is a turn, and likewise that it changes speed",
        low=0.0,
        high=1.0,
    )
    acceleration_std: float = parameter(
        0.5, "rms acceleration in a change of speed", unit="m/s²", low=0.0, high=1e3
    )
    centripetal_std: float = parameter(
        3.0, "rms centripetal acceleration in a turn", unit="m/s²", low=0.0, high=1e3
    )
    leg_duration: float = parameter(
        30.0, "mean of exponential times on a leg, 1 / lambda", unit="s", low=0.1, high=1e5
    )
    speed_min: float = parameter(
        20.0, "a change of speed ends here", unit="m/s", low=1.0, high=3000.0
    )
    speed_max: float = parameter(1000.0, "and here", unit="m/s", low=1.0, high=1e4)

    def check(self) -> None:
        """Check that the speeds are not reversed.

        Raises:
            ParameterError: they are.
        """
        if self.speed_min > self.speed_max:
            raise ParameterError(
                f"speed_min {self.speed_min:g} is greater than speed_max {self.speed_max:g}"
            )

    def draw(
        self, speed: FloatArray, course: FloatArray, rng: np.random.Generator
    ) -> list[tuple[Leg, ...] | Pieces]:
        """Draw the legs; see `MotionModel.draw`.

        Args:
            speed: at the beginning, m/s, shape (n,).
            course: rad clockwise from north, shape (n,).
            rng: source of randomness.

        Returns:
            Legs with centripetal acceleration.
        """
        return [self._legs(float(first), rng) for first in speed]

    def _legs(self, speed: float, rng: np.random.Generator) -> tuple[Leg, ...]:
        durations = _durations(self.duration, self.leg_duration, rng)
        turns, faster = rng.random((2, len(durations))) < self.manoeuvre
        centripetal = turns * rng.normal(0.0, self.centripetal_std, len(durations))
        acceleration = faster * rng.normal(0.0, self.acceleration_std, len(durations))
        legs = []
        for number, duration in enumerate(durations):
            wanted = speed + acceleration[number] * duration
            # A first speed outside the bounds is kept until the first change.
            low, high = min(self.speed_min, speed), max(self.speed_max, speed)
            reached = min(max(wanted, low), high)
            change = float((reached - speed) / duration) if acceleration[number] else 0.0
            legs.append(
                Leg(float(duration), acceleration=change, centripetal=float(centripetal[number]))
            )
            speed = float(reached)
        return tuple(legs)


@dataclass(frozen=True, kw_only=True)
class ArcsMotion(MotionModel):
    """`arcs`, version B: constant speed, arcs of normal curvature joined (4.6)."""

    curvature_std: float = parameter(
        1e-4, "rms curvature, one over the radius", unit="1/m", low=0.0, high=1.0
    )
    leg_duration: float = parameter(
        30.0, "mean of exponential times on an arc", unit="s", low=0.1, high=1e5
    )

    def draw(
        self, speed: FloatArray, course: FloatArray, rng: np.random.Generator
    ) -> list[tuple[Leg, ...] | Pieces]:
        """Draw the arcs; see `MotionModel.draw`.

        Args:
            speed: m/s, shape (n,).
            course: rad clockwise from north, shape (n,).
            rng: source of randomness.

        Returns:
            Legs with a turn rate of curvature times speed.
        """
        paths: list[tuple[Leg, ...] | Pieces] = []
        for moving in speed:
            durations = _durations(self.duration, self.leg_duration, rng)
            rates = moving * rng.normal(0.0, self.curvature_std, len(durations))
            paths.append(
                tuple(Leg(float(d), float(r)) for d, r in zip(durations, rates, strict=True))
            )
        return paths


def _durations(total: float, mean: float, rng: np.random.Generator) -> FloatArray:
    durations = np.diff(np.append(changes(total, mean, rng), total))
    return durations[durations > 0.0]
