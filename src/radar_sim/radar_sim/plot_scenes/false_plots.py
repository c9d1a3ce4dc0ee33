# SPDX-License-Identifier: Apache-2.0
"""Plots of no target: uniform in range as noise makes them, and dense where there is clutter."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from radar_common.frames import TWO_PI

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, slots=True)
class ClutterPatch:
    """A sector of a ring in which false plots are uniform over the area.

    Attributes:
        range_min: m.
        range_max: m.
        azimuth_min: rad clockwise from north.
        azimuth_max: rad, above azimuth_min, at most a turn above.
        per_scan: mean number of false plots in it, a scan.
    """

    range_min: float
    range_max: float
    azimuth_min: float
    azimuth_max: float
    per_scan: float

    def __post_init__(self) -> None:
        """Refuse a patch that is none.

        Raises:
            ValueError: ranges or azimuths do not rise, or the number is negative.
        """
        rising = 0.0 <= self.range_min < self.range_max
        sector = 0.0 < self.azimuth_max - self.azimuth_min <= TWO_PI
        if not (rising and sector and self.per_scan >= 0.0):
            raise ValueError(f"not a patch of clutter: {self}")


def uniform_in_range(
    per_scan: float, nearest: float, farthest: float, rng: np.random.Generator
) -> tuple[FloatArray, FloatArray]:
    """Draw the false plots of noise in one scan.

    Every range cell has as many, so that their density per area falls as one over the range (Kuzmin 1967, 4.10).

    Args:
        per_scan: mean number, of a Poisson law.
        nearest: m.
        farthest: m.
        rng: source of randomness.

    Returns:
        (range, azimuth): m and rad clockwise from north, each shape (n,).
    """
    number = rng.poisson(per_scan)
    return rng.uniform(nearest, farthest, number), rng.uniform(0.0, TWO_PI, number)


def in_patches(
    patches: Sequence[ClutterPatch], rng: np.random.Generator
) -> tuple[FloatArray, FloatArray]:
    """Draw the false plots of clutter in one scan.

    Args:
        patches: where it is.
        rng: source of randomness.

    Returns:
        (range, azimuth): m and rad clockwise from north, not wrapped, each shape (n,).
    """
    low, high, left, right, mean = (
        np.array(
            [(p.range_min, p.range_max, p.azimuth_min, p.azimuth_max, p.per_scan) for p in patches]
        )
        .reshape(-1, 5)
        .T
    )
    patch = np.repeat(np.arange(len(patches)), rng.poisson(mean))
    squares = rng.uniform(low[patch] ** 2, high[patch] ** 2)
    return np.sqrt(squares), rng.uniform(left[patch], right[patch])
