# SPDX-License-Identifier: Apache-2.0
"""Accumulators in noise, exactly and without a limit of the count: closed forms beside the chain of the automaton."""

from __future__ import annotations

import numpy as np

from primary_proc.automata.accumulator import Accumulator


def unbroken_probability(positions: int, zeros: int, noise: float) -> float:
    """Probability u_n that n fresh positions hold no k zeros in a row.

    u_n = 1 for n < k, else the sum over j = 1 ... k of p q^(j-1) u_(n-j): the first one stands at j.

    Args:
        positions: n.
        zeros: k.
        noise: probability p_N of a one.

    Returns:
        Probability.
    """
    first_one = noise * (1.0 - noise) ** np.arange(zeros)
    unbroken = np.ones(max(positions + 1, zeros))
    for n in range(zeros, positions + 1):
        unbroken[n] = first_one @ unbroken[n - 1 : n - zeros - 1 if n > zeros else None : -1]
    return float(unbroken[positions])


def unlimited_false_starts(accumulator: Accumulator, noise: float) -> float:
    """Probability per azimuth position that noise makes the accumulator declare a burst.

    Between series of zeros a count begins anew with the probability p q^k / (1 - q^k); from the first one with p q^k.
    The rest is that no k zeros in a row come before L.

    Args:
        accumulator: its capacity is taken as unlimited.
        noise: probability p_N of a one.

    Returns:
        Probability.
    """
    series = (1.0 - noise) ** accumulator.zeros
    if accumulator.from_first_one:
        unbroken = unbroken_probability(accumulator.threshold - 1, accumulator.zeros, noise)
        return noise * series * unbroken
    unbroken = unbroken_probability(accumulator.threshold, accumulator.zeros, noise)
    return noise * series / (1.0 - series) * unbroken
