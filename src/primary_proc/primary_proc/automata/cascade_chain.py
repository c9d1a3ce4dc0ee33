# SPDX-License-Identifier: Apache-2.0
"""Kuzmin's own chain of a program detector: exact up to the detection, a counter of positions after it.

The book replaces "k zeros in a row" by an independent reset with the probability q^k at every position after the
detection, and ends a burst after M' positions at the latest (Kuzmin 1967, § 3.3.3-3.3.4). Kept to reproduce the
book; design uses `automaton_chain`.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from primary_proc.automata.automaton import Output, Program, program_automaton

FloatArray = npt.NDArray[np.float64]

CAPACITY = 16


def noise_states(program: Program, noise: float, capacity: int = CAPACITY) -> FloatArray:
    """Limiting probabilities in noise from the closed forms (3.69) and (3.72).

    Args:
        program: m/m-k with k >= 2, or 3/4-2.
        noise: probability p_N of a one.
        capacity: M', positions after which the burst ends in any case.

    Returns:
        Probabilities of the states before detection, of the detection, of the M' counts.

    Raises:
        ValueError: the book has no closed form for the program.
    """
    p, q, k, m = noise, 1.0 - noise, program.zeros, program.window
    stages: npt.NDArray[np.floating]
    if program == Program(3, 4, 2):
        stages = _three_of_four(p, q)
        sum_of_counts = 1.0 + (1.0 - (1.0 - q**2) ** capacity) / q**2
        first = 1.0 / (
            ((1.0 - p**3) + q**4 * p**2) / (q * (1.0 - p * q)) + stages[-1] * sum_of_counts
        )
        stages = first * stages
    elif program.ones == m and k >= 2:
        bracket = 1.0 + (k - 2) * q**k - (1.0 - q**k) ** (capacity - (k - 2))
        first = q**k / (q ** (k - 1) * (1.0 - p ** (m + 1)) + p**m * bracket)
        stages = first * p ** np.arange(m + 1)
    else:
        raise ValueError(f"no closed form for {program} in Kuzmin 1967")
    counts = stages[-1] * (1.0 - q**k) ** np.maximum(np.arange(1, capacity + 1) - (k - 1), 0)
    return np.concatenate([stages, counts])


def step_cascade(
    program: Program,
    state: FloatArray,
    one: float,
    reset: float,
) -> FloatArray:
    """Distribution after one more position, (3.89) and (3.91).

    Args:
        program: l/m-k.
        state: probabilities of the states before detection, of the detection, of the M' counts.
        one: probability of a one on the position.
        reset: e_k, probability that this position and the k - 1 before it hold zeros.

    Returns:
        Probabilities in the same order.
    """
    automaton = program_automaton(program)
    detection = int(np.count_nonzero(automaton.output == Output.NOTHING))
    new = np.zeros_like(state)
    np.add.at(new, automaton.following[:detection, 0], state[:detection] * (1.0 - one))
    np.add.at(new, automaton.following[:detection, 1], state[:detection] * one)
    resets = np.zeros(len(state) - detection)
    resets[program.zeros - 1 :] = reset
    resets[-1] = 1.0
    counts = state[detection:]
    new[0] += counts @ resets
    new[detection + 1 :] += (counts * (1.0 - resets))[:-1]
    return new


def signal_states(
    program: Program, noise: float, signal: npt.ArrayLike, capacity: int = CAPACITY
) -> FloatArray:
    """Probability of every state on every position of a target.

    Args:
        program: m/m-k with k >= 2, or 3/4-2.
        noise: probability p_N of a one before the target.
        signal: probability of a one on each position, shape (positions,).
        capacity: M'.

    Returns:
        Shape (positions, states), states as `noise_states` orders them.
    """
    state = noise_states(program, noise, capacity)
    resets = zero_runs(program.zeros, noise, signal)
    states = []
    for one, reset in zip(np.asarray(signal, dtype=float), resets, strict=True):
        state = step_cascade(program, state, one, reset)
        states.append(state)
    return np.array(states)


def detection_index(program: Program) -> int:
    """Place of the detection among the states.

    Args:
        program: l/m-k.

    Returns:
        Index into the vector of `noise_states`.
    """
    return int(np.count_nonzero(program_automaton(program).output == Output.NOTHING))


def zero_runs(zeros: int, noise: float, signal: npt.ArrayLike) -> FloatArray:
    """e_k: probability of k zeros in a row that end on each position, noise before the first.

    Args:
        zeros: k.
        noise: probability p_N of a one before the target.
        signal: probability of a one on each position, shape (positions,).

    Returns:
        Shape (positions,).
    """
    silent = np.concatenate([np.full(zeros - 1, 1.0 - noise), 1.0 - np.asarray(signal)])
    return np.lib.stride_tricks.sliding_window_view(silent, zeros).prod(axis=1)


def _three_of_four(p: float, q: float) -> FloatArray:
    """States of Table 3.10 relative to the initial one, in the order of `program_automaton`."""
    table = {
        "": 1.0,
        "1": p,
        "11": p**2,
        "10": q * p / (1.0 - p * q),
        "101": q * p**2 / (1.0 - p * q),
        "110": q * p**2,
    }
    detection = p**3 + q * p**3 / (1.0 - p * q) + q * p**3
    order = ["", "1", "10", "11", "101", "110"]
    return np.array([*(table[prefix] for prefix in order), detection])
