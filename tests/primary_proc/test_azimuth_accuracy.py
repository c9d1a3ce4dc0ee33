# SPDX-License-Identifier: Apache-2.0
"""Bias and spread of the start-end azimuth against the reference values of Kuzmin 1967, § 3.3.6."""

from __future__ import annotations

import numpy as np
import pytest

from primary_proc.automata.accumulator import Accumulator
from primary_proc.automata.automaton_chain import StartEnd, start_end_distribution
from primary_proc.automata.program import Program
from primary_proc.automata.sequential_rule import SequentialTest
from primary_proc.calculators.azimuth.accuracy_table import accuracy_table
from primary_proc.calculators.azimuth.azimuth_accuracy import azimuth_error, error_of
from primary_proc.calculators.bursts.false_alarms import noise_probability

THREE_OF_FOUR = Program(3, 4, 2)
AMPLITUDES = (2.0, 3.0, 4.0)


@pytest.mark.parametrize(
    ("name", "rate", "book", "exact"),
    [
        ("3/3-2", 4e-3, [1.37, 0.96, 0.77], [1.45, 1.08, 0.93]),
        ("4/4-3", 4e-3, [1.33, 0.97, 0.84], [2.27, 2.07, 2.02]),
        ("3/4-2", 4e-3, [1.40, 0.95, 0.75], [1.44, 1.02, 0.85]),
        ("3/4-2", 2e-4, [1.08, 0.79, 0.61], [1.09, 0.81, 0.65]),
    ],
)
def test_spread_of_both_models(name, rate, book, exact, ones_of_a_burst):
    program = Program.parse(name)
    noise = noise_probability(program, rate, "kuzmin")
    for amplitude, of_book, of_chain in zip(AMPLITUDES, book, exact, strict=True):
        signal = ones_of_a_burst(noise, amplitude)
        assert azimuth_error(program, noise, signal).std == pytest.approx(of_chain, abs=6e-3)
        assert azimuth_error(program, noise, signal, model="kuzmin").std == pytest.approx(
            of_book, abs=6e-3
        )


@pytest.mark.parametrize(
    ("name", "biases"),
    [
        ("3/3-2", [2.25, 2.32, 2.30]),
        ("4/4-3", [4.27, 4.33, 4.31]),
        ("3/3-1", [1.41, 1.46, 1.46]),
    ],
)
def test_bias_of_the_exact_chain(name, biases, ones_of_a_burst):
    program = Program.parse(name)
    noise = noise_probability(program, 4e-3, "kuzmin")
    found = azimuth_error(program, noise, ones_of_a_burst(noise, AMPLITUDES)).bias
    assert found == pytest.approx(biases, abs=6e-3)


def test_bias_of_three_of_four_is_that_of_three_ones(ones_of_a_burst):
    noise = noise_probability(THREE_OF_FOUR, 4e-3)
    bias = azimuth_error(THREE_OF_FOUR, noise, ones_of_a_burst(noise, AMPLITUDES)).bias
    assert ((bias > 2.0) & (bias < 2.25)).all()
    assert THREE_OF_FOUR.nominal_bias == 2.0


@pytest.mark.parametrize(
    ("rule", "late"),
    [
        (Program(3, 3, 2), 0.0),
        (Program.parse("3/5-3"), 0.0),
        (Accumulator(5, 2, from_first_one=True), 0.0),
        # Every second series of zeros leaves one that is counted; every second test begins one zero below.
        (Accumulator(5, 2, from_first_one=False), -0.25),
        (SequentialTest(3, 1, 9, 2, 5), 0.25),
    ],
    ids=str,
)
def test_nominal_bias_is_that_of_a_burst_of_ones_alone(rule, late):
    error = azimuth_error(rule, 1e-9, np.ones(15))
    assert error.bias == pytest.approx(rule.nominal_bias + late, abs=1e-6)


def test_more_pulses_spread_the_estimate_in_steps(ones_of_a_burst):
    noise = noise_probability(THREE_OF_FOUR, 4e-3)
    for amplitude, expected in ((2.0, 1.86), (3.0, 1.30), (4.0, 1.02)):
        signal = ones_of_a_burst(noise, amplitude, 15)
        found = azimuth_error(THREE_OF_FOUR, noise, signal, model="kuzmin").std
        assert found == pytest.approx(expected, abs=6e-3)


def test_the_books_example_has_an_error_of_two_and_a_half_steps():
    example = StartEnd(np.ones((1, 1)), np.array([4]), np.array([13]))
    assert error_of(example, 11).bias == 2.5


def test_distribution_of_start_and_end_holds_all_bursts(ones_of_a_burst):
    noise = noise_probability(Program(4, 4, 3), 4e-3)
    joint = start_end_distribution(Program(4, 4, 3).automaton, noise, ones_of_a_burst(noise, 3.0))
    assert (joint.probability >= 0.0).all()
    assert joint.probability[np.subtract.outer(joint.start, joint.end) > -3].sum() == 0.0


@pytest.mark.parametrize("rule", [THREE_OF_FOUR, Accumulator(6, 2, from_first_one=True)], ids=str)
def test_table_is_steadier_for_stronger_targets(rule):
    table = accuracy_table(rule, 0.02, "gaussian", 15.0)
    weak, strong = table.look_up([8.0, 500.0])[1]
    assert strong < 0.7 * weak


def test_what_the_book_does_not_give_is_refused():
    with pytest.raises(ValueError, match="model"):
        azimuth_error(THREE_OF_FOUR, 0.1, [0.5], model="other")
    with pytest.raises(ValueError, match="programs only"):
        azimuth_error(Accumulator(5, 2, from_first_one=True), 0.1, [0.5], model="kuzmin")
