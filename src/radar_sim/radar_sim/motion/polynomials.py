# SPDX-License-Identifier: Apache-2.0
"""Coordinates that are polynomials of time with random coefficients, whole or leg by leg (Kuzmin 1967, § 4.2.1)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from radar_common.parameters import parameter
from radar_sim.motion.legs import Leg
from radar_sim.motion.model import (
    FloatArray,
    MotionModel,
    changes,
    normal_vectors,
    velocity_of,
)
from radar_sim.motion.pieces import Pieces, of_accelerations


@dataclass(frozen=True, kw_only=True)
class PolynomialMotion(MotionModel):
    """`polynomial` (4.3): one polynomial up to the third degree, coefficients independent and normal."""

    velocity_std: float = parameter(
        0.0, "of each component of the first coefficient", unit="m/s", low=0.0, high=1e4
    )
    acceleration_std: float = parameter(
        1.0, "of each component of the acceleration", unit="m/s²", low=0.0, high=1e3
    )
    jerk_std: float = parameter(
        0.0,
        "of each component of the third derivative; the book finds no use in it",
        unit="m/s³",
        low=0.0,
        high=1e3,
    )

    def draw(
        self, speed: FloatArray, course: FloatArray, rng: np.random.Generator
    ) -> list[tuple[Leg, ...] | Pieces]:
        """Draw the coefficients; see `MotionModel.draw`.

        Args:
            speed: mean of the first coefficient, m/s, shape (n,).
            course: rad clockwise from north, shape (n,).
            rng: source of randomness.

        Returns:
            A polynomial and the straight way on after it.
        """
        shape = np.shape(speed)
        velocity = velocity_of(speed, course) + normal_vectors(self.velocity_std, shape, rng)
        acceleration = normal_vectors(self.acceleration_std, shape, rng)
        jerk = normal_vectors(self.jerk_std, shape, rng)
        t, nothing = self.duration, np.zeros(shape, dtype=complex)
        way = t * (velocity + t * (acceleration / 2.0 + t * jerk / 6.0))
        leaving = velocity + t * (acceleration + t * jerk / 2.0)
        begin = np.array([0.0, t])
        parts = [
            np.stack(pair, axis=-1)
            for pair in (
                (nothing, way),
                (velocity, leaving),
                (acceleration, nothing),
                (jerk, nothing),
            )
        ]
        return [Pieces(begin, *(part[row] for part in parts)) for row in range(len(speed))]


@dataclass(frozen=True, kw_only=True)
class PiecewiseMotion(MotionModel):
    """`piecewise`: legs of the first and second degree; with `uniform` 0 acceleration is correlated as (4.4) says."""

    acceleration_std: float = parameter(
        2.0, "of each component on a leg of the second degree", unit="m/s²", low=0.0, high=1e3
    )
    leg_duration: float = parameter(
        20.0, "mean of exponential times on a leg, 1 / lambda", unit="s", low=0.1, high=1e5
    )
    uniform: float = parameter(
        0.0, "probability that a leg is of the first degree", low=0.0, high=1.0
    )

    def draw(
        self, speed: FloatArray, course: FloatArray, rng: np.random.Generator
    ) -> list[tuple[Leg, ...] | Pieces]:
        """Draw times and accelerations; see `MotionModel.draw`.

        Args:
            speed: at the beginning, m/s, shape (n,).
            course: rad clockwise from north, shape (n,).
            rng: source of randomness.

        Returns:
            Pieces of constant acceleration.
        """
        paths: list[tuple[Leg, ...] | Pieces] = []
        for velocity in velocity_of(speed, course):
            begin = np.append(changes(self.duration, self.leg_duration, rng), self.duration)
            acceleration = normal_vectors(self.acceleration_std, (len(begin),), rng)
            acceleration[rng.random(len(begin)) < self.uniform] = 0.0
            acceleration[-1] = 0.0
            paths.append(of_accelerations(begin, complex(velocity), acceleration))
        return paths
