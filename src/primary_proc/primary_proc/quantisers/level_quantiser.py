# SPDX-License-Identifier: Apache-2.0
"""Quantisation to a few levels, each with a whole score; with one threshold, the ones of binary quantisation."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from primary_proc.quantisers.quantiser import Quantiser


class LevelQuantiser(Quantiser):
    """Compares ratios with thresholds and gives the score of the level; exact under any normaliser."""

    def __init__(self, thresholds: npt.ArrayLike, scores: npt.ArrayLike, counted: int = 0) -> None:
        """Set the levels.

        Args:
            thresholds: on the ratio of each cell, rising, shape (thresholds, cells).
            scores: whole score of each level, that under the lowest threshold being 0, shape (thresholds + 1,).
            counted: number of the threshold over which cells are counted for the diagnostics.
        """
        self._counted = counted
        self._thresholds = np.asarray(thresholds, np.float32)
        self._steps = np.diff(np.asarray(scores, np.float32))
        self.ones = 0

    def quantise(self, ratios: npt.NDArray[np.float32]) -> npt.NDArray[np.float32]:
        """Quantise some pulses.

        Args:
            ratios: float32, shape (pulses, cells); NaN lies under every threshold.

        Returns:
            Scores as float32, shape (pulses, 1, cells).
        """
        scores = np.zeros((len(ratios), 1, ratios.shape[1]), np.float32)
        over = np.empty(ratios.shape, bool)
        for number, (threshold, step) in enumerate(zip(self._thresholds, self._steps, strict=True)):
            with np.errstate(invalid="ignore"):
                np.greater(ratios, threshold, out=over)
            if number == self._counted:
                self.ones = int(np.count_nonzero(over))
            scores[:, 0] += over * step
        return scores
