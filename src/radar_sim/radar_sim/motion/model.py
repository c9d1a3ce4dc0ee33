# SPDX-License-Identifier: Apache-2.0
"""What the models of random motion have in common: a section of the scenario that draws paths."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from radar_common.parameters import ParameterError, Parameters, parameter
from radar_sim.motion.legs import Leg
from radar_sim.motion.pieces import Pieces

ComplexArray = npt.NDArray[np.complex128]
FloatArray = npt.NDArray[np.float64]

_MOST_STEPS = 200_000


@dataclass(frozen=True, kw_only=True)
class MotionModel(Parameters, ABC):
    """The `motion` of a target, an emitter or a traffic group."""

    duration: float = parameter(
        3600.0,
        "time from appearing after which it moves straight on",
        unit="s",
        low=1.0,
        high=1e6,
    )

    @abstractmethod
    def draw(
        self, speed: FloatArray, course: FloatArray, rng: np.random.Generator
    ) -> list[tuple[Leg, ...] | Pieces]:
        """Draw the motion of some targets, once and for all times.

        Args:
            speed: of each at its appearance, m/s, shape (n,).
            course: rad clockwise from north, shape (n,).
            rng: source of randomness.

        Returns:
            Legs or polynomials of each.
        """


def velocity_of(speed: FloatArray, course: FloatArray) -> ComplexArray:
    """Velocity as a complex number.

    Args:
        speed: m/s, any shape.
        course: rad clockwise from north, same shape.

    Returns:
        m/s north + i east, same shape.
    """
    return np.asarray(speed * np.exp(1j * course))


def normal_vectors(std: float, shape: tuple[int, ...], rng: np.random.Generator) -> ComplexArray:
    """Draw normal vectors of independent components.

    Args:
        std: of each component.
        shape: of the result.
        rng: source of randomness.

    Returns:
        North + i east.
    """
    parts = rng.normal(0.0, std, (*shape, 2))
    return np.asarray(parts[..., 0] + 1j * parts[..., 1])


def changes(duration: float, mean: float, rng: np.random.Generator) -> FloatArray:
    """Draw the times of a Poisson stream of changes; the time between two is exponential (Kuzmin 1967, (4.5)).

    Args:
        duration: s in which there are changes.
        mean: s between two.
        rng: source of randomness.

    Returns:
        Times in s, ascending, the first zero.
    """
    times = np.sort(rng.uniform(0.0, duration, rng.poisson(duration / mean)))
    return np.concatenate([[0.0], times])


def step_times(duration: float, step: float) -> FloatArray:
    """Times at which a stepped model draws anew.

    Args:
        duration: s that the steps cover.
        step: s from one to the next.

    Returns:
        Times from zero to the first that is not before the end.
    """
    return np.multiply(step, np.arange(math.ceil(duration / step) + 1), dtype=float)


def require_few_steps(duration: float, step: float) -> None:
    """Check that a row of steps fits into memory.

    Args:
        duration: s that the steps cover.
        step: s from one to the next.

    Raises:
        ParameterError: it does not.
    """
    if duration / step > _MOST_STEPS:
        raise ParameterError(
            f"step {step:g} s makes {duration / step:g} steps in duration {duration:g} s, "
            f"at most {_MOST_STEPS} are kept"
        )
