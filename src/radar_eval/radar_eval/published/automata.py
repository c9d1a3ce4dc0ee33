# SPDX-License-Identifier: Apache-2.0
"""State counts, tables and logic of the detecting automata (Kuzmin 1967, § 3.2.3-3.2.5, Tables 3.6-3.11)."""

from __future__ import annotations

import ast
import inspect
import itertools
from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from primary_proc.automata.accumulator import Accumulator
from primary_proc.automata.automaton import Automaton, Output
from primary_proc.automata.minimisation import minimised
from primary_proc.automata.program import Program
from radar_eval.published.result import Row

_CAPACITY = 16
_WORD = 11
_CONTROL_PART = Automaton(
    np.array([[1, 1, 4, 4, 6, 4, 8, 4, 1], [2, 2, 3, 3, 5, 3, 7, 3, 2]]).T,
    np.array([0, 0, 1, 1, 1, 1, 1, 1, 2]),
)
"""Table 3.7."""
_MINIMAL_CONTROL_PART = Automaton(
    np.array([[0, 2, 3, 4, 0], [1, 1, 1, 1, 1]]).T, np.array([0, 1, 1, 1, 2])
)
"""Table 3.8."""
_THREE_OF_FOUR = Automaton(
    np.array([[0, 3, 5, 0, 3, 0, 8, 8, 10, 8, 0], [1, 2, 6, 4, 6, 6, 7, 7, 9, 7, 1]]).T,
    np.array([0] * 6 + [1] * 4 + [2]),
)
"""Table 3.9."""
_MINIMAL_THREE_OF_FOUR = Automaton(
    np.array([[0, 3, 5, 0, 3, 0, 7, 8, 0], [1, 2, 6, 4, 6, 6, 6, 6, 1]]).T,
    np.array([0] * 6 + [1] * 2 + [2]),
)
"""Table 3.10."""
_Bits = npt.NDArray[np.bool_]


def automata() -> Iterator[Row]:
    """Generate the automata.

    Yields:
        State counts, memory cells, differences from the printed tables, and the logic of 3/5-3.
    """
    yield from _between_series()
    yield from _control_part()
    for name, states, cells in (
        ("3/3-2", 6, 3),
        ("3/3-3", 7, 3),
        ("3/4-2", 9, 4),
        ("3/5-3", 17, 5),
    ):
        ours = Program.parse(name).automaton
        printed = None if name == "3/3-3" else float(states)
        yield Row(f"{name}: states", printed, states, len(ours), 0.0)
        yield Row(f"{name}: memory cells", printed and float(cells), cells, ours.memory_cells, 0.0)
    yield Row("Table 3.9, 3/4-2: states before minimising", 11.0, 11.0, len(_THREE_OF_FOUR), 0.0)
    yield _same("Table 3.9 minimised and Table 3.10", _THREE_OF_FOUR, _MINIMAL_THREE_OF_FOUR)
    yield _same("3/4-2 and Table 3.10", Program(3, 4, 2).automaton, _MINIMAL_THREE_OF_FOUR)
    yield from _logic()


def declares(x1: _Bits, x2: _Bits, x3: _Bits, x4: _Bits, x5: _Bits) -> _Bits:
    """P_o of (3.46): whether 3/5-3 declares a burst on the last of five bits.

    Args:
        x1: oldest bit, any shape.
        x2: next, same shape.
        x3: next, same shape.
        x4: next, same shape.
        x5: newest bit, same shape.

    Returns:
        Same shape.
    """
    return x1 & ((x2 | x5) & (x3 | x4) | x2 & x5 | x3 & x4)


def ends(x3: _Bits, x4: _Bits, x5: _Bits) -> _Bits:
    """P_k of § 3.2.5: whether 3/5-3 ends a burst on the last of three bits.

    Args:
        x3: oldest bit, any shape.
        x4: next, same shape.
        x5: newest bit, same shape.

    Returns:
        Same shape.
    """
    return ~x3 & ~x4 & ~x5


def _between_series() -> Iterator[Row]:
    accumulator = Accumulator(5, 2, from_first_one=False, capacity=_CAPACITY)
    table = accumulator.table
    states = 2 * _CAPACITY + 2
    yield Row(
        "accumulator between series, k = 2, M = 16: states 2M + 2", states, states, len(table), 0
    )
    yield Row(
        "accumulator between series, k = 2, M = 16: memory cells", 5.0, 6.0,
        float(table.memory_cells), 0.0,
        "34 states need 6 cells, and so do the 33 that are left after minimising; 5 cells hold M = 15",
    )  # fmt: skip
    yield Row(
        "accumulator between series, k = 2, M = 16: states after minimising", None, 33.0,
        float(len(accumulator.automaton)), 0.0,
    )  # fmt: skip
    yield _same("accumulator between series and Table 3.6", table, _table_3_6(5, _CAPACITY))


def _table_3_6(threshold: int, capacity: int) -> Automaton:
    """As printed, a state for each count and last bit, then sorted: no output, burst, end."""
    end = 2 * capacity + 1
    on_zero, on_one, said = [2], [1], [Output.NOTHING]
    for count in range(1, capacity + 1):
        full = count == capacity
        on_zero += [end if full else 2 * count + 2, 0 if count < threshold else end]
        on_one += [end if full else 2 * count + 1] * 2
        said += [Output.BURST if count >= threshold else Output.NOTHING] * 2
    following = np.array([[*on_zero, 2], [*on_one, 1]]).T
    return Automaton(following, np.array([*said, Output.END]))


def _control_part() -> Iterator[Row]:
    ours = minimised(_CONTROL_PART)
    yield Row("Table 3.7: states before minimising", 9.0, 9.0, len(_CONTROL_PART), 0.0)
    yield Row("Table 3.7 minimised: states", 5.0, 5.0, len(ours), 0.0)
    yield Row("Table 3.7 minimised: memory cells", 3.0, 3.0, ours.memory_cells, 0.0)
    yield _same("Table 3.7 minimised and Table 3.8", ours, _MINIMAL_CONTROL_PART)
    begins_at_once = Accumulator(1, 3, from_first_one=True).automaton
    yield _same("Table 3.8 and an accumulator with L = 1, k = 3", begins_at_once, ours)
    counter = (_CAPACITY - 1).bit_length()
    yield Row(
        "accumulator from the first one, k = 3, M = 16: cells of control part and counter", 7.0, 7.0,
        float(ours.memory_cells + counter), 0.0,
        "the counter's 4 cells hold 16 values; counts from 0 to 16 would need 5",
    )  # fmt: skip


def _same(label: str, one: Automaton, other: Automaton) -> Row:
    """Cells in which the minimal forms of two automata differ."""
    left, right = (np.column_stack([a.following, a.output]) for a in map(minimised, (one, other)))
    different = left.size if left.shape != right.shape else np.count_nonzero(left != right)
    return Row(f"{label}: cells that differ", None, 0.0, float(different), 0.0)


def _logic() -> Iterator[Row]:
    windows = np.array(list(itertools.product((False, True), repeat=5))).T
    found = int(declares(*windows).sum())
    yield Row("Table 3.11: combinations that declare a burst (3.46)", 11.0, 11.0, found, 0.0)
    wanted = windows[0] & (windows.sum(axis=0) >= 3)
    yield Row(
        "(3.46) against three ones of five, the oldest among them: combinations that differ", None,
        0.0, float(np.count_nonzero(declares(*windows) != wanted)), 0.0,
    )  # fmt: skip
    yield Row(
        "3/5-3: words of 11 bits on which the automaton differs from register, (3.46) and flip-flop",
        None, 0.0, float(_differing_words()), 0.0,
    )  # fmt: skip
    for function, kind, name, count in (
        (declares, ast.BitAnd, "(3.46): AND gates", 4),
        (declares, ast.BitOr, "(3.46): OR gates", 4),
        (ends, ast.Invert, "end of 3/5-3: inverters", 3),
        (ends, ast.BitAnd, "end of 3/5-3: AND gates", 2),
    ):
        nodes = ast.walk(ast.parse(inspect.getsource(function)))
        found = sum(isinstance(node, kind) for node in nodes)
        yield Row(name, float(count), count, found, 0.0)


def _differing_words() -> int:
    words = np.array(list(itertools.product((False, True), repeat=_WORD)))
    automaton = Program.parse("3/5-3").automaton
    register = np.zeros((5, len(words)), bool)
    state = np.zeros(len(words), int)
    burst = np.zeros(len(words), bool)
    differs = np.zeros(len(words), bool)
    for bits in words.T:
        register = np.vstack([register[1:], bits])
        state = automaton.following[state, bits.astype(int)]
        end = burst & ends(*register[2:])
        burst = (burst | declares(*register)) & ~end
        said = np.where(end, Output.END, np.where(burst, Output.BURST, Output.NOTHING))
        differs |= said != automaton.output[state]
    return int(differs.sum())
