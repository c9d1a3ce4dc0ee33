# SPDX-License-Identifier: Apache-2.0
"""Automata against printed tables, plain search on all words, and each other's minimal forms."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from primary_proc.automata.accumulator import Accumulator
from primary_proc.automata.automaton import Automaton, Output, explore
from primary_proc.automata.minimisation import minimised
from primary_proc.automata.program import Program
from primary_proc.automata.sequential_rule import SequentialTest

# Kuzmin 1967, Table 3.10, states as printed there.
TABLE_3_10 = Automaton(
    np.array([[0, 1], [3, 2], [5, 6], [0, 4], [3, 6], [0, 6], [7, 6], [8, 6], [0, 1]], np.uint8),
    np.array([0, 0, 0, 0, 0, 0, 1, 1, 2], np.uint8),
)
PROGRAMS = ["3/4-2", "3/3-2", "3/3-3", "4/4-2", "4/4-3", "2/3-1", "3/5-2", "1/1-1", "2/5-2"]
LATE = ["3/5-3", "3/4-2-late", "2/3-1-late", "4/5-2-late"]
ACCUMULATORS = [
    *(
        Accumulator(5, zeros, first, limit)
        for zeros, first, limit in itertools.product((1, 2, 3), (0, 1), (None, 7))
    ),
    Accumulator(1, 3, from_first_one=True),
]
TESTS = [
    SequentialTest(3, 1, 7, 2, 4),
    SequentialTest(2, 3, 6, 5, 4),
    SequentialTest(1, 1, 2, 1, 2),
]
RULES = [*(Program.parse(name) for name in PROGRAMS + LATE), *ACCUMULATORS, *TESTS]


def outputs(automaton, word):
    state, said = 0, []
    for bit in word:
        state = automaton.following[state, bit]
        said.append(Output(automaton.output[state]))
    return said


def search_program(program, word):
    """Outputs by definition: l ones within m positions, the newest a one, since the last end; then k zeros.

    Late: the m positions are full and begin with a one; zeros at their end may be k, the burst then ends with the next.
    """
    said, since, burst = [], 0, False
    for now, bit in enumerate(word):
        window = word[max(since, now - program.window + 1) : now + 1]
        marked = len(window) == program.window and window[0] if program.late else bit
        declared = not burst and marked and sum(window) >= program.ones
        tail = word[now - program.zeros + 1 : now + 1]
        burst = burst or declared
        if burst and not declared and len(tail) == program.zeros and not any(tail):
            burst, since = False, now + 1
            said.append(Output.END)
        else:
            said.append(Output.BURST if burst else Output.NOTHING)
    return said


def count_positions(rule, word):
    """Outputs by definition of the accumulators: positions since the beginning of the count."""
    said, begin = [], None
    for now, bit in enumerate(word):
        begins = begin is None and (bit or not rule.from_first_one)
        begin = now if begins else begin
        count = 0 if begin is None else now - begin + 1
        tail = [] if begin is None else word[max(begin, now - rule.zeros + 1) : now + 1]
        silent = len(tail) == rule.zeros and not any(tail)
        full = rule.capacity is not None and count > rule.capacity
        if silent or full:
            said.append(Output.END if full or count > rule.threshold else Output.NOTHING)
            begin = None
        else:
            said.append(Output.BURST if count >= rule.threshold else Output.NOTHING)
    return said


def sum_ratios(rule, word):
    """Outputs by definition of the sequential test, the sum kept as a number."""
    said, ratio, burst = [], 0, False
    for bit in word:
        ratio += rule.up if bit else -rule.down
        ended = burst and ratio <= -rule.lower
        declared = not burst and ratio >= rule.upper
        if ended or declared or ratio <= -rule.lower:
            ratio = 0
        burst = (burst or declared) and not ended
        ratio = min(ratio, 0) if burst else ratio
        said.append(Output.END if ended else Output.BURST if burst else Output.NOTHING)
    return said


DEFINITIONS = {Program: search_program, Accumulator: count_positions, SequentialTest: sum_ratios}


@pytest.mark.parametrize("rule", RULES, ids=str)
def test_automaton_follows_the_definition_on_all_words_of_11_bits(rule):
    definition, automaton = DEFINITIONS[type(rule)], rule.automaton
    for word in itertools.product((0, 1), repeat=11):
        assert outputs(automaton, word) == definition(rule, word), word


@settings(deadline=None, max_examples=50)
@given(rule=st.sampled_from(RULES), word=st.lists(st.integers(0, 1), min_size=12, max_size=200))
def test_automaton_follows_the_definition_on_long_words(rule, word):
    assert outputs(rule.automaton, word) == DEFINITIONS[type(rule)](rule, word)


@settings(deadline=None, max_examples=40)
@given(data=st.data())
def test_minimal_form_says_the_same_and_has_no_equivalent_states(data):
    states = data.draw(st.integers(2, 12))
    say = data.draw(st.lists(st.sampled_from(Output), min_size=states, max_size=states))
    say[0] = Output.NOTHING
    allowed = {
        Output.NOTHING: [s for s in range(states) if say[s] != Output.END],
        Output.BURST: [s for s in range(states) if say[s] != Output.NOTHING],
    }
    allowed[Output.END] = allowed[Output.NOTHING]
    table = [
        [data.draw(st.sampled_from(allowed[say[s]] or [s])) for _ in (0, 1)] for s in range(states)
    ]
    automaton = explore(0, lambda state, bit: table[state][bit], lambda state: say[state])
    minimal = minimised(automaton)
    assert len(minimal) <= len(automaton)
    word = data.draw(st.lists(st.integers(0, 1), max_size=40))
    assert outputs(minimal, word) == outputs(automaton, word)
    again = minimised(minimal)
    assert np.array_equal(again.following, minimal.following)
    assert distinguishable(minimal)


def distinguishable(automaton):
    """Whether every two states say something different after some word: table filling, the other textbook way."""
    size = len(automaton)
    apart = automaton.output[:, None] != automaton.output
    for _ in range(size):
        zero, one = automaton.following.T
        apart = apart | apart[np.ix_(zero, zero)] | apart[np.ix_(one, one)]
    return apart[~np.eye(size, dtype=bool)].all()


def test_three_of_four_is_the_printed_table():
    ours, printed = Program(3, 4, 2).automaton, minimised(TABLE_3_10)
    assert len(TABLE_3_10) == 9
    assert np.array_equal(ours.following, printed.following)
    assert np.array_equal(ours.output, printed.output)


@pytest.mark.parametrize(
    ("name", "states", "cells"),
    [("3/3-2", 6, 3), ("3/3-3", 7, 3), ("3/4-2", 9, 4), ("3/5-3", 17, 5), ("3/5-3-early", 14, 4)],
)
def test_numbers_of_states(name, states, cells):
    automaton = Program.parse(name).automaton
    assert (len(automaton), automaton.memory_cells) == (states, cells)


@pytest.mark.parametrize(("zeros", "states", "minimal"), [(2, 34, 33), (3, 49, 46)])
def test_numbers_of_states_of_a_full_accumulator(zeros, states, minimal):
    rule = Accumulator(5, zeros, from_first_one=False, capacity=16)
    assert (len(rule.table), len(rule.automaton)) == (states, minimal)


@pytest.mark.parametrize(
    ("rule", "soonest", "ones"),
    [
        (Program(3, 4, 2), 3, 3),
        (Program.parse("3/5-3"), 5, 3),
        (Accumulator(6, 2, from_first_one=True), 6, 3),
        (Accumulator(6, 3, from_first_one=False), 6, 2),
        (SequentialTest(3, 1, 7, 2, 4), 3, 3),
    ],
    ids=str,
)
def test_quickest_and_cheapest_bursts(rule, soonest, ones):
    assert (rule.automaton.soonest, rule.automaton.fewest_ones) == (soonest, ones)


@pytest.mark.parametrize(
    "name", ["4/3-2", "0/3-2", "3/4-0", "3-4/2", "3/4-2-soon", "three of four", ""]
)
def test_impossible_programs_are_refused(name):
    with pytest.raises(ValueError, match="program"):
        Program.parse(name)


@pytest.mark.parametrize("name", ["3/4-2", "3/5-3", "3/4-2-late", "3/5-3-early"])
def test_a_program_prints_its_name(name):
    assert str(Program.parse(name)) == name


def test_five_positions_are_late_only_in_the_books_program():
    assert Program.parse("3/5-3").late
    assert not Program.parse("3/5-2").late
    assert Program.parse("3/4-2-early") == Program(3, 4, 2)


@pytest.mark.parametrize(
    "make",
    [
        lambda: Accumulator(2, 2, from_first_one=False),
        lambda: Accumulator(0, 2, from_first_one=True),
        lambda: Accumulator(5, 0, from_first_one=True),
        lambda: Accumulator(5, 2, from_first_one=True, capacity=4),
        lambda: SequentialTest(0, 1, 5, 2, 4),
        lambda: SequentialTest(1, 1, 5, 0, 4),
    ],
)
def test_impossible_rules_are_refused(make):
    with pytest.raises(ValueError, match=r"no (accumulator|sequential test)"):
        make()


@pytest.mark.parametrize(
    "rule", [Program(15, 40, 2), Accumulator(1000, 50, from_first_one=True)], ids=str
)
def test_an_automaton_of_too_many_states_is_refused(rule):
    with pytest.raises(ValueError, match="more than"):
        _ = rule.automaton


@pytest.mark.parametrize(
    ("following", "output"),
    [
        ([[0, 2], [0, 1]], [0, 1]),
        ([[0, 0], [1, 1]], [1, 1]),
        ([[0, 1], [0, 1]], [0, 1]),
        ([[1, 0], [0, 0]], [0, 2]),
        ([[0, 1], [1, 1], [0, 0]], [0, 2, 1]),
    ],
    ids=["no such state", "initial burst", "burst without end", "end without burst", "no order"],
)
def test_tables_that_are_no_detectors_are_refused(following, output):
    with pytest.raises(ValueError, match=r"must|does not"):
        Automaton(np.array(following), np.array(output))
