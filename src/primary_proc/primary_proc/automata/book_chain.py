# SPDX-License-Identifier: Apache-2.0
"""Kuzmin's own chain of a detector: bits decide up to a state from which on positions are only counted.

The book replaces "k zeros in a row" by an independent reset with the probability q^k at every position counted, and
ends a burst after M positions at the latest (Kuzmin 1967, § 3.3). Kept to reproduce the book; design uses
`automaton_chain`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from primary_proc.automata.accumulator import Accumulator
from primary_proc.automata.automaton import Output
from primary_proc.automata.burst_rule import BurstRule
from primary_proc.automata.program import Program

FloatArray = npt.NDArray[np.float64]

CAPACITY = 16


@dataclass(frozen=True)
class BookChain:
    """States in which the next bit decides, then counts; the vectors below hold them in this order.

    Attributes:
        stages: next state of each deciding state on a zero and on a one, shape (n, 2); n is the first count.
        counts: how many counts there are; the last one returns to the initial state in any case.
        zeros: k; the first k - 1 counts go on in any case.
        detection: state whose probability is that of a detection.
        lag: d of (3.86) and (3.90), positions that separate two detections.
    """

    stages: npt.NDArray[np.integer]
    counts: int
    zeros: int
    detection: int
    lag: int

    def noise_states(self, noise: float) -> FloatArray:
        """Limiting probabilities in noise; (3.51), (3.54), (3.57), (3.60)-(3.63), (3.69) and (3.72) are its cases.

        Relative to the initial state the deciding ones follow from the bits, the j-th count has the probability of the
        first times (1 - q^k)^(j - k + 1) from j = k on, and the sum is one.

        Args:
            noise: probability p_N of a one.

        Returns:
            Probability of each state.
        """
        deciding = len(self.stages)
        size = deciding + 1
        reset = (1.0 - noise) ** self.zeros
        relative = np.ones(size)
        if deciding:
            moves = np.zeros((size, deciding))
            np.add.at(moves, (self.stages[:, 0], np.arange(deciding)), 1.0 - noise)
            np.add.at(moves, (self.stages[:, 1], np.arange(deciding)), noise)
            inner = np.eye(deciding - 1) - moves[1:deciding, 1:]
            relative[1:deciding] = np.linalg.solve(inner, moves[1:deciding, 0])
            relative[deciding] = moves[deciding] @ relative[:deciding]
        waits = np.maximum(np.arange(self.counts) - (self.zeros - 1), 0)
        states = np.concatenate([relative[:deciding], relative[deciding] * (1.0 - reset) ** waits])
        return np.asarray(states / states.sum())

    def step(self, state: FloatArray, one: float, reset: float) -> FloatArray:
        """Distribution after one more position, (3.81), (3.83), (3.85), (3.87), (3.89) and (3.91).

        Args:
            state: probability of each state.
            one: probability of a one on the position.
            reset: e_k, probability that this position and the k - 1 before it hold zeros.

        Returns:
            Probability of each state.
        """
        deciding = len(self.stages)
        new = np.zeros_like(state)
        np.add.at(new, self.stages[:, 0], state[:deciding] * (1.0 - one))
        np.add.at(new, self.stages[:, 1], state[:deciding] * one)
        resets = np.zeros(self.counts)
        resets[self.zeros - 1 :] = reset
        resets[-1] = 1.0
        counts = state[deciding:]
        new[0] += counts @ resets
        new[deciding + 1 :] += (counts * (1.0 - resets))[:-1]
        return new

    def signal_states(self, noise: float, signal: npt.ArrayLike) -> FloatArray:
        """Probability of every state on every position of a target.

        Args:
            noise: probability p_N of a one before the target.
            signal: probability of a one on each position, shape (positions,).

        Returns:
            Shape (positions, states).
        """
        state = self.noise_states(noise)
        resets = zero_runs(self.zeros, noise, signal)
        states = []
        for one, reset in zip(np.asarray(signal, dtype=float), resets, strict=True):
            state = self.step(state, one, reset)
            states.append(state)
        return np.array(states)


def book_chain(rule: BurstRule, capacity: int = CAPACITY) -> BookChain:
    """Make the book's chain of a detector.

    Args:
        rule: a program that declares early, or an accumulator.
        capacity: M of an accumulator, M' of a program: positions after which the burst ends in any case.

    Returns:
        The chain.

    Raises:
        ValueError: the book has none for the rule.
    """
    if isinstance(rule, Accumulator):
        waiting = np.array([[0, 1]] if rule.from_first_one else np.zeros((0, 2)), np.int64)
        counts = capacity + 1 - len(waiting)
        return BookChain(waiting, counts, rule.zeros, rule.threshold, rule.threshold)
    if isinstance(rule, Program) and not rule.late:
        automaton = rule.automaton
        deciding = int(np.count_nonzero(automaton.output == Output.NOTHING))
        stages = automaton.following[:deciding]
        return BookChain(stages, capacity + 1, rule.zeros, deciding, rule.window)
    raise ValueError(f"Kuzmin 1967 has no closed form for {rule}")


def zero_runs(zeros: int, noise: float, signal: npt.ArrayLike) -> FloatArray:
    """e_k: probability of k zeros in a row that end on each position, noise before the first.

    Args:
        zeros: k.
        noise: probability p_N of a one before the target.
        signal: probability of a one on each position of the target, shape (positions,).

    Returns:
        Shape (positions,).
    """
    silent = np.concatenate([np.full(zeros - 1, 1.0 - noise), 1.0 - np.asarray(signal)])
    return np.lib.stride_tricks.sliding_window_view(silent, zeros).prod(axis=1)
