# SPDX-License-Identifier: Apache-2.0
"""Automata against the printed table and against plain pattern search."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from primary_proc.automata.automaton import Automaton, Output
from primary_proc.automata.program import Program

# Kuzmin 1967, Table 3.10, states as printed there.
TABLE_3_10 = Automaton(
    np.array([[0, 1], [3, 2], [5, 6], [0, 4], [3, 6], [0, 6], [7, 6], [8, 6], [0, 1]], np.uint8),
    np.array([0, 0, 0, 0, 0, 0, 1, 1, 2], np.uint8),
)
PROGRAMS = ["3/4-2", "3/3-2", "3/3-3", "4/4-2", "4/4-3", "2/3-1", "3/5-2", "1/1-1"]


def outputs(automaton, word):
    state, said = 0, []
    for bit in word:
        state = automaton.following[state, bit]
        said.append(Output(automaton.output[state]))
    return said


def search(program, word):
    """Outputs by definition: l ones within m positions, the newest a one, since the last end; then k zeros."""
    said, since, burst = [], 0, False
    for now, bit in enumerate(word):
        window = word[max(since, now - program.window + 1) : now + 1]
        if not burst and bit and sum(window) >= program.ones:
            burst = True
        tail = word[now - program.zeros + 1 : now + 1]
        if burst and len(tail) == program.zeros and not any(tail):
            burst, since = False, now + 1
            said.append(Output.END)
        else:
            said.append(Output.BURST if burst else Output.NOTHING)
    return said


@pytest.mark.parametrize("name", PROGRAMS)
def test_automaton_is_the_pattern_search_on_all_words_of_12_bits(name):
    program = Program.parse(name)
    automaton = program.automaton
    for word in itertools.product((0, 1), repeat=12):
        assert outputs(automaton, word) == search(program, word), word


def test_three_of_four_is_the_printed_table():
    ours = Program(3, 4, 2).automaton
    assert len(ours) == len(TABLE_3_10) == 9
    pairs, reached = [(0, 0)], {(0, 0)}
    for mine, printed in pairs:
        assert ours.output[mine] == TABLE_3_10.output[printed]
        for bit in (0, 1):
            pair = (int(ours.following[mine, bit]), int(TABLE_3_10.following[printed, bit]))
            if pair not in reached:
                reached.add(pair)
                pairs.append(pair)
    assert len(reached) == 9, "not the same automaton under other numbers"


@pytest.mark.parametrize(("name", "states"), [("3/3-2", 6), ("3/3-3", 7), ("3/4-2", 9)])
def test_number_of_states_is_the_books(name, states):
    assert len(Program.parse(name).automaton) == states


@pytest.mark.parametrize("name", ["4/3-2", "0/3-2", "3/4-0", "3-4/2", "three of four", ""])
def test_impossible_programs_are_refused(name):
    with pytest.raises(ValueError, match="program"):
        Program.parse(name)


def test_a_program_prints_its_name():
    assert str(Program.parse("3/4-2")) == "3/4-2"
