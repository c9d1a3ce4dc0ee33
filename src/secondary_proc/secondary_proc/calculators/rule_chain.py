# SPDX-License-Identifier: Apache-2.0
"""The automaton of a confirmation rule l/m that also gives a track up after k misses in a row.

Source: Kuzmin 1967, § 4.3.2, (4.15) for m/m and figure 3.16 for 3/4; here for any l, m and k.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import numpy.typing as npt

from secondary_proc.initiation.l_of_m import CONFIRMED, IDLE, automaton

FloatArray = npt.NDArray[np.float64]
StateArray = npt.NDArray[np.intp]

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
    try:
        rule = automaton(hits, window)
    except OverflowError:
        raise ValueError(f"the automaton of {hits}/{window} has too many states") from None
    if len(rule) > _MOST_STATES:
        raise ValueError(f"the automaton of {hits}/{window} has too many states")
    if drop_misses is None:
        return rule.astype(np.intp)
    numbers = {(IDLE, 0): IDLE, (CONFIRMED, 0): CONFIRMED}
    rows: list[list[int]] = []
    pending = list(numbers)
    for state, misses in pending:
        following = []
        for symbol in (0, 1):
            reached = int(rule[state, symbol])
            run = 0 if symbol or reached in (IDLE, CONFIRMED) else misses + 1
            place = (reached, run) if run < drop_misses else (IDLE, 0)
            if place not in numbers:
                numbers[place] = len(numbers)
                pending.append(place)
            following.append(numbers[place])
        rows.append(following)
    return np.array(rows, dtype=np.intp)


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
