# SPDX-License-Identifier: Apache-2.0
"""Ratios of the last pulses, for estimators that look at the signal a second time."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from primary_proc.normalisers.normaliser import Normaliser

FloatArray = npt.NDArray[np.float64]


class RatioHistory:
    """Keeps what the open and waiting bursts may still need; an `Envelopes`."""

    def __init__(self, normaliser: Normaliser) -> None:
        """Start with no pulse.

        Args:
            normaliser: that the ratios come from.
        """
        self._normaliser = normaliser
        cells = len(normaliser.noise_scale)
        self._ratios = np.zeros((0, cells), np.float32)
        self._first = 0

    def append(self, ratios: npt.NDArray[np.float32], first: int, keep: int) -> None:
        """Add pulses and forget those that are no longer needed.

        Args:
            ratios: shape (pulses, cells).
            first: number of the first of them.
            keep: number of the oldest pulse still needed.
        """
        gone = first - self._first != len(self._ratios)
        old = len(self._ratios) if gone else max(keep - self._first, 0)
        kept = self._ratios[old:]
        self._first = first - len(kept)
        self._ratios = np.concatenate([kept, ratios])

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
