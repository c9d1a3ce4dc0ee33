# SPDX-License-Identifier: Apache-2.0
"""Acceleration with an exponential correlation, and wander about a nominal path with the same (Kuzmin 1967, § 4.2)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.signal import lfilter

from radar_common.parameters import Parameters, parameter
from radar_sim.motion.legs import Leg
from radar_sim.motion.model import (
    ComplexArray,
    FloatArray,
    MotionModel,
    normal_vectors,
    require_few_steps,
    step_times,
    velocity_of,
)
from radar_sim.motion.pieces import Pieces, of_accelerations


def markov_sequence(innovations: ComplexArray | FloatArray, correlation: float) -> ComplexArray:
    """Make a stationary first-order Markov sequence out of white noise.

    a(n + 1) = rho a(n) + sqrt(1 - rho²) w(n), and a(0) = w(0), so that variance is that of w from the first on.

    Args:
        innovations: white noise, along the last axis.
        correlation: rho of one step.

    Returns:
        The sequence, same shape.
    """
    driving = math.sqrt(1.0 - correlation**2) * innovations
    driving[..., :1] = innovations[..., :1]
    return np.asarray(lfilter([1.0], [1.0, -correlation], driving, axis=-1))


def correlation_of_step(step: float, time: float) -> float:
    """Correlation of two neighbours of an exponentially correlated sequence.

    Args:
        step: s between them.
        time: s in which correlation falls to 1 / e; 0 for white noise.

    Returns:
        exp(-step / time).
    """
    return math.exp(-step / time) if time else 0.0


@dataclass(frozen=True, kw_only=True)
class CorrelatedMotion(MotionModel):
    """`correlated` (4.4), Singer's model: acceleration is a Markov sequence, constant over a step.

    With `correlation_time` 0 it is white: x(k + 1) = x + v T + a T² / 2, v(k + 1) = v + a T.
    """

    step: float = parameter(1.0, "time of constant acceleration", unit="s", low=0.01, high=1e3)
    acceleration_std: float = parameter(
        1.0, "of each component of the acceleration", unit="m/s²", low=0.0, high=1e3
    )
    correlation_time: float = parameter(
        20.0,
        "in which its correlation falls to 1 / e, 1 / lambda; 0 for white acceleration",
        unit="s",
        low=0.0,
        high=1e5,
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
        """Draw the accelerations; see `MotionModel.draw`.

        Args:
            speed: at the beginning, m/s, shape (n,).
            course: rad clockwise from north, shape (n,).
            rng: source of randomness.

        Returns:
            Pieces of constant acceleration.
        """
        begin = step_times(self.duration, self.step)
        white = normal_vectors(self.acceleration_std, (len(speed), len(begin)), rng)
        acceleration = markov_sequence(white, correlation_of_step(self.step, self.correlation_time))
        acceleration[:, -1] = 0.0
        return [
            of_accelerations(begin, complex(velocity), row)
            for velocity, row in zip(velocity_of(speed, course), acceleration, strict=True)
        ]


@dataclass(frozen=True, kw_only=True)
class WanderSection(Parameters):
    """The `wander` of a target about its path: each component normal, stationary and exponentially correlated (4.8)."""

    std: float = parameter(20.0, "of each component", unit="m", low=0.0, high=1e5)
    correlation_time: float = parameter(
        20.0, "in which its correlation falls to 1 / e", unit="s", low=0.0, high=1e5
    )
    step: float = parameter(
        4.0, "time from one value to the next, between which it is linear", unit="s", low=0.01
    )
    duration: float = parameter(
        3600.0,
        "time from appearing after which it stays as it is",
        unit="s",
        low=1.0,
        high=1e6,
    )

    def check(self) -> None:
        """Check that the steps are not too many.

        Raises:
            ParameterError: they are.
        """
        require_few_steps(self.duration, self.step)

    def draw(self, size: int, rng: np.random.Generator) -> list[Pieces]:
        """Draw the wander of some targets.

        Args:
            size: number of targets.
            rng: source of randomness.

        Returns:
            Of each.
        """
        begin = step_times(self.duration, self.step)
        values = markov_sequence(
            normal_vectors(self.std, (size, len(begin)), rng),
            correlation_of_step(self.step, self.correlation_time),
        )
        velocity = np.zeros_like(values)
        velocity[:, :-1] = np.diff(values, axis=1) / self.step
        nothing = np.zeros(len(begin), dtype=complex)
        return [
            Pieces(begin, row, moving, nothing, nothing)
            for row, moving in zip(values, velocity, strict=True)
        ]
