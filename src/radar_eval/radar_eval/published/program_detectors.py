# SPDX-License-Identifier: Apache-2.0
"""False-alarm probability per azimuth position of the program detectors (Kuzmin 1967, § 3.3.3, figure 3.24)."""

from __future__ import annotations

import itertools
from collections.abc import Iterator

from primary_proc.automata.book_chain import CAPACITY, book_chain
from primary_proc.automata.program import Program
from primary_proc.calculators.bursts.false_alarms import (
    false_bursts_per_second,
    false_start_probability,
    noise_probability,
)
from primary_proc.calculators.pulse.single_pulse import threshold_for
from radar_eval.published.result import Row, to_digits

_NOISE = (0.05, 0.10, 0.15, 0.20, 0.30, 0.40, 0.50)
_CHAIN = {
    "3/3-2": (1.1874e-4, 8.9909e-4, 2.8588e-3, 6.3467e-3, 1.8341e-2, 3.5523e-2, 5.2743e-2),
    "4/4-2": (5.9375e-6, 8.9991e-5, 4.3009e-4, 1.2779e-3, 5.6186e-3, 1.4878e-2, 2.8604e-2),
    "4/4-3": (5.9374e-6, 8.9982e-5, 4.2986e-4, 1.2756e-3, 5.5602e-3, 1.4297e-2, 2.5693e-2),
    "3/4-2": (3.3251e-4, 2.3407e-3, 6.8950e-3, 1.4142e-2, 3.4723e-2, 5.7158e-2, 7.2838e-2),
}
_EXACT = {
    "3/3-2": {0.20: 6.337e-3, 0.30: 1.820e-2, 0.40: 3.470e-2, 0.50: 5.000e-2},
    "4/4-2": {0.40: 1.473e-2, 0.50: 2.778e-2},
    "4/4-3": {0.30: 5.515e-3, 0.40: 1.379e-2, 0.50: 2.273e-2},
    "3/4-2": {0.15: 6.887e-3, 0.20: 1.409e-2, 0.30: 3.421e-2, 0.40: 5.505e-2, 0.50: 6.771e-2},
    "3/5-3": dict(
        zip(
            _NOISE,
            (6.204e-4, 4.049e-3, 1.097e-2, 2.049e-2, 4.037e-2, 5.076e-2, 4.702e-2),
            strict=True,
        )
    ),
}
_APPROXIMATION = (3.334e-4, 2.366e-3, 7.069e-3, 1.480e-2, 3.861e-2, 6.973e-2, 1.016e-1)
_INVERSE = {
    ("3/3-2", 4e-3): (0.1691, 1.885),
    ("4/4-2", 4e-3): (0.2727, 1.612),
    ("4/4-3", 4e-3): (0.2733, 1.611),
    ("3/4-2", 4e-3): (0.1219, 2.052),
    ("3/3-2", 2e-4): (0.0597, 2.374),
    ("4/4-2", 2e-4): (0.1229, 2.048),
    ("4/4-3", 2e-4): (0.1229, 2.048),
    ("3/4-2", 2e-4): (0.0419, 2.519),
}


def program_detectors() -> Iterator[Row]:
    """Compute the false-alarm probabilities.

    Yields:
        Limiting probabilities of single states, the figure as a table, its statements, and the thresholds.
    """
    yield from _single_states()
    for program, values in _CHAIN.items():
        for noise, expected in zip(_NOISE, values, strict=True):
            ours = false_start_probability(Program.parse(program), noise, "kuzmin")
            label = f"{program}, p_N = {noise:g}: P_fa, book's chain with M' = 16"
            yield Row(label, None, expected, ours, to_digits(expected))
    for program, points in _EXACT.items():
        for noise, expected in points.items():
            ours = false_start_probability(Program.parse(program), noise)
            label = f"{program}, p_N = {noise:g}: P_fa, automaton itself"
            yield Row(label, None, expected, ours, to_digits(expected))
    yield from _approximations()
    yield from _closed_form()
    yield from _effect_of_zeros()
    yield from _filtering()
    yield from _rates()
    for (program, false_alarm), (expected, threshold) in _INVERSE.items():
        noise = noise_probability(Program.parse(program), false_alarm, "kuzmin")
        at = f"{program} at P_fa = {false_alarm:g}"
        yield Row(f"{at}: p_N", None, expected, noise, to_digits(expected))
        printed = 2.0 if (program, false_alarm) == ("3/4-2", 4e-3) else None
        ours = float(threshold_for(noise))
        yield Row(f"{at}: x_0", printed, threshold, ours, 2e-3)
    for false_alarm, expected, threshold in ((4e-3, 0.0995, 2.148), (2e-4, 0.0336, 2.606)):
        noise = noise_probability(Program.parse("3/5-3"), false_alarm)
        at = f"3/5-3 at P_fa = {false_alarm:g}, automaton itself"
        yield Row(f"{at}: p_N", None, expected, noise, to_digits(expected))
        yield Row(f"{at}: x_0", None, threshold, float(threshold_for(noise)), 2e-3)


def _single_states() -> Iterator[Row]:
    simple, cascade = Program(3, 3, 2), Program(3, 4, 2)
    states = book_chain(simple).noise_states(0.1)
    yield Row("3/3-2, p_N = 0.1: P_0 (3.65)", None, 0.899091, float(states[0]), 5.1e-7)
    yield Row("3/3-2, p_N = 0.1: P_3 (3.65)", None, 8.9909e-4, float(states[3]), 5.1e-9)
    states = book_chain(cascade).noise_states(0.1)
    yield Row("3/4-2, p_N = 0.1: P_0 (3.72)", None, 0.810211, float(states[0]), 5.1e-7)
    yield Row(
        "3/4-2, p_N = 0.1: P_3 of figure 3.16 (3.72)", None, 0.0801307, float(states[2]), 5.1e-8
    )
    yield Row(
        "3/4-2, p_N = 0.1: P_6 (3.72)", None, 2.34071e-3,
        float(states[book_chain(cascade).detection]), 5.1e-9,
    )  # fmt: skip
    yield Row(
        "3/4-2, p_N = 0.1: P_0 by the approximation (3.73)", 0.8190, 0.810211, float(states[0]),
        5.1e-7, "(3.73) holds for small p_N only: 1.1 % high here",
    )  # fmt: skip


def _approximations() -> Iterator[Row]:
    finding = (
        "(3.74) leaves out higher powers of p_N: too high by 0.3 % to 39 %, the more the larger p_N"
    )
    for noise, approximation, expected in zip(_NOISE, _APPROXIMATION, _CHAIN["3/4-2"], strict=True):
        ours = false_start_probability(Program(3, 4, 2), noise, "kuzmin")
        label = f"3/4-2, p_N = {noise:g}: P_fa by the approximation (3.74)"
        yield Row(label, approximation, expected, ours, to_digits(expected), finding)


def _closed_form() -> Iterator[Row]:
    """(3.69) as printed, and (3.72) with P_0 derived anew, against the chain's limit."""
    p, q, capacity = 0.1, 0.9, CAPACITY
    for m, k in itertools.product((2, 3, 4), (2, 3, 4)):
        bracket = 1.0 + (k - 2) * q**k - (1.0 - q**k) ** (capacity - (k - 2))
        printed = q**k / (q ** (k - 1) * (1.0 - p ** (m + 1)) + p**m * bracket)
        ours = float(book_chain(Program(m, m, k)).noise_states(p)[0])
        yield Row(f"{m}/{m}-{k}, p_N = 0.1: P_0 (3.69)", printed, printed, ours, 1e-14)
    stages = p**3 + q * p**3 / (1.0 - p * q) + q * p**3
    counts = 1.0 + (1.0 - (1.0 - q**2) ** capacity) / q**2
    printed = 1.0 / (((1.0 - p**3) + q**4 * p**2) / (q * (1.0 - p * q)) + stages * counts)
    ours = float(book_chain(Program(3, 4, 2)).noise_states(p)[0])
    yield Row("3/4-2, p_N = 0.1: P_0 (3.72)", None, printed, ours, 1e-14)


def _filtering() -> Iterator[Row]:
    for noise in _NOISE:
        rate = {name: false_start_probability(Program.parse(name), noise) for name in _CHAIN}
        holds = rate["4/4-2"] < rate["3/3-2"] < rate["3/4-2"]
        label = f"p_N = {noise:g}: 4/4-2 makes fewer false starts than 3/3-2, 3/4-2 more (1 = yes)"
        yield Row(label, 1.0, 1.0, float(holds), 0.0)


def _rates() -> Iterator[Row]:
    """(3.75)-(3.76): 400 rings at 500 pulses a second, and at 5000 pulses a turn."""
    program = Program(3, 4, 2)
    noise = noise_probability(program, 2e-4)
    ours = false_bursts_per_second(program, noise, 400, 500.0)
    yield Row(
        "3/4-2, P_fa = 0.0002, 400 rings, 500 Hz: false bursts a second (3.76)",
        None,
        40.0,
        ours,
        1e-6,
    )
    ours = 400 * 5000 * false_start_probability(program, noise)
    yield Row("the same, 5000 positions a turn: false bursts a turn", None, 400.0, ours, 1e-5)


def _effect_of_zeros() -> Iterator[Row]:
    for noise, expected, tolerance in (
        (0.1, 1.0001, 1e-4),
        (0.3, 1.0105, 5e-4),
        (0.4, 1.0406, 5e-4),
    ):
        two, three = (
            false_start_probability(Program(4, 4, zeros), noise, "kuzmin") for zeros in (2, 3)
        )
        label = f"P_fa of 4/4-2 over 4/4-3 at p_N = {noise:g}: k matters from 0.3 or 0.4 on only"
        yield Row(label, None, expected, two / three, tolerance)
