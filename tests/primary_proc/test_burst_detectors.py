# SPDX-License-Identifier: Apache-2.0
"""Binary detectors: equal to the automaton stepped bit by bit, to each other, and to themselves in pieces."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from primary_proc.automata.accumulator import Accumulator
from primary_proc.automata.automaton import Output
from primary_proc.automata.program import Program
from primary_proc.automata.sequential_rule import SequentialTest
from primary_proc.detectors.burst_detector import bursts
from primary_proc.detectors.program_detector import ProgramDetector
from primary_proc.detectors.table_detector import TableDetector

NO_LIMIT = 10**6
PARALLEL = [
    Program.parse(name)
    for name in (
        "3/4-2",
        "3/3-2",
        "4/4-2",
        "4/4-3",
        "3/4-3",
        "4/5-2",
        "1/1-1",
        "3/5-3",
        "3/4-2-late",
    )
]
TABLES = [
    Program.parse("2/4-2"),
    Program.parse("2/5-2-late"),
    Accumulator(5, 2, from_first_one=False),
    Accumulator(5, 2, from_first_one=True, capacity=9),
    Accumulator(150, 3, from_first_one=True),
    SequentialTest(3, 1, 9, 2, 6),
]
DETECTORS = [(ProgramDetector, rule) for rule in PARALLEL]
DETECTORS += [(TableDetector, rule) for rule in PARALLEL[:2] + TABLES]


@pytest.fixture(scope="module")
def run(packed):
    """Feed bits in pieces; list the bursts as (ring, start, end, overflow) in order, and those left open."""

    def feed(detector, bits, cuts=()):
        found, first = [], 0
        for part in filter(len, np.split(bits, cuts)):
            found.append(detector.detect(packed(part), first))
            first += len(part)
        for table in found:
            order = np.lexsort((table["ring"], table["end"]))
            assert (order == np.arange(len(table))).all()
        table = np.concatenate(found)
        going = detector.open_bursts()
        assert (np.diff(going["ring"]) > 0).all()
        return (
            sorted(table[["ring", "start", "end", "overflow"]].tolist()),
            sorted(going[["ring", "start"]].tolist()),
        )

    return feed


def stepped(rule, bits, longest):
    """What a detector must give, bit by bit and ring by ring."""
    automaton = rule.automaton
    closed, going = [], []
    for ring, word in enumerate(bits.T.astype(int)):
        state, start, silent = 0, None, False
        for now, bit in enumerate(word):
            state = automaton.following[state, bit]
            said = automaton.output[state]
            if said == Output.BURST and start is None:
                start, silent = now, False
            if said == Output.END:
                if not silent:
                    closed.append((ring, start, now, False))
                start = None
            elif start is not None and not silent and now - start >= longest:
                closed.append((ring, start, now, True))
                silent = True
        if start is not None and not silent:
            going.append((ring, start))
    return sorted(closed), going


@settings(deadline=None, max_examples=100)
@given(data=st.data())
def test_detector_is_the_automaton_however_the_pulses_are_cut(run, data):
    kind, rule = data.draw(st.sampled_from(DETECTORS))
    rings = data.draw(st.integers(1, 70))
    pulses = data.draw(st.integers(1, 60))
    longest = data.draw(st.sampled_from([2, 5, 12, NO_LIMIT]))
    share = data.draw(st.sampled_from([0.1, 0.5, 0.8, 0.97]))
    cuts = sorted(data.draw(st.lists(st.integers(1, pulses), unique=True, max_size=5)))
    bits = np.random.default_rng(data.draw(st.integers(0, 2**32))).random((pulses, rings)) < share
    expected = stepped(rule, bits, longest)
    assert run(kind(rule, rings, longest), bits) == expected
    assert run(kind(rule, rings, longest), bits, cuts) == expected


def test_counts_beyond_255_states(run):
    rule = Accumulator(150, 3, from_first_one=True)
    assert len(rule.automaton) > 255
    bits = np.array([0, *[1, 0, 0] * 60, 0, 0], bool)[:, None]
    assert run(TableDetector(rule, 1, NO_LIMIT), bits, [100]) == ([(0, 150, 181, False)], [])


@pytest.mark.parametrize(("kind", "rule"), DETECTORS, ids=str)
def test_memory_reaches_back_to_the_first_one(kind, rule):
    ones = 0 if isinstance(rule, SequentialTest) else rule.automaton.soonest - 1
    assert kind(rule, 8, 100).memory >= ones


@pytest.mark.parametrize("kind", [ProgramDetector, TableDetector])
def test_a_burst_over_its_limit_is_ended_once(kind, run):
    bits = np.array([1] * 30 + [0, 0] + [1] * 4 + [0, 0], bool)[:, None]
    closed, still_open = run(kind(Program(3, 4, 2), 1, 10), bits, [7, 20])
    assert closed == [(0, 2, 12, True), (0, 34, 37, False)]
    assert still_open == []


@pytest.mark.parametrize("kind", [ProgramDetector, TableDetector])
def test_a_burst_that_ends_at_its_limit_ends_by_itself(kind, run):
    bits = np.array([1] * 5 + [0, 0], bool)[:, None]
    assert run(kind(Program(3, 4, 2), 1, 4), bits)[0] == [(0, 2, 6, False)]


@pytest.mark.parametrize(("kind", "rule"), DETECTORS, ids=str)
def test_reset_forgets(kind, rule, packed):
    detector = kind(rule, 3, NO_LIMIT)
    long = rule.automaton.soonest
    detector.detect(packed(np.ones((long, 3), bool)), 0)
    assert len(detector.open_bursts()) == 3
    detector.reset()
    assert len(detector.open_bursts()) == 0
    short = np.ones((long, 3), bool)
    short[-1] = False
    assert len(detector.detect(packed(short), long)) == 0
    late = (isinstance(rule, Program) and rule.late) or isinstance(rule, Accumulator)
    assert len(detector.open_bursts()) == (3 if late else 0)


def test_a_program_that_looks_across_an_end_has_no_parallel_form():
    with pytest.raises(ValueError, match="table"):
        ProgramDetector(Program(2, 4, 2), 8, NO_LIMIT)


def test_bursts_make_a_table():
    table = bursts([3, 4], [10, 11], 20, False)
    assert table["end"].tolist() == [20, 20]
    assert not table["overflow"].any()
