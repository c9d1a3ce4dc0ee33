# SPDX-License-Identifier: Apache-2.0
"""The automaton of a rule that confirms by l plots in any m scans and may give up after k misses in a row.

Source: Kuzmin 1967, § 4.3.2, (4.15) for m/m and figure 3.16 for 3/4. For any l, m and k it is built here by
enumeration: a state is what has been seen since the oldest plot that can still count. The tracker steps it by plots,
the calculators by probabilities.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import numpy.typing as npt

IDLE = 0
CONFIRMED = 1

FloatArray = npt.NDArray[np.float64]
StateArray = npt.NDArray[np.intp]
_Word = tuple[int, ...]

_MOST_STATES = 256


@lru_cache
def rule_chain(hits: int, window: int, drop_misses: int | None = None) -> StateArray:
    """Build the automaton.

    Args:
        hits: plots needed, l.
        window: scans in which they must fall, m >= l; m/m is the rule of plots in a row.
        drop_misses: misses in a row after which the track is given up, k; None leaves it to the rule alone.

    Returns:
        Next state by state and symbol (0 without a plot, 1 with one), shape (states, 2). State IDLE is the start,
        CONFIRMED is never left.

    Raises:
        ValueError: there is no such rule, or its automaton has more than 256 states.
    """
    if not 1 <= hits <= window or (drop_misses is not None and drop_misses < 1):
        raise ValueError(f"no rule {hits}/{window} that drops after {drop_misses} misses")
    numbers: dict[_Word, int] = {(): IDLE}
    table: dict[int, list[int]] = {CONFIRMED: [CONFIRMED, CONFIRMED]}
    open_words: list[_Word] = [()]
    for word in open_words:
        following = []
        for symbol in (0, 1):
            longer = (*word, symbol)
            if symbol and sum(longer[-window:]) >= hits:
                following.append(CONFIRMED)
                continue
            kept = _still_useful(longer, hits, window)
            if drop_misses is not None and not any(kept[-drop_misses:]):
                kept = ()
            if kept not in numbers:
                numbers[kept] = len(numbers) + 1
                open_words.append(kept)
            following.append(numbers[kept])
        table[numbers[word]] = following
        if len(open_words) >= _MOST_STATES:
            raise ValueError(f"the automaton of {hits}/{window} has too many states")
    return np.array([table[state] for state in range(len(table))], dtype=np.intp)


def step(chain: StateArray, state: FloatArray, found: npt.ArrayLike) -> FloatArray:
    """Let one scan pass.

    Args:
        chain: from `rule_chain`.
        state: probabilities of the states, shape (states, ...).
        found: probability of a plot, any shape that fits the trailing one.

    Returns:
        Probabilities after the scan, same shape.
    """
    following = np.zeros_like(state)
    np.add.at(following, chain[:, 0], state * (1.0 - np.asarray(found)))
    np.add.at(following, chain[:, 1], state * np.asarray(found))
    return following


def _still_useful(word: _Word, hits: int, window: int) -> _Word:
    for begin, symbol in enumerate(word):
        scans_left = window - (len(word) - begin)
        if symbol and scans_left >= 0 and sum(word[begin:]) + scans_left >= hits:
            return word[begin:]
    return ()
