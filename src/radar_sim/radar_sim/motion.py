# SPDX-License-Identifier: Apache-2.0
"""Motion on piecewise legs, in closed form at any time and for all targets at once.

On a leg the turn rate and the acceleration along the course are constant: straight and uniform, a coordinated turn,
a change of speed, or both together (Kuzmin 1967, § 4.2.1, the generalised hypothesis). After its last leg a target
flies straight on. In complex numbers with north as the real and east as the imaginary axis, a unit vector of
course Q is exp(iQ).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]
IntArray = npt.NDArray[np.intp]

_SERIES_BELOW = 1e-2


@dataclass(frozen=True, slots=True)
class Leg:
    """A piece of a path.

    Attributes:
        duration: s.
        turn_rate: rad/s, positive clockwise.
        acceleration: along the course, m/s².
    """

    duration: float
    turn_rate: float = 0.0
    acceleration: float = 0.0


@dataclass(frozen=True, slots=True)
class Path:
    """How one target moves and how long it is there.

    Attributes:
        x: m east at the time of appearance.
        y: m north.
        speed: m/s.
        course: rad clockwise from north.
        legs: one after the other.
        appears: s after the start of the simulation.
        disappears: s after the start of the simulation, inf for never.
    """

    x: float
    y: float
    speed: float
    course: float
    legs: tuple[Leg, ...] = ()
    appears: float = 0.0
    disappears: float = np.inf


@dataclass(frozen=True, slots=True)
class State:
    """Where targets are and how they move, every array of the same shape: m and m/s, east and north."""

    x: FloatArray
    y: FloatArray
    vx: FloatArray
    vy: FloatArray


def displacement(
    speed: FloatArray | float,
    course: FloatArray | float,
    turn_rate: FloatArray | float,
    acceleration: FloatArray | float,
    elapsed: FloatArray | float,
) -> ComplexArray:
    """Way made since the beginning of a leg: the integral of (V + a t) exp(i (Q + w t)).

    Args:
        speed: V at the beginning, m/s, any shape.
        course: Q at the beginning, rad clockwise from north.
        turn_rate: w, rad/s, positive clockwise.
        acceleration: a, along the course, m/s².
        elapsed: s since the beginning.

    Returns:
        Metres north + i east, broadcast shape.
    """
    t = np.asarray(elapsed, dtype=float)
    z = 1j * np.asarray(turn_rate, dtype=float) * t
    small = np.abs(z) < _SERIES_BELOW
    safe = np.where(small, 1.0, z)
    turned = np.exp(safe)
    # Moments 0 and 1 of exp(z s) over s in [0, 1]; near zero their closed forms lose all digits.
    zeroth = np.where(
        small, 1 + z / 2 * (1 + z / 3 * (1 + z / 4 * (1 + z / 5))), (turned - 1) / safe
    )
    first = np.where(
        small,
        1 / 2 + z * (1 / 3 + z * (1 / 8 + z * (1 / 30 + z / 144))),
        ((safe - 1) * turned + 1) / np.square(safe),
    )
    return np.exp(1j * np.asarray(course)) * t * (speed * zeroth + acceleration * t * first)


class Fleet:
    """All targets of a simulation."""

    def __init__(self, paths: Sequence[Path]) -> None:
        """Lay out the legs of all paths in rectangular arrays.

        Args:
            paths: one a target.
        """
        width = 1 + max((len(path.legs) for path in paths), default=0)
        shape = (len(paths), width)
        self.appears = np.array([path.appears for path in paths], dtype=float)
        self.disappears = np.array([path.disappears for path in paths], dtype=float)
        self._turn_rate = np.zeros(shape)
        self._acceleration = np.zeros(shape)
        # A leg that does not exist begins never.
        self._begin = np.full(shape, np.inf)
        durations = np.zeros(shape)
        for row, path in enumerate(paths):
            for column, leg in enumerate(path.legs):
                durations[row, column] = leg.duration
                self._turn_rate[row, column] = leg.turn_rate
                self._acceleration[row, column] = leg.acceleration
            begins = path.appears + np.cumsum([0.0, *(leg.duration for leg in path.legs)])
            self._begin[row, : len(begins)] = begins
        self._position = np.zeros(shape, dtype=complex)
        self._speed = np.zeros(shape)
        self._course = np.zeros(shape)
        if paths:
            self._position[:, 0] = [path.y + 1j * path.x for path in paths]
            self._speed[:, 0] = [path.speed for path in paths]
            self._course[:, 0] = [path.course for path in paths]
        for column in range(width - 1):
            duration = durations[:, column]
            self._position[:, column + 1] = self._position[:, column] + displacement(
                self._speed[:, column],
                self._course[:, column],
                self._turn_rate[:, column],
                self._acceleration[:, column],
                duration,
            )
            self._speed[:, column + 1] = (
                self._speed[:, column] + self._acceleration[:, column] * duration
            )
            self._course[:, column + 1] = (
                self._course[:, column] + self._turn_rate[:, column] * duration
            )

    def __len__(self) -> int:
        """Count the targets."""
        return len(self.appears)

    def present(self, target: IntArray, time: FloatArray) -> npt.NDArray[np.bool_]:
        """Tell which targets are there at which time.

        Args:
            target: index, any shape.
            time: s after the start, same shape.

        Returns:
            Boolean, same shape.
        """
        return np.asarray((self.appears[target] <= time) & (time < self.disappears[target]))

    def state(self, target: IntArray, time: FloatArray) -> State:
        """Evaluate the motion.

        Args:
            target: index, any shape.
            time: s after the start, same shape; before a target's appearance its first leg is continued backwards.

        Returns:
            Position and velocity, same shape.
        """
        leg = np.maximum((self._begin[target] <= time[..., None]).sum(axis=-1) - 1, 0)
        elapsed = time - self._begin[target, leg]
        speed, course = self._speed[target, leg], self._course[target, leg]
        turn_rate, acceleration = self._turn_rate[target, leg], self._acceleration[target, leg]
        position = self._position[target, leg] + displacement(
            speed, course, turn_rate, acceleration, elapsed
        )
        velocity = (speed + acceleration * elapsed) * np.exp(1j * (course + turn_rate * elapsed))
        return State(position.imag, position.real, velocity.imag, velocity.real)
