# SPDX-License-Identifier: Apache-2.0
"""What is known of emitters, one row of each array an emitter: before the first bearing, and after it."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Self

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Rows:
    """Arrays that have the emitter on axis 0."""

    def __len__(self) -> int:
        """Count the emitters."""
        return len(getattr(self, fields(self)[0].name))

    def take(self, index: npt.ArrayLike) -> Self:
        """Keep some emitters.

        Args:
            index: their numbers in any order, or a mask of shape (n,).

        Returns:
            These alone.
        """
        chosen = np.asarray(index)
        return type(self)(*(_take(getattr(self, item.name), chosen) for item in fields(self)))

    def put(self, index: npt.NDArray[np.intp], part: Self) -> Self:
        """Exchange some emitters.

        Args:
            index: their numbers, each once, shape (k,).
            part: what is known of these now, k of them, made by the same filter.

        Returns:
            All emitters.
        """
        pairs = [(getattr(self, item.name), getattr(part, item.name)) for item in fields(self)]
        return type(self)(*(_put(whole, index, some) for whole, some in pairs))

    def joined(self, other: Self) -> Self:
        """Append emitters.

        Args:
            other: made by the same filter.

        Returns:
            These emitters, then the others.
        """
        pairs = [(getattr(self, item.name), getattr(other, item.name)) for item in fields(self)]
        return type(self)(*(_join(first, second) for first, second in pairs))


@dataclass(frozen=True, slots=True)
class Prior(Rows):
    """What is known of emitters before their first bearing.

    Attributes:
        range_low: smallest distance from the observer, metres, shape (n,).
        range_high: largest distance, metres, shape (n,).
        range_mean: expected distance, metres, shape (n,); NaN where nothing but the limits is known: then every octave
            of range between them is as likely as another.
        range_std: standard deviation about `range_mean`, metres, shape (n,); NaN where that is NaN.
        velocity: expected, m/s east and north, shape (n, 2).
        velocity_covariance: of it, shape (n, 2, 2).
    """

    range_low: FloatArray
    range_high: FloatArray
    range_mean: FloatArray
    range_std: FloatArray
    velocity: FloatArray
    velocity_covariance: FloatArray

    @classmethod
    def between(cls, low: float, high: float, *, speed_std: float, emitters: int) -> Prior:
        """Know limits of the range and the usual speed only.

        Args:
            low: smallest distance, metres.
            high: largest distance, metres.
            speed_std: standard deviation of either component of the velocity, m/s.
            emitters: number n of them.

        Returns:
            The same prior for each.

        Raises:
            ValueError: the limits are not 0 < low < high, or the deviation is not positive.
        """
        if not (0.0 < low < high < np.inf and 0.0 < speed_std < np.inf):
            raise ValueError(f"no prior between {low} m and {high} m with speed {speed_std} m/s")
        unknown = np.full(emitters, np.nan)
        covariance = np.tile(speed_std**2 * np.eye(2), (emitters, 1, 1))
        return cls(
            np.full(emitters, low),
            np.full(emitters, high),
            unknown,
            unknown,
            np.zeros((emitters, 2)),
            covariance,
        )


@dataclass(frozen=True, slots=True)
class Geometry(Rows):
    """From where an emitter was heard: a fixed number K of places, evenly many bearings in each.

    Attributes:
        time: mean time of the bearings of a place, seconds since the first bearing, shape (n, K).
        observer: mean position, metres east and north, shape (n, K, 2).
        weight: sum of 1 / std^2 of the bearings, 1/rad^2, shape (n, K); zero where there is no bearing yet.
        unrest: variance that its accelerations have added to the emitter's velocity until then, m^2/s^2, shape (n, K).
        bearings: taken, shape (n,).
        stride: bearings that share a place, shape (n,).
        heard: time of the last bearing, seconds since the first, shape (n,).
        now: time of the belief, seconds since the first bearing, shape (n,).
        unrest_now: the same variance until now, m^2/s^2, shape (n,).
        first_observer: where the first bearing was taken, metres, shape (n, 2).
    """

    time: FloatArray
    observer: FloatArray
    weight: FloatArray
    unrest: FloatArray
    bearings: npt.NDArray[np.intp]
    stride: npt.NDArray[np.intp]
    heard: FloatArray
    now: FloatArray
    unrest_now: FloatArray
    first_observer: FloatArray


@dataclass(frozen=True, slots=True)
class Belief(Rows):
    """What a filter knows of emitters; to be kept and handed back, not to be read.

    It is a mixture of Gaussian densities of (x, y, vx, vy) and, where the filter estimates it, the correlated bearing
    error g: B bins of range by M motion models, dimension D = 4 or 5.

    Attributes:
        mean: shape (n, B, M, D).
        covariance: shape (n, B, M, D, D).
        weight: probabilities, shape (n, B, M), of sum one.
        observer: where the observer is now, metres east and north, shape (n, 2).
        observer_velocity: its mean velocity over the last step, m/s, shape (n, 2).
        geometry: where the bearings came from.
        prior: as it was given.
        range_spread: standard deviation of the prior range, metres, shape (n,).
    """

    mean: FloatArray
    covariance: FloatArray
    weight: FloatArray
    observer: FloatArray
    observer_velocity: FloatArray
    geometry: Geometry
    prior: Prior
    range_spread: FloatArray


def _take(value: npt.NDArray | Rows, chosen: npt.NDArray) -> npt.NDArray | Rows:
    return value.take(chosen) if isinstance(value, Rows) else value[chosen]


def _put(
    whole: npt.NDArray | Rows, index: npt.NDArray[np.intp], part: npt.NDArray | Rows
) -> npt.NDArray | Rows:
    if isinstance(whole, Rows) and isinstance(part, Rows):
        return whole.put(index, part)
    changed = np.array(whole)
    changed[index] = part
    return changed


def _join(first: npt.NDArray | Rows, second: npt.NDArray | Rows) -> npt.NDArray | Rows:
    if isinstance(first, Rows) and isinstance(second, Rows):
        return first.joined(second)
    return np.concatenate([first, second])
