# SPDX-License-Identifier: Apache-2.0
"""The two forms of a program detector: equal to each other, to the automaton, and to themselves in pieces."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from primary_proc.automata.automaton import Output
from primary_proc.automata.program import Program
from primary_proc.detectors.burst_detector import bursts
from primary_proc.detectors.program_detector import ProgramDetector
from primary_proc.detectors.table_detector import TableDetector

NO_LIMIT = 10**6
PARALLEL = ["3/4-2", "3/3-2", "4/4-2", "4/4-3", "3/4-3", "4/5-2", "1/1-1"]
DETECTORS = [ProgramDetector, TableDetector]


def packed(bits):
    wide = np.zeros((len(bits), -(-bits.shape[1] // 64) * 64), bool)
    wide[:, : bits.shape[1]] = bits
    return np.packbits(wide.reshape(-1)).view(np.uint64).reshape(len(bits), -1)


def run(detector, bits, cuts=()):
    """Feed bits in pieces; list the bursts as (ring, start, end, overflow) in order, and those left open."""
    found, first = [], 0
    for part in filter(len, np.split(bits, cuts)):
        found.append(detector.detect(packed(part), first))
        first += len(part)
    table = np.concatenate(found)
    return (
        sorted(table[["ring", "start", "end", "overflow"]].tolist()),
        sorted(detector.open_bursts()[["ring", "start"]].tolist()),
    )


@pytest.mark.parametrize("kind", DETECTORS)
def test_all_words_of_12_bits_at_once(kind):
    """One ring a word: starts and ends are those of the automaton's outputs."""
    program = Program(3, 4, 2)
    words = np.array(list(itertools.product((0, 1), repeat=12)), bool)
    automaton = program.automaton
    state = np.zeros(len(words), np.uint8)
    said = np.zeros((13, len(words)), np.uint8)
    for position, bits in enumerate(words.T, start=1):
        state = automaton.following[state, bits.astype(int)]
        said[position] = automaton.output[state]
    closed, still_open = [], []
    for ring, outputs in enumerate(said.T):
        start = None
        for position in range(1, 13):
            if outputs[position] == Output.BURST and outputs[position - 1] != Output.BURST:
                start = position - 1
            elif outputs[position] == Output.END:
                closed.append((ring, start, position - 1, False))
                start = None
        if start is not None:
            still_open.append((ring, start))
    assert len(closed) > 1000
    assert run(kind(program, len(words), NO_LIMIT), words.T) == (closed, still_open)


@settings(deadline=None, max_examples=60)
@given(data=st.data())
def test_both_forms_agree_however_the_pulses_are_cut(data):
    program = Program.parse(data.draw(st.sampled_from(PARALLEL)))
    rings = data.draw(st.integers(1, 130))
    pulses = data.draw(st.integers(1, 60))
    longest = data.draw(st.sampled_from([2, 5, 12, NO_LIMIT]))
    share = data.draw(st.sampled_from([0.1, 0.5, 0.8, 0.97]))
    cuts = sorted(data.draw(st.lists(st.integers(1, pulses), unique=True, max_size=5)))
    bits = np.random.default_rng(data.draw(st.integers(0, 2**32))).random((pulses, rings)) < share
    reference = run(TableDetector(program, rings, longest), bits)
    assert run(ProgramDetector(program, rings, longest), bits) == reference
    assert run(ProgramDetector(program, rings, longest), bits, cuts) == reference


@pytest.mark.parametrize("kind", DETECTORS)
def test_a_burst_over_its_limit_is_ended_once(kind):
    bits = np.array([1] * 30 + [0, 0] + [1] * 4 + [0, 0], bool)[:, None]
    closed, still_open = run(kind(Program(3, 4, 2), 1, 10), bits, [7, 20])
    assert closed == [(0, 2, 12, True), (0, 34, 37, False)]
    assert still_open == []


@pytest.mark.parametrize("kind", DETECTORS)
def test_a_burst_that_ends_at_its_limit_ends_by_itself(kind):
    bits = np.array([1] * 5 + [0, 0], bool)[:, None]
    assert run(kind(Program(3, 4, 2), 1, 4), bits)[0] == [(0, 2, 6, False)]


@pytest.mark.parametrize("kind", DETECTORS)
def test_reset_forgets(kind):
    detector = kind(Program(3, 4, 2), 3, NO_LIMIT)
    detector.detect(packed(np.ones((5, 3), bool)), 0)
    assert len(detector.open_bursts()) == 3
    detector.reset()
    assert len(detector.open_bursts()) == 0
    assert len(detector.detect(packed(np.array([[1, 1, 1], [1, 1, 1], [0, 0, 0]], bool)), 5)) == 0
    assert len(detector.open_bursts()) == 0


def test_a_program_that_looks_across_an_end_has_no_parallel_form():
    with pytest.raises(ValueError, match="table"):
        ProgramDetector(Program(2, 4, 2), 8, NO_LIMIT)


def test_bursts_make_a_table():
    table = bursts([3, 4], [10, 11], 20, False)
    assert table["end"].tolist() == [20, 20]
    assert not table["overflow"].any()
