# SPDX-License-Identifier: Apache-2.0
"""Plots as the tracker works with them: positions with covariances, each at its own time."""

from __future__ import annotations

from typing import Any, Self

import numpy as np
import numpy.typing as npt

from radar_common.frames import enu_covariance, enu_from_polar

FloatArray = npt.NDArray[np.float64]

TIME, RANGE, AZIMUTH, RANGE_STD, AZIMUTH_STD, STRENGTH, X, Y, XX, XY, YX, YY = range(12)
"""Rows of the matrix of plots; plain numbers, because joining structured arrays costs ten times as much."""
POLAR_ROWS = STRENGTH + 1
PLOT_ROWS = YY + 1


class Plots:
    """Plots of one slice of time, one column each of a matrix, so that selecting some is a single call.

    Attributes:
        values: a row for each quantity, shape (PLOT_ROWS, n).
    """

    __slots__ = ("values",)

    def __init__(self, values: FloatArray) -> None:
        """Hold plots.

        Args:
            values: a row for each quantity, shape (PLOT_ROWS, n).
        """
        self.values = values

    @classmethod
    def from_polar(cls, polar: FloatArray) -> Self:
        """Convert polar plots to positions.

        Args:
            polar: rows TIME to STRENGTH, s, m, rad and dB, shape (POLAR_ROWS, n).

        Returns:
            The same plots with positions and covariances.
        """
        values = np.empty((PLOT_ROWS, polar.shape[1]))
        values[:POLAR_ROWS] = polar
        locate(values)
        return cls(values)

    @classmethod
    def at(cls, time: FloatArray, position: FloatArray, covariance: FloatArray) -> Self:
        """Make plots of positions; the errors of range and azimuth and the strength stay unknown.

        Args:
            time: seconds, shape (n,).
            position: east and north of the radar, metres, shape (n, 2).
            covariance: of the position's error, shape (n, 2, 2).

        Returns:
            The plots.
        """
        values = np.full((PLOT_ROWS, len(time)), np.nan)
        values[TIME], values[X : Y + 1] = time, position.T
        values[RANGE] = np.hypot(position[:, 0], position[:, 1])
        values[AZIMUTH] = np.arctan2(position[:, 0], position[:, 1])
        values[XX:] = covariance.reshape(-1, 4).T
        return cls(values)

    @property
    def time(self) -> FloatArray:
        """Seconds since the tracker's first message, shape (n,)."""
        return self.values[TIME]

    @property
    def range(self) -> FloatArray:
        """Metres, shape (n,)."""
        return self.values[RANGE]

    @property
    def azimuth(self) -> FloatArray:
        """Radians clockwise from north, shape (n,)."""
        return self.values[AZIMUTH]

    @property
    def strength(self) -> FloatArray:
        """Power of the burst's peak over the noise, dB; NaN where not told, shape (n,)."""
        return self.values[STRENGTH]

    @property
    def position(self) -> FloatArray:
        """East and north of the radar, metres, shape (n, 2)."""
        return self.values[X : Y + 1].T

    @property
    def covariance(self) -> FloatArray:
        """Of the position's error, square metres, shape (n, 2, 2)."""
        return self.values[XX:].T.reshape(-1, 2, 2)

    def moved(self, position: FloatArray, covariance: FloatArray) -> Plots:
        """Copy with other positions.

        Args:
            position: metres, shape (n, 2).
            covariance: of their errors, shape (n, 2, 2).

        Returns:
            Plots of the same times, ranges and azimuths.
        """
        values = self.values.copy()
        values[X : Y + 1] = position.T
        values[XX:] = covariance.reshape(-1, 4).T
        return Plots(values)

    def __len__(self) -> int:
        """Number of plots."""
        return self.values.shape[1]

    def __getitem__(self, which: Any) -> Plots:
        """Select plots.

        Args:
            which: mask, slice or indices.

        Returns:
            The plots selected.
        """
        if isinstance(which, np.ndarray) and which.dtype != bool:
            return Plots(self.values.take(which, axis=1))
        return Plots(self.values[:, which])


def locate(values: FloatArray, bias: tuple[float, float] = (0.0, 0.0)) -> None:
    """Fill in positions and their covariances from ranges, azimuths and their errors.

    Args:
        values: changed, shape (PLOT_ROWS, n); ranges and azimuths stay as they were measured.
        bias: by how much ranges (m) and azimuths (rad) are too large.
    """
    distance, azimuth, range_std, azimuth_std = values[RANGE : AZIMUTH_STD + 1]
    if any(bias):
        distance, azimuth = distance - bias[0], azimuth - bias[1]
    values[X], values[Y] = enu_from_polar(distance, azimuth)
    covariance = enu_covariance(distance, azimuth, range_std, azimuth_std)
    values[XX:] = covariance.reshape(-1, 4).T
