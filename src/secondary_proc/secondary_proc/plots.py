# SPDX-License-Identifier: Apache-2.0
"""Plots as the tracker works with them: positions with covariances, each at its own time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Self

import numpy as np
import numpy.typing as npt
from radar_common.frames import enu_covariance, enu_from_polar

FloatArray = npt.NDArray[np.float64]

QUEUED = np.dtype(
    [
        ("time", "f8"),  # s since the tracker's first message
        ("range", "f8"),
        ("azimuth", "f8"),
        ("range_std", "f8"),
        ("azimuth_std", "f8"),
        ("strength", "f8"),  # dB, what decides if there are too many
    ]
)


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
    def from_queue(cls, rows: npt.NDArray[np.void]) -> Self:
        """Convert polar plots to positions.

        Args:
            rows: plots of dtype QUEUED, shape (n,).

        Returns:
            The same plots with positions and covariances.
        """
        distance, azimuth = rows["range"], rows["azimuth"]
        return cls(
            time=rows["time"],
            range=distance,
            azimuth=azimuth,
            position=np.stack(enu_from_polar(distance, azimuth), axis=1),
            covariance=enu_covariance(distance, azimuth, rows["range_std"], rows["azimuth_std"]),
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
