# SPDX-License-Identifier: Apache-2.0
"""Confirmation by the running likelihood ratio, set by the rate of false tracks that the user accepts.

Source: Wald 1945, upper bound of the sequential test; Kuzmin 1967, (4.14). A miss that brings
the score to the lower bound ends a candidate: a good one lives through more misses than a fixed number would allow.
"""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

import numpy as np

from secondary_proc.initiation.drop import lowest_score
from secondary_proc.initiation.interface import Evidence, HitGain, IntArray, Verdict

if TYPE_CHECKING:
    from secondary_proc.parameters import TrackerParameters


class LikelihoodRatio:
    """Sequential test on the score, for tracks of enough plots."""

    hit_gain: HitGain | None = None

    def __init__(self, parameters: TrackerParameters) -> None:
        """Set the limits.

        Args:
            parameters: `confirm_hits` are the plots that a track needs at least, `drop_rule` what ends it.
        """
        self._hits = parameters.confirm_hits
        by_score = parameters.drop_rule != "misses"
        self._floor = lowest_score(parameters.missed_targets) if by_score else -inf
        self._misses = inf if by_score else parameters.tentative_misses
        self.longest_gap = parameters.tentative_misses

    def opened(self, gap: IntArray) -> IntArray:
        """Memory of tracks that have just been opened by two plots.

        Args:
            gap: turns of the antenna between both plots, 1 to longest_gap, shape (n,).

        Returns:
            Zeros, shape (n,): the score is memory enough.
        """
        return np.zeros(len(gap), np.intp)

    def judge(self, evidence: Evidence) -> Verdict:
        """Take one more scan into account.

        Args:
            evidence: the tracks after the scan.

        Returns:
            The decision about each.
        """
        sure = (evidence.score >= evidence.threshold) & (evidence.hits >= self._hits)
        dropped = (evidence.misses >= self._misses) | (
            (evidence.score <= self._floor) & ~evidence.found
        )
        return Verdict(evidence.rule, evidence.found & sure, dropped)
