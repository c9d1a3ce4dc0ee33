# SPDX-License-Identifier: Apache-2.0
"""Detection probability of the binary detectors against the reference values of Kuzmin 1967, § 3.3.5."""

from __future__ import annotations

import numpy as np
import pytest

from primary_proc.automata.accumulator import Accumulator
from primary_proc.automata.program import Program
from primary_proc.calculators.bursts.detection_probability import detection_probability
from primary_proc.calculators.bursts.false_alarms import noise_probability
from primary_proc.calculators.pulse.burst_shape import burst_shape
from primary_proc.calculators.pulse.single_pulse import fluctuating_probability, threshold_for

THREE_OF_FOUR = Program(3, 4, 2)
AMPLITUDES = (1.0, 1.5, 2.0, 2.5, 3.0, 4.0)
# sinc2, N_0 = 11, by the book's recurrence and by the exact automaton.
TABLE = {
    ("3/3-2", 4e-3): ".095/.096 .202/.204 .395/.400 .630/.639 .823/.833 .975/.983",
    ("4/4-2", 4e-3): ".092/.092 .187/.188 .362/.364 .583/.586 .778/.782 .961/.965",
    ("3/4-2", 4e-3): ".103/.103 .226/.226 .444/.445 .697/.699 .883/.884 .994/.993",
    ("3/3-2", 2e-4): ".009/.009 .034/.034 .116/.116 .293/.293 .542/.543 .913/.914",
    ("3/4-2", 2e-4): ".010/.010 .037/.037 .129/.129 .329/.329 .602/.602 .950/.950",
}


@pytest.mark.parametrize(("name", "rate"), TABLE)
def test_both_models(name, rate, ones_of_a_burst):
    program = Program.parse(name)
    noise = noise_probability(program, rate, "kuzmin")
    for amplitude, pair in zip(AMPLITUDES, TABLE[name, rate].split(), strict=True):
        book, exact = (float(value) for value in pair.split("/"))
        signal = ones_of_a_burst(noise, amplitude)
        found = detection_probability(program, noise, signal, "kuzmin")
        assert found == pytest.approx(book, abs=6e-4)
        assert detection_probability(program, noise, signal) == pytest.approx(exact, abs=6e-4)


@pytest.mark.parametrize(
    ("from_first_one", "model", "expected"),
    [
        (False, "kuzmin", 0.478),
        (False, "exact", 0.351),
        (True, "kuzmin", 0.447),
        (True, "exact", 0.379),
    ],
)
def test_accumulators(from_first_one, model, expected, ones_of_a_burst):
    rule = Accumulator(5, 2, from_first_one, capacity=16)
    noise = noise_probability(rule, 4e-3, model)
    found = detection_probability(rule, noise, ones_of_a_burst(noise, 2.0), model)
    assert found == pytest.approx(expected, abs=6e-4)


@pytest.mark.parametrize(
    ("pulses", "rate", "expected"), [(8, 4e-3, 0.301), (15, 4e-3, 0.583), (20, 2e-4, 0.282)]
)
def test_more_pulses_detect_better(pulses, rate, expected, ones_of_a_burst):
    noise = noise_probability(THREE_OF_FOUR, rate)
    found = detection_probability(THREE_OF_FOUR, noise, ones_of_a_burst(noise, 2.0, pulses))
    assert found == pytest.approx(expected, abs=1e-3)


def test_fast_fluctuation():
    noise = noise_probability(THREE_OF_FOUR, 4e-3)
    shape = burst_shape("sinc2", 11)
    for amplitude, expected in ((1.0, 0.184), (2.0, 0.631), (4.0, 0.965)):
        signal = fluctuating_probability(threshold_for(noise), amplitude * shape)
        found = detection_probability(THREE_OF_FOUR, noise, signal)
        assert found == pytest.approx(expected, abs=1e-3)


def test_certain_ones_are_detected_and_certain_zeros_are_not():
    for rule in (THREE_OF_FOUR, Program.parse("3/5-3"), Accumulator(5, 2, from_first_one=True)):
        assert detection_probability(rule, 1e-4, np.ones(11)) == pytest.approx(1.0, abs=1e-6)
        assert detection_probability(rule, 1e-4, np.zeros(11)) == pytest.approx(0.0, abs=1e-6)


def test_an_unknown_model_is_refused():
    with pytest.raises(ValueError, match="model"):
        detection_probability(THREE_OF_FOUR, 0.1, [0.5], "other")
