# SPDX-License-Identifier: Apache-2.0
"""Plots as the tracker works with them: positions with covariances, each at its own time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Self

import numpy as np
import numpy.typing as npt

from radar_common.frames import enu_covariance, enu_from_polar

FloatArray = npt.NDArray[np.float64]

TIME, RANGE, AZIMUTH, RANGE_STD, AZIMUTH_STD, STRENGTH = range(6)
"""Columns of the queue's matrix; plain numbers, because joining structured arrays costs ten times as much."""
QUEUE_COLUMNS = 6


@dataclass(frozen=True, slots=True)
class Plots:
    """Plots of one slice of time.

    Attributes:
        time: seconds since the tracker's first message, shape (n,).
        range: metres, shape (n,).
        azimuth: radians clockwise from north, shape (n,).
        position: east and north of the radar, metres, shape (n, 2).
        covariance: of the position's error, shape (n, 2, 2).
    """

    time: FloatArray
    range: FloatArray
    azimuth: FloatArray
    position: FloatArray
    covariance: FloatArray

    @classmethod
    def from_queue(cls, rows: FloatArray) -> Self:
        """Convert polar plots to positions.

        Args:
            rows: plots as the queue keeps them, shape (n, QUEUE_COLUMNS).

        Returns:
            The same plots with positions and covariances.
        """
        distance, azimuth = rows[:, RANGE], rows[:, AZIMUTH]
        position = np.empty((len(rows), 2))
        position[:, 0], position[:, 1] = enu_from_polar(distance, azimuth)
        return cls(
            time=rows[:, TIME],
            range=distance,
            azimuth=azimuth,
            position=position,
            covariance=enu_covariance(distance, azimuth, rows[:, RANGE_STD], rows[:, AZIMUTH_STD]),
        )

    def __len__(self) -> int:
        """Number of plots."""
        return len(self.time)

    def __getitem__(self, which: Any) -> Plots:
        """Select plots.

        Args:
            which: mask, slice or indices.

        Returns:
            The plots selected.
        """
        return Plots(
            self.time[which],
            self.range[which],
            self.azimuth[which],
            self.position[which],
            self.covariance[which],
        )
