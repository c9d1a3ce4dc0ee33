# SPDX-License-Identifier: Apache-2.0
"""Confirmation by l plots in any m scans, as an automaton.

Source: Kuzmin 1967, § 4.3.2, figure 3.16 for 3/4. The automaton for any l and m is built here by enumeration: a state
is what has been seen since the oldest plot that can still count.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import numpy.typing as npt

from secondary_proc.initiation.interface import ByteArray, Evidence, Verdict

IDLE = 0
CONFIRMED = 1

_Word = tuple[int, ...]


@lru_cache
def automaton(hits: int, window: int) -> ByteArray:
    """Build the automaton of the rule l/m.

    Args:
        hits: plots needed, l.
        window: scans in which they must fall, m >= l.

    Returns:
        Next state by state and symbol (0 without a plot, 1 with one), shape (states, 2). State IDLE is the start,
        CONFIRMED is never left.
    """
    numbers: dict[_Word, int] = {(): IDLE}
    table: dict[int, list[int]] = {CONFIRMED: [CONFIRMED, CONFIRMED]}
    open_words: list[_Word] = [()]
    while open_words:
        word = open_words.pop(0)
        following = []
        for symbol in (0, 1):
            longer = (*word, symbol)
            if symbol and sum(longer[-window:]) >= hits:
                following.append(CONFIRMED)
                continue
            kept = _still_useful(longer, hits, window)
            if kept not in numbers:
                numbers[kept] = len(numbers) + 1
                open_words.append(kept)
            following.append(numbers[kept])
        table[numbers[word]] = following
    return np.array([table[state] for state in range(len(table))], dtype=np.uint8)


def _still_useful(word: _Word, hits: int, window: int) -> _Word:
    for begin, symbol in enumerate(word):
        scans_left = window - (len(word) - begin)
        if symbol and scans_left >= 0 and sum(word[begin:]) + scans_left >= hits:
            return word[begin:]
    return ()


class LOfM:
    """The rule l/m for tentative tracks."""

    def __init__(self, hits: int, window: int) -> None:
        """Build the automaton.

        Args:
            hits: plots needed, l.
            window: scans in which they must fall, m >= l.
        """
        self._table = automaton(hits, window)
        self.longest_gap = window - hits + 1

    def opened(self, gap: npt.NDArray[np.integer]) -> ByteArray:
        """Memory of tracks that have just been opened by two plots.

        Args:
            gap: turns of the antenna between both plots, 1 to longest_gap, shape (n,).

        Returns:
            State after the first plot and the scans without one, shape (n,).
        """
        states = [self._table[IDLE, 1]]
        while len(states) < self.longest_gap:
            states.append(self._table[states[-1], 0])
        return np.array(states, dtype=np.uint8)[gap - 1]

    def judge(self, evidence: Evidence) -> Verdict:
        """Take one more scan into account.

        Args:
            evidence: the tracks after the scan.

        Returns:
            The decision about each.
        """
        state = self._table[evidence.rule, evidence.found.astype(np.intp)]
        return Verdict(state, state == CONFIRMED, state == IDLE)
