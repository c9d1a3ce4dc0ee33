# SPDX-License-Identifier: Apache-2.0
"""Ratios of the last pulses, for estimators that look at the signal a second time."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from primary_proc.normalisers.normaliser import Normaliser

FloatArray = npt.NDArray[np.float64]

_LEAST = np.finfo(float).tiny


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
        past = self.ratios[old:]
        kept = len(past)
        # What is kept is moved to the front, a few pulses as a rule: the same memory again stays in the cache.
        if kept + pulses > len(self._buffer):
            self._buffer = np.empty((kept + kept // 4 + pulses, past.shape[1]), np.float32)
        self._buffer[:kept] = past
        self.ratios = self._buffer[: kept + pulses]
        self.first += old
        return self.ratios[kept:]

    def restart(self, following: int) -> None:
        """Forget all pulses: the next one does not continue them.

        Args:
            following: number of the next pulse.
        """
        self.ratios, self.first = self._buffer[:0], following

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
        row = (pulse - self.first)[:, None] + np.arange(-reach, reach + 1)
        stored = (row >= 0) & (row < len(self.ratios))
        column = np.broadcast_to(ring[:, None], row.shape).reshape(-1)
        place = np.where(stored, row, 0).reshape(-1) * self.ratios.shape[1] + column
        ratio = self.ratios.reshape(-1)[place].astype(float)
        # A ratio that is no number comes out as one that noise exceeds for certain.
        chance = np.fmin(self._normaliser.exceedance(ratio, column), 1.0)
        envelope = np.sqrt(-2.0 * np.log(np.maximum(chance, _LEAST))).reshape(row.shape)
        return np.where(stored, envelope, 0.0)
