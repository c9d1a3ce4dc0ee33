# SPDX-License-Identifier: Apache-2.0
"""Confirmation by the running likelihood ratio, set by the rate of false tracks that the user accepts.

Source: Wald 1945, upper bound of the sequential test; Kuzmin 1967, (4.14). Weak candidates end by misses instead of
the lower bound, so that a target's track is not lost to one unlucky plot.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from secondary_proc.initiation.interface import ByteArray, Evidence, Verdict


class LikelihoodRatio:
    """Sequential test on the score, for tracks of enough plots."""

    def __init__(self, hits: int, misses: int) -> None:
        """Set the limits.

        Args:
            hits: plots that a track needs at least.
            misses: scans in a row without a plot that end it.
        """
        self._hits = hits
        self._misses = misses
        self.longest_gap = misses

    def opened(self, gap: npt.NDArray[np.integer]) -> ByteArray:
        """Memory of tracks that have just been opened by two plots.

        Args:
            gap: turns of the antenna between both plots, 1 to longest_gap, shape (n,).

        Returns:
            Zeros, shape (n,): the score is memory enough.
        """
        return np.zeros(len(gap), np.uint8)

    def judge(self, evidence: Evidence) -> Verdict:
        """Take one more scan into account.

        Args:
            evidence: the tracks after the scan.

        Returns:
            The decision about each.
        """
        sure = (evidence.score >= evidence.threshold) & (evidence.hits >= self._hits)
        return Verdict(evidence.rule, evidence.found & sure, evidence.misses >= self._misses)
