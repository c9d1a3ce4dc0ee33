# SPDX-License-Identifier: Apache-2.0
"""Ratios of the last pulses, for estimators that look at the signal a second time."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from primary_proc.normalisers.normaliser import Normaliser

FloatArray = npt.NDArray[np.float64]

_ROOM = 4


class RatioHistory:
    """Keeps what the open and waiting bursts may still need; an `Envelopes`.

    Attributes:
        ratios: of the pulses kept, shape (pulses, cells).
        first: number of the first of them.
    """

    def __init__(self, normaliser: Normaliser) -> None:
        """Start with no pulse.

        Args:
            normaliser: that the ratios come from.
        """
        self._normaliser = normaliser
        self._buffer = np.zeros((0, len(normaliser.noise_scale)), np.float32)
        self._begin = 0
        self.ratios = self._buffer
        self.first = 0

    def room(self, pulses: int, keep: int) -> npt.NDArray[np.float32]:
        """Make room for the next pulses and forget those that are no longer needed.

        Args:
            pulses: how many.
            keep: number of the oldest pulse still needed.

        Returns:
            Array to write the ratios to, shape (pulses, cells).
        """
        old = min(max(keep - self.first, 0), len(self.ratios))
        kept = len(self.ratios) - old
        begin = self._begin + old
        if begin + kept + pulses > len(self._buffer):
            # Room for several messages, so that what is kept is seldom moved.
            if len(self._buffer) < 2 * (kept + pulses):
                shape = (_ROOM * (kept + pulses), self._buffer.shape[1])
                self._buffer = np.empty(shape, np.float32)
            self._buffer[:kept] = self.ratios[old:]
            begin = 0
        self._begin = begin
        self.ratios = self._buffer[begin : begin + kept + pulses]
        self.first += old
        return self.ratios[kept:]

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
        row = pulse[:, None] - self.first + np.arange(-reach, reach + 1)
        stored = (row >= 0) & (row < len(self.ratios))
        column = np.broadcast_to(ring[:, None], row.shape)
        envelope = np.zeros(row.shape)
        ratio = np.nan_to_num(self.ratios[row[stored], column[stored]].astype(float))
        chance = self._normaliser.exceedance(ratio, column[stored])
        envelope[stored] = np.sqrt(-2.0 * np.log(np.maximum(chance, np.finfo(float).tiny)))
        return envelope
