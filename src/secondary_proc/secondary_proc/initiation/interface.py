# SPDX-License-Identifier: Apache-2.0
"""What the tracker asks of a rule that confirms and drops tentative tracks."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
import numpy.typing as npt

ByteArray = npt.NDArray[np.uint8]
BoolArray = npt.NDArray[np.bool_]


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

    rule: npt.NDArray[np.integer]
    found: BoolArray
    hits: npt.NDArray[np.integer]
    misses: npt.NDArray[np.integer]
    score: npt.NDArray[np.float64]
    threshold: float


@dataclass(frozen=True, slots=True)
class Verdict:
    """What becomes of the tracks: new memory of the rule, confirmed, dropped; shapes (n,)."""

    rule: npt.NDArray[np.integer]
    confirmed: BoolArray
    dropped: BoolArray


class Initiation(Protocol):
    """Decides about tentative tracks, all at once."""

    longest_gap: int
    """Turns of the antenna that may lie between the first two plots."""

    def opened(self, gap: npt.NDArray[np.integer]) -> ByteArray:
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
