# SPDX-License-Identifier: Apache-2.0
"""What the tracker asks of a filter of position and velocity."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Measured:
    """Tracks together with the plots that were given to them, one row each.

    Attributes:
        state: (x, y, vx, vy) at the track's last plot, metres and m/s, shape (n, 4).
        covariance: of the state, shape (n, 4, 4).
        memory: what the smoother keeps beside the state, shape (n,) of its own dtype.
        hits: plots in the track, the new one included, shape (n,).
        seconds: from the last plot to the new one, shape (n,).
        position: of the new plot, metres, shape (n, 2).
        position_covariance: of its error, shape (n, 2, 2).
        azimuth: under which the radar saw it, radians clockwise from north, shape (n,).
    """

    state: FloatArray
    covariance: FloatArray
    memory: npt.NDArray[Any]
    hits: npt.NDArray[np.integer]
    seconds: FloatArray
    position: FloatArray
    position_covariance: FloatArray
    azimuth: FloatArray


@dataclass(frozen=True, slots=True)
class Smoothed:
    """State, covariance and memory at the new plot, shapes as in Measured."""

    state: FloatArray
    covariance: FloatArray
    memory: npt.NDArray[Any]


class Smoother(Protocol):
    """Improves tracks by their new plots, all tracks at once."""

    memory: np.dtype[Any]
    """dtype of what is kept per track beside state and covariance; zeros are its start."""

    def update(self, measured: Measured) -> Smoothed:
        """Combine prediction and plot.

        Args:
            measured: tracks and plots.

        Returns:
            The tracks at the time of their plots; covariances symmetric and positive definite.
        """
        ...


def joseph_update(
    covariance: FloatArray, gain: FloatArray, position_covariance: FloatArray
) -> FloatArray:
    """Covariance after an update of the position with any gain, optimal or not.

    (I - K H) P (I - K H)' + K R K', which stays symmetric and positive definite. Source: Bucy and Joseph 1968, ch. 16.

    Args:
        covariance: P before the update, the position being first in the state, shape (n, s, s).
        gain: K, shape (n, s, 2).
        position_covariance: R, shape (n, 2, 2).

    Returns:
        P after the update, shape (n, s, s).
    """
    keep = np.zeros_like(covariance)
    keep[:, :, :2] = -gain
    diagonal = np.arange(covariance.shape[1])
    keep[:, diagonal, diagonal] += 1.0
    updated = keep @ covariance @ keep.transpose(0, 2, 1)
    updated += gain @ position_covariance @ gain.transpose(0, 2, 1)
    updated += updated.transpose(0, 2, 1).copy()
    updated *= 0.5
    return updated
