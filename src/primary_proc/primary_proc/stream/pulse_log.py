# SPDX-License-Identifier: Apache-2.0
"""Azimuth and time of the last pulses, to be read between pulses."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from radar_common.frames import TWO_PI, wrap_two_pi

FloatArray = npt.NDArray[np.float64]


class PulseLog:
    """Numbers pulses from the start of a stream and remembers where and when the last of them were.

    Attributes:
        next: number of the next pulse.
    """

    def __init__(self) -> None:
        """Start with no pulse."""
        self.next = 0
        self._pulses = np.zeros((2, 0))

    def append(self, azimuth: FloatArray, time: FloatArray, keep: int) -> int:
        """Add pulses and forget those that are no longer needed.

        Args:
            azimuth: rad, shape (n,).
            time: s, shape (n,).
            keep: number of the oldest pulse still needed.

        Returns:
            Number of the first pulse added.
        """
        first, known = self.next, self._pulses.shape[1]
        old = max(keep - (first - known), 0)
        pulses = np.empty((2, known - old + len(azimuth)))
        pulses[:, : known - old] = self._pulses[:, old:]
        pulses[0, known - old :], pulses[1, known - old :] = azimuth, time
        self._pulses = pulses
        self.next += len(azimuth)
        return first

    def at(self, position: npt.ArrayLike) -> tuple[FloatArray, FloatArray]:
        """Interpolate between pulses, also across north.

        Args:
            position: pulse numbers with fractions, shape (n,); outside the log its first or last pulse stands.

        Returns:
            (azimuth, time): rad in [0, 2 pi) and s, shape (n,).
        """
        known = self._pulses.shape[1]
        place = np.asarray(position) - (self.next - known)
        place = np.minimum(np.maximum(place, 0.0), known - 1)
        before = place.astype(np.int64)
        here = self._pulses[:, before]
        advance = self._pulses.take(before + 1, axis=1, mode="clip") - here
        advance[0] -= TWO_PI * np.rint(advance[0] / TWO_PI)
        here += (place - before) * advance
        return wrap_two_pi(here[0]), here[1]
