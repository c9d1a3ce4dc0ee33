# SPDX-License-Identifier: Apache-2.0
"""Azimuth and time of the last pulses, to be read between pulses."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from radar_common.frames import wrap_two_pi

FloatArray = npt.NDArray[np.float64]


class PulseLog:
    """Numbers pulses from the start of a stream and remembers where and when the last of them were.

    Attributes:
        next: number of the next pulse.
    """

    def __init__(self) -> None:
        """Start with no pulse."""
        self.next = 0
        self._azimuth = np.zeros(0)
        self._time = np.zeros(0)

    def append(self, azimuth: FloatArray, time: FloatArray, keep: int) -> int:
        """Add pulses and forget those that are no longer needed.

        Args:
            azimuth: rad, shape (n,).
            time: s, shape (n,).
            keep: number of the oldest pulse still needed.

        Returns:
            Number of the first pulse added.
        """
        first = self.next
        old = max(keep - (first - len(self._azimuth)), 0)
        self._azimuth = np.concatenate([self._azimuth[old:], azimuth])
        self._time = np.concatenate([self._time[old:], time])
        self.next += len(azimuth)
        return first

    def at(self, position: npt.ArrayLike) -> tuple[FloatArray, FloatArray]:
        """Interpolate between pulses, also across north.

        Args:
            position: pulse numbers with fractions, shape (n,); outside the log its first or last pulse stands.

        Returns:
            (azimuth, time): rad in [0, 2 pi) and s, shape (n,).
        """
        place = np.asarray(position, dtype=float)
        number = np.arange(self.next - len(self._azimuth), self.next)
        azimuth = self._azimuth
        if np.maximum.reduce(azimuth) - np.minimum.reduce(azimuth) > np.pi:
            # North lies between the pulses; elsewhere there is nothing to unwrap.
            azimuth = np.unwrap(azimuth)
        return (
            wrap_two_pi(np.interp(place, number, azimuth)),
            np.interp(place, number, self._time),
        )
