# SPDX-License-Identifier: Apache-2.0
"""Ratios of the last pulses, for estimators that look at the signal a second time."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from primary_proc.normalisers.normaliser import Normaliser

FloatArray = npt.NDArray[np.float64]

_ROOM = 4


class RatioHistory:
    """Keeps what the open and waiting bursts may still need; an `Envelopes`."""

    def __init__(self, normaliser: Normaliser) -> None:
        """Start with no pulse.

        Args:
            normaliser: that the ratios come from.
        """
        self._normaliser = normaliser
        self._buffer = np.zeros((0, len(normaliser.noise_scale)), np.float32)
        self._ratios = self._buffer
        self._begin = self._first = 0

    def append(self, ratios: npt.NDArray[np.float32], first: int, keep: int) -> None:
        """Add pulses and forget those that are no longer needed.

        Args:
            ratios: shape (pulses, cells).
            first: number of the first of them.
            keep: number of the oldest pulse still needed.
        """
        count = len(self._ratios)
        gone = first - self._first != count
        old = count if gone else min(max(keep - self._first, 0), count)
        kept, added = count - old, len(ratios)
        begin = self._begin + old
        if begin + kept + added > len(self._buffer):
            # Room for several messages, so that what is kept is seldom moved.
            if len(self._buffer) < 2 * (kept + added):
                shape = (_ROOM * (kept + added), self._buffer.shape[1])
                self._buffer = np.empty(shape, np.float32)
            self._buffer[:kept] = self._ratios[old:]
            begin = 0
        self._buffer[begin + kept : begin + kept + added] = ratios
        self._ratios = self._buffer[begin : begin + kept + added]
        self._begin, self._first = begin, first - kept

    def around(
        self, ring: npt.NDArray[np.integer], pulse: npt.NDArray[np.integer], reach: int
    ) -> FloatArray:
        """Give the pulses around a place; see `Envelopes.around`.

        Args:
            ring: range cells, shape (n,).
            pulse: number of the pulse in the middle, shape (n,).
            reach: pulses to either side.

        Returns:
            Envelope over the noise's sigma, shape (n, 2 reach + 1).
        """
        row = pulse[:, None] - self._first + np.arange(-reach, reach + 1)
        stored = (row >= 0) & (row < len(self._ratios))
        column = np.broadcast_to(ring[:, None], row.shape)
        envelope = np.zeros(row.shape)
        ratio = np.nan_to_num(self._ratios[row[stored], column[stored]].astype(float))
        chance = self._normaliser.exceedance(ratio, column[stored])
        envelope[stored] = np.sqrt(-2.0 * np.log(np.maximum(chance, np.finfo(float).tiny)))
        return envelope
