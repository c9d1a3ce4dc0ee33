# SPDX-License-Identifier: Apache-2.0
"""The exact chain against enumeration of words and against itself."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from primary_proc.automata.accumulator import Accumulator
from primary_proc.automata.automaton import Output
from primary_proc.automata.automaton_chain import (
    bursts_without,
    first_detection,
    noise_state,
    start_end_distribution,
    start_probability,
    step_chain,
)
from primary_proc.automata.program import Program
from primary_proc.automata.sequential_rule import SequentialTest

RULES = [
    Program(3, 4, 2),
    Program.parse("3/5-3"),
    Program(2, 6, 2),
    Accumulator(4, 2, from_first_one=False),
    Accumulator(4, 2, from_first_one=True, capacity=6),
    SequentialTest(3, 1, 7, 2, 4),
]


@pytest.mark.parametrize("rule", [*RULES, Accumulator(200, 2, from_first_one=True)], ids=str)
def test_noise_state_is_stationary(rule):
    """The last has more states than are solved as a full matrix."""
    automaton = rule.automaton
    state = noise_state(automaton, 0.2)
    assert state.sum() == pytest.approx(1.0)
    assert step_chain(automaton, state, 0.2) == pytest.approx(state, abs=1e-14)
    inside = automaton.output == Output.BURST
    begun = start_probability(automaton, state, 0.2)
    assert state[automaton.output == Output.END].sum() == pytest.approx(begun)
    assert state[inside].sum() >= begun


@pytest.mark.parametrize("rule", RULES, ids=str)
def test_probabilities_are_sums_over_words(rule):
    """From the initial state, on nine positions with different probabilities."""
    automaton = rule.automaton
    signal = np.linspace(0.9, 0.3, 9)
    fresh = np.zeros(len(automaton))
    fresh[0] = 1.0
    detected = 0.0
    for word in itertools.product((0, 1), repeat=9):
        state, said = 0, []
        for bit in word:
            state = automaton.following[state, bit]
            said.append(automaton.output[state])
        detected += np.prod(np.where(word, signal, 1 - signal)) * (Output.BURST in said)
    assert first_detection(automaton, 0.1, signal, fresh) == pytest.approx(detected)


@pytest.mark.parametrize("rule", RULES, ids=str)
def test_starts_and_ends_are_those_of_simulated_words(rule):
    automaton = rule.automaton
    rng = np.random.default_rng(3)
    words, warm, positions = 20_000, 60, 8
    one = np.concatenate([np.full(warm, 0.15), np.linspace(0.9, 0.5, positions), np.full(80, 0.15)])
    state, burst = np.zeros(words, int), np.zeros(words, int)
    middles = []
    for now, probability in enumerate(one, start=1 - warm):
        state = automaton.following[state, (rng.random(words) < probability).astype(int)]
        said = automaton.output[state]
        middles.append(
            (burst + now)[(said == Output.END) & (burst >= 1) & (burst <= positions)] / 2
        )
        burst = np.where(said != Output.BURST, -1000, np.where(burst == -1000, now, burst))
    middle = np.concatenate(middles)
    joint = start_end_distribution(automaton, 0.15, one[warm : warm + positions])
    bursts = joint.probability.sum()
    expected = (joint.probability * (joint.start[:, None] + joint.end) / 2).sum() / bursts
    assert len(middle) / words == pytest.approx(bursts, abs=3.3 * np.sqrt(bursts / words))
    assert middle.mean() == pytest.approx(expected, abs=3.3 * middle.std() / np.sqrt(len(middle)))


def test_leading_axes_are_followed_at_once():
    automaton = Program(3, 4, 2).automaton
    signal = np.random.default_rng(1).random((2, 3, 7))
    together = start_end_distribution(automaton, 0.1, signal).probability
    for place in np.ndindex(2, 3):
        alone = start_end_distribution(automaton, 0.1, signal[place]).probability
        shorter = min(alone.shape[-1], together.shape[-1])
        assert together[place][:, :shorter] == pytest.approx(alone[:, :shorter], abs=1e-12)


@pytest.mark.parametrize("rule", RULES, ids=str)
def test_bursts_without_a_marked_one(rule):
    automaton = rule.automaton
    shares = [bursts_without(automaton, 0.1, marked) for marked in (0.0, 0.2, 0.5, 1.0)]
    assert shares[0] == pytest.approx(1.0)
    assert shares[-1] == pytest.approx(0.0, abs=1e-12)
    assert (np.diff(shares) < 0.0).all()
    assert shares[1] <= 0.8**automaton.fewest_ones + 1e-12


def test_rare_ones_make_bursts_of_the_fewest():
    found = bursts_without(Program(3, 3, 2).automaton, 1e-5, 0.3)
    assert found == pytest.approx(0.7**3, rel=1e-4)
