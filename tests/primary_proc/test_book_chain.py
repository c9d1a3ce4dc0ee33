# SPDX-License-Identifier: Apache-2.0
"""The book's chain against its printed formulas; the values that follow are rows of `radar_eval reproduce`."""

from __future__ import annotations

import numpy as np
import pytest

from primary_proc.automata.accumulator import Accumulator
from primary_proc.automata.book_chain import book_chain, zero_runs
from primary_proc.automata.program import Program
from primary_proc.automata.sequential_rule import SequentialTest

THREE_OF_FOUR = Program(3, 4, 2)
RULES = [
    *(Program.parse(name) for name in ("3/4-2", "3/3-2", "4/4-2", "4/4-3", "3/3-4", "2/5-1")),
    *(Accumulator(5, zeros, first) for zeros in (1, 2, 3, 4) for first in (False, True)),
]


def test_row_30_states_of_three_of_four():
    chain = book_chain(THREE_OF_FOUR)
    states = chain.noise_states(0.1)
    assert states[0] == pytest.approx(0.810211, abs=5e-7)
    assert states[2] == pytest.approx(0.0801307, abs=5e-8)  # P_3, the state "10"
    assert states[chain.detection] == pytest.approx(2.34071e-3, rel=2e-6)


def test_row_28_states_of_three_of_three():
    states = book_chain(Program(3, 3, 2)).noise_states(0.1)
    assert states[[0, 3]] == pytest.approx([0.899091, 8.9909e-4], rel=2e-5)


@pytest.mark.parametrize("capacity", [6, 16, 40])
@pytest.mark.parametrize("zeros", [1, 2, 3, 4])
def test_closed_forms_of_the_accumulators(zeros, capacity):
    """General k of (3.51)-(3.57) and (3.60)-(3.63), the first one by the same argument."""
    p, q = 0.1, 0.9
    run = q**zeros
    between = (
        run / (1.0 + (zeros - 1) * run - (1.0 - run) ** (capacity - zeros + 2))
        if zeros > 1
        else None
    )
    states = book_chain(Accumulator(5, zeros, from_first_one=False), capacity).noise_states(p)
    if between is None:
        assert states == pytest.approx(p ** np.arange(capacity + 1) * q / (1 - p ** (capacity + 1)))
    else:
        waits = np.maximum(np.arange(capacity + 1) - zeros + 1, 0)
        assert states == pytest.approx(between * (1.0 - run) ** waits)
    counted = p * (zeros - 1 + (1.0 - (1.0 - run) ** (capacity - zeros + 1)) / run)
    first = book_chain(Accumulator(5, zeros, from_first_one=True), capacity).noise_states(p)
    assert first[0] == pytest.approx(1.0 / (1.0 + counted))


@pytest.mark.parametrize("rule", RULES, ids=str)
@pytest.mark.parametrize("noise", [0.02, 0.1, 0.3])
def test_closed_forms_are_the_limit_of_the_chain(rule, noise):
    chain = book_chain(rule)
    states = chain.noise_states(noise)
    assert states.sum() == pytest.approx(1.0)
    stepped = chain.step(states, noise, (1 - noise) ** chain.zeros)
    assert stepped == pytest.approx(states, abs=1e-14)


@pytest.mark.parametrize("rule", RULES, ids=str)
def test_probability_is_kept_through_a_burst(rule, ones_of_a_burst):
    states = book_chain(rule).signal_states(0.12, ones_of_a_burst(0.12, 2.5))
    assert states.sum(axis=1) == pytest.approx(1.0)
    assert (states >= 0.0).all()


def test_runs_of_zeros_begin_in_the_noise():
    assert zero_runs(3, 0.1, [0.5, 0.75]) == pytest.approx([0.9 * 0.9 * 0.5, 0.9 * 0.5 * 0.25])


@pytest.mark.parametrize("rule", [Program.parse("3/5-3"), SequentialTest(3, 1, 6, 2, 4)], ids=str)
def test_what_the_book_has_no_chain_for_is_refused(rule):
    with pytest.raises(ValueError, match="closed form"):
        book_chain(rule)
