# SPDX-License-Identifier: Apache-2.0
"""What the tracker asks of a rule that confirms and drops tentative tracks."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
import numpy.typing as npt

IntArray = npt.NDArray[np.integer]
BoolArray = npt.NDArray[np.bool_]
FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Evidence:
    """Tentative tracks after a scan, one row each.

    Attributes:
        rule: what the rule remembers of them, shape (n,).
        found: whether the scan brought a plot, shape (n,).
        hits: plots in the track, shape (n,).
        misses: scans without a plot since the last one, shape (n,).
        score: logarithmic likelihood ratio, shape (n,).
        threshold: of the score for the wanted rate of false tracks.
    """

    rule: IntArray
    found: BoolArray
    hits: IntArray
    misses: IntArray
    score: FloatArray
    threshold: float


@dataclass(frozen=True, slots=True)
class Verdict:
    """What becomes of the tracks: new memory of the rule, confirmed, dropped; shapes (n,)."""

    rule: IntArray
    confirmed: BoolArray
    dropped: BoolArray


class HitGain(Protocol):
    """Gain of the score by any plot in a gate."""

    def __call__(self, determinant: FloatArray, density: FloatArray) -> FloatArray:
        """Calculate the gain.

        Args:
            determinant: of the covariance of the predicted difference, m^4, shape (n,).
            density: false plots per square metre, shape (n,).

        Returns:
            Gain, shape (n,).
        """
        ...


class Initiation(Protocol):
    """Decides about tentative tracks, all at once."""

    longest_gap: int
    """Turns of the antenna that may lie between the first two plots."""

    @property
    def hit_gain(self) -> HitGain | None:
        """What any plot in the gate adds to the score; None where it counts at what place in the gate the plot lies."""
        ...

    def opened(self, gap: IntArray) -> IntArray:
        """Memory of tracks that have just been opened by two plots.

        Args:
            gap: turns of the antenna between both plots, 1 to longest_gap, shape (n,).

        Returns:
            The rule's memory before the second plot is judged, shape (n,).
        """
        ...

    def judge(self, evidence: Evidence) -> Verdict:
        """Take one more scan into account.

        Args:
            evidence: the tracks after the scan.

        Returns:
            The decision about each.
        """
        ...
