# SPDX-License-Identifier: Apache-2.0
"""Motion as a row of polynomials of time, and the search for the piece that a time falls into."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]
IntArray = npt.NDArray[np.intp]


@dataclass(frozen=True, slots=True, eq=False)
class Pieces:
    """Polynomials of the third degree at most, one behind the other; north is real and east imaginary.

    Attributes:
        begin: s after the target's appearance, ascending from zero, shape (k,).
        position: m from the target's first position at the beginning of each, shape (k,).
        velocity: m/s there, shape (k,).
        acceleration: m/s² there, shape (k,).
        jerk: m/s³, shape (k,).
    """

    begin: FloatArray
    position: ComplexArray
    velocity: ComplexArray
    acceleration: ComplexArray
    jerk: ComplexArray

    def __eq__(self, other: object) -> bool:
        """Tell whether all pieces are the same."""
        if not isinstance(other, Pieces):
            return NotImplemented
        return all(
            np.array_equal(getattr(self, name), getattr(other, name)) for name in self.__slots__
        )

    __hash__ = None  # type: ignore[assignment]


def of_velocities(begin: FloatArray, velocity: ComplexArray) -> Pieces:
    """Join pieces of uniform motion into a path without gaps.

    Args:
        begin: s, shape (k,).
        velocity: m/s on each piece, shape (k,).

    Returns:
        The pieces.
    """
    nothing = np.zeros(len(begin), dtype=complex)
    return Pieces(begin, _accumulated(np.diff(begin) * velocity[:-1]), velocity, nothing, nothing)


def of_accelerations(begin: FloatArray, velocity: complex, acceleration: ComplexArray) -> Pieces:
    """Join pieces of constant acceleration so that position and velocity are continuous.

    Args:
        begin: s, shape (k,).
        velocity: m/s at the beginning of the first.
        acceleration: m/s² on each piece, shape (k,).

    Returns:
        The pieces.
    """
    step = np.diff(begin)
    velocities = velocity + _accumulated(step * acceleration[:-1])
    way = step * (velocities[:-1] + step * acceleration[:-1] / 2.0)
    nothing = np.zeros(len(begin), dtype=complex)
    return Pieces(begin, _accumulated(way), velocities, acceleration, nothing)


def _accumulated(steps: ComplexArray) -> ComplexArray:
    return np.concatenate([np.zeros(1, dtype=complex), np.cumsum(steps)])


def locate(
    begin: FloatArray, first: IntArray, count: IntArray, row: IntArray, time: FloatArray
) -> IntArray:
    """Find the last entry of a row that begins no later than a time, by bisection of all at once.

    Args:
        begin: ascending within each row, rows behind each other.
        first: index of each row's first entry, shape (rows,).
        count: entries of each row, at least one, shape (rows,).
        row: in which row to look, any shape.
        time: same shape.

    Returns:
        Index into `begin`, same shape; the row's first entry for times before it.
    """
    low = first[row]
    high = low + count[row] - 1
    for _ in range(int(count.max(initial=1)).bit_length()):
        middle = (low + high + 1) // 2
        reached = begin[middle] <= time
        low, high = np.where(reached, middle, low), np.where(reached, high, middle - 1)
        # An entry that is not reached leaves nothing to halve.
        high = np.maximum(high, low)
    return low


class PieceTable:
    """The pieces of many targets behind each other; those without any stand still."""

    def __init__(self, pieces: Sequence[Pieces | None]) -> None:
        """Lay them out.

        Args:
            pieces: of each target.
        """
        self.filled: npt.NDArray[np.bool_] = np.array([p is not None for p in pieces], dtype=bool)
        rows = [p for p in pieces if p is not None]
        self._row = np.cumsum(self.filled) - 1
        self._count = np.array([len(p.begin) for p in rows], dtype=np.intp)
        self._first = np.cumsum(self._count) - self._count
        self._begin, self._position, self._velocity, self._acceleration, self._jerk = (
            np.concatenate([getattr(p, name) for p in rows]) if rows else np.empty(0, kind)
            for name, kind in zip(
                Pieces.__slots__, (float, complex, complex, complex, complex), strict=True
            )
        )

    def state(self, target: IntArray, elapsed: FloatArray) -> tuple[ComplexArray, ComplexArray]:
        """Evaluate the polynomials of targets that have some.

        Args:
            target: index, any shape.
            elapsed: s since the target's appearance, same shape.

        Returns:
            Way from the first position in m and velocity in m/s, same shape.
        """
        piece = locate(self._begin, self._first, self._count, self._row[target], elapsed)
        t = elapsed - self._begin[piece]
        velocity, acceleration = self._velocity[piece], self._acceleration[piece]
        jerk = self._jerk[piece]
        way = self._position[piece] + t * (velocity + t * (acceleration / 2.0 + t * jerk / 6.0))
        return way, velocity + t * (acceleration + t * jerk / 2.0)
