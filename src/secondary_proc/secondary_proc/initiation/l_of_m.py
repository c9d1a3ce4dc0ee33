# SPDX-License-Identifier: Apache-2.0
"""Confirmation by l plots in any m scans, m/m among them.

Source: Kuzmin 1967, § 4.3.2.
"""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

import numpy as np

from secondary_proc.calculators.rule_chain import CONFIRMED, IDLE, rule_chain
from secondary_proc.initiation.drop import lowest_score
from secondary_proc.initiation.interface import Evidence, HitGain, IntArray, Verdict

if TYPE_CHECKING:
    from secondary_proc.parameters import TrackerParameters


class LOfM:
    """The rule l/m for tentative tracks."""

    hit_gain: HitGain | None = None

    def __init__(self, parameters: TrackerParameters) -> None:
        """Build the automaton.

        Args:
            parameters: `confirm_hits` is l, `confirm_window` m, `drop_rule` what else ends a track.
        """
        hits, window = parameters.confirm_hits, parameters.confirm_window
        misses = parameters.tentative_misses if parameters.drop_rule == "misses" else None
        self._table = rule_chain(hits, window, misses)
        by_score = parameters.drop_rule == "score"
        self._floor = lowest_score(parameters.missed_targets) if by_score else -inf
        self.longest_gap = min(window - hits + 1, misses if misses is not None else window)

    def opened(self, gap: IntArray) -> IntArray:
        """Memory of tracks that have just been opened by two plots.

        Args:
            gap: turns of the antenna between both plots, 1 to longest_gap, shape (n,).

        Returns:
            State after the first plot and the scans without one, shape (n,).
        """
        states = [self._table[IDLE, 1]]
        while len(states) < self.longest_gap:
            states.append(self._table[states[-1], 0])
        return np.array(states)[gap - 1]

    def judge(self, evidence: Evidence) -> Verdict:
        """Take one more scan into account.

        Args:
            evidence: the tracks after the scan.

        Returns:
            The decision about each.
        """
        state = self._table[evidence.rule, evidence.found.astype(np.intp)]
        dropped = (state == IDLE) | (evidence.score <= self._floor)
        return Verdict(state, state == CONFIRMED, dropped & (state != CONFIRMED))
