# SPDX-License-Identifier: Apache-2.0
"""Stationary independent increments, the first or the second, from step to step (Kuzmin 1967, § 4.2.1, figure 4.1).

Between the steps motion is uniform, so that positions at the steps are those of the model exactly.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from radar_common.parameters import parameter
from radar_sim.motion.legs import Leg
from radar_sim.motion.model import (
    FloatArray,
    MotionModel,
    normal_vectors,
    require_few_steps,
    step_times,
    velocity_of,
)
from radar_sim.motion.pieces import ComplexArray, Pieces, of_velocities


@dataclass(frozen=True, kw_only=True)
class FirstIncrementsMotion(MotionModel):
    """`first-increments`: u_n = y_n - y_(n-1) is uncorrelated about the way at the first velocity."""

    step: float = parameter(4.0, "time of an increment", unit="s", low=0.01, high=1e3)
    increment_std: float = parameter(
        50.0, "of each component of an increment", unit="m", low=0.0, high=1e5
    )

    def check(self) -> None:
        """Check that the steps are not too many.

        Raises:
            ParameterError: they are.
        """
        require_few_steps(self.duration, self.step)

    def draw(
        self, speed: FloatArray, course: FloatArray, rng: np.random.Generator
    ) -> list[tuple[Leg, ...] | Pieces]:
        """Draw the increments; see `MotionModel.draw`.

        Args:
            speed: mean increment over the step, m/s, shape (n,).
            course: rad clockwise from north, shape (n,).
            rng: source of randomness.

        Returns:
            Pieces of constant velocity.
        """
        increments = _draw(self, len(speed), rng)
        return _paths(self, velocity_of(speed, course)[:, None] + increments / self.step)


@dataclass(frozen=True, kw_only=True)
class SecondIncrementsMotion(MotionModel):
    """`second-increments`: g_n = u_n - u_(n-1) is uncorrelated with mean zero, u_n the increment of the position."""

    step: float = parameter(4.0, "time of an increment", unit="s", low=0.01, high=1e3)
    increment_std: float = parameter(
        10.0, "of each component of a second increment", unit="m", low=0.0, high=1e5
    )

    def check(self) -> None:
        """Check that the steps are not too many.

        Raises:
            ParameterError: they are.
        """
        require_few_steps(self.duration, self.step)

    def draw(
        self, speed: FloatArray, course: FloatArray, rng: np.random.Generator
    ) -> list[tuple[Leg, ...] | Pieces]:
        """Draw the second increments; see `MotionModel.draw`.

        Args:
            speed: before the first increment, m/s, shape (n,).
            course: rad clockwise from north, shape (n,).
            rng: source of randomness.

        Returns:
            Pieces of constant velocity.
        """
        increments = np.cumsum(_draw(self, len(speed), rng), axis=1)
        return _paths(self, velocity_of(speed, course)[:, None] + increments / self.step)


def _draw(
    model: FirstIncrementsMotion | SecondIncrementsMotion, size: int, rng: np.random.Generator
) -> ComplexArray:
    steps = len(step_times(model.duration, model.step)) - 1
    return normal_vectors(model.increment_std, (size, steps), rng)


def _paths(
    model: FirstIncrementsMotion | SecondIncrementsMotion, velocity: ComplexArray
) -> list[tuple[Leg, ...] | Pieces]:
    begin = step_times(model.duration, model.step)[:-1]
    return [of_velocities(begin, row) for row in velocity]
