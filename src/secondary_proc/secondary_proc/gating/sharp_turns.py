# SPDX-License-Identifier: Apache-2.0
"""Gates for turns sharper than usual manoeuvres: open for plots that no usual gate holds.

A turn changes the velocity by no more than its rate times the speed, so a slow target needs no wide gate, however
sharply it turns. After misses such gates would hold false plots too often; only a track that turns already keeps its
gate for one more scan.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from secondary_proc.association.interface import FloatArray, IndexArray
from secondary_proc.motion import noise_density
from secondary_proc.track_store import COVARIANCE, STATE

_VX_VX, _VY_VY = 10, 15


class SharpTurns:
    """How far gates must open for turns."""

    def __init__(self, rate: float, usual: float, period: float) -> None:
        """Set what is sharp.

        Args:
            rate: of the sharpest turn, rad/s.
            usual: power spectral density of the acceleration in a usual manoeuvre, m^2/s^3.
            period: of the antenna, s.
        """
        self._density = noise_density(rate)
        self._usual = usual
        self._turning = 2.0 * usual * period

    def densities(
        self,
        predicted: FloatArray,
        confirmed: npt.NDArray[np.bool_],
        misses: npt.NDArray[np.integer],
    ) -> FloatArray:
        """Noise that spreads positions as turns do, where the track may turn.

        It may if it is confirmed and was just seen, or was missed once and knows its velocity so badly that it must
        be turning already.

        Args:
            predicted: the first rows of `Columns.numbers`, shape (rows, n).
            confirmed: whether the track is, shape (n,).
            misses: in a row, shape (n,).

        Returns:
            Power spectral density of the acceleration, that of usual manoeuvres at least, m^2/s^3, shape (n,).
        """
        vx, vy = predicted[STATE][2:]
        covariance = predicted[COVARIANCE]
        turning = covariance[_VX_VX] + covariance[_VY_VY] > self._turning
        allowed = confirmed & (misses <= turning)
        square = vx * vx + vy * vy
        return np.maximum(self._density * square * allowed, self._usual)


def usual_first(
    track: IndexArray, plot: IndexArray, usual: npt.NDArray[np.bool_]
) -> npt.NDArray[np.bool_]:
    """Leave out plots in gates of sharp turns where there is anything usual.

    Args:
        track: of each pair, shape (n,).
        plot: of each pair, shape (n,).
        usual: whether the pair's plot is in its track's usual gate, shape (n,).

    Returns:
        Pairs that stay: the usual ones, and those whose track and whose plot have no usual one, shape (n,).
    """
    served = np.zeros(int(track.max(initial=-1)) + 1, bool)
    served[track[usual]] = True
    claimed = np.zeros(int(plot.max(initial=-1)) + 1, bool)
    claimed[plot[usual]] = True
    return usual | ~(served[track] | claimed[plot])
