# SPDX-License-Identifier: Apache-2.0
"""A sliding-window detector set up: levels of the envelope, their scores, the weights of the pulses, the threshold."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]

_MOST_LEVELS = 96
_UNSEEN = 1e-16


@dataclass(frozen=True, slots=True)
class Window:
    """Everything that decides what the detector does.

    Attributes:
        edges: thresholds of the envelope in units of the noise's sigma, rising, shape (levels - 1,).
        table: whole score of each level on each channel, that of the lowest being zero, shape (channels, levels).
        taps: whole weight of each pulse on each channel, the oldest first, shape (channels, pulses).
        threshold: that the sum must reach.
        false_starts: probability per position that noise does so where the sum before did not.
    """

    edges: FloatArray
    table: FloatArray
    taps: FloatArray
    threshold: float
    false_starts: float

    @property
    def pulses(self) -> int:
        """Length of the register."""
        return self.taps.shape[1]

    @property
    def scores(self) -> FloatArray:
        """What each level adds to the sum at each place of the register, shape (pulses, levels)."""
        return score_table(self.taps, self.table)

    @property
    def level_chances(self) -> FloatArray:
        """Probability that noise exceeds the lower edge of each level, and zero, shape (levels + 1,)."""
        return np.concatenate([[1.0], np.exp(-np.square(self.edges) / 2.0), [0.0]])


def score_table(taps: FloatArray, table: FloatArray) -> FloatArray:
    """What each level adds to the sum at each place of the register.

    Args:
        taps: shape (channels, pulses).
        table: shape (channels, levels).

    Returns:
        Shape (pulses, levels).
    """
    return taps.T @ table


def coarse_levels(edges: FloatArray, scores: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Noise probabilities and scores of the levels, neighbours joined until there are no more than is of use.

    Args:
        edges: thresholds of the envelope, shape (levels - 1,).
        scores: shape (pulses, levels).

    Returns:
        (probability, scores): shapes (joined,) and (pulses, joined); a joined level has the mean score.
    """
    chance = -np.diff(np.concatenate([[1.0], np.exp(-np.square(edges) / 2.0), [0.0]]))
    seen = int(np.count_nonzero(np.cumsum(chance[::-1])[::-1] > _UNSEEN))
    joined = -(-seen // _MOST_LEVELS)
    first = np.arange(0, seen, joined)
    total = np.add.reduceat(chance[:seen], first)
    mean = np.add.reduceat(chance[:seen] * scores[:, :seen], first, axis=1)
    return total, mean / total if joined > 1 else scores[:, :seen]
