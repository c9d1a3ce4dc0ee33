# SPDX-License-Identifier: Apache-2.0
"""An automaton fed with independent random bits is a Markov chain; here it is exact, state by state.

Probabilities of a one may carry leading axes (signal-to-noise ratios, target positions); all are followed at once.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from primary_proc.automata.automaton import Automaton, Output, Program, program_automaton

FloatArray = npt.NDArray[np.float64]

_REMAINDER = 1e-9
_LONGEST_TAIL = 2000


@dataclass(frozen=True, slots=True)
class StartEnd:
    """Joint distribution of start and end of a burst.

    Attributes:
        probability: P(start at lambda, end at mu), shape (..., starts, ends).
        start: lambda of each start, positions counted from 1 at the first pulse of the burst, shape (starts,).
        end: mu of each end, shape (ends,).
    """

    probability: FloatArray
    start: npt.NDArray[np.int64]
    end: npt.NDArray[np.int64]


def step_chain(automaton: Automaton, state: FloatArray, one: npt.ArrayLike) -> FloatArray:
    """Distribution over the states after one more position, P(n+1) = P(n) A (3.48).

    Args:
        automaton: the automaton.
        state: probability of each state, shape (..., states).
        one: probability of a one, shape (...).

    Returns:
        Probability of each state, shape (..., states).
    """
    one = np.asarray(one, dtype=float)[..., None]
    on_zero, on_one = _transitions(automaton)
    return (state * (1.0 - one)) @ on_zero + (state * one) @ on_one


def noise_state(automaton: Automaton, noise: float) -> FloatArray:
    """Limiting distribution in noise, P = P A (3.49)-(3.50).

    Args:
        automaton: the automaton.
        noise: probability p_N of a one.

    Returns:
        Probability of each state, shape (states,).
    """
    on_zero, on_one = _transitions(automaton)
    matrix = (1.0 - noise) * on_zero + noise * on_one
    size = len(automaton)
    equations = np.vstack([matrix.T - np.eye(size), np.ones(size)])
    return np.linalg.lstsq(equations, np.append(np.zeros(size), 1.0), rcond=None)[0]


def start_probability(automaton: Automaton, state: FloatArray, one: npt.ArrayLike) -> FloatArray:
    """Probability that a burst is detected at the next position.

    Args:
        automaton: the automaton.
        state: probability of each state before, shape (..., states).
        one: probability of a one at the next position, shape (...).

    Returns:
        Probability, shape (...).
    """
    return (state[..., _detecting(automaton)]).sum(axis=-1) * np.asarray(one, dtype=float)


def first_detection(program: Program, noise: float, signal: npt.ArrayLike) -> FloatArray:
    """Probability that at least one burst is detected on the positions of a target.

    Args:
        program: l/m-k.
        noise: probability of a one in noise, before the target.
        signal: probability of a one on each position of the target, shape (..., positions).

    Returns:
        Probability, shape (...).
    """
    automaton = program_automaton(program)
    signal = np.asarray(signal, dtype=float)
    state = np.broadcast_to(noise_state(automaton, noise), (*signal.shape[:-1], len(automaton)))
    detecting = _detecting(automaton)
    detected = np.zeros(signal.shape[:-1])
    for one in np.moveaxis(signal, -1, 0):
        detected = detected + start_probability(automaton, state, one)
        stepped = step_chain(automaton, state, one)
        # What has just been detected is absorbed; a burst that noise began goes on beside it.
        stepped[..., automaton.start_state] -= state[..., detecting].sum(axis=-1) * one
        state = stepped
    return detected


def start_end_distribution(program: Program, noise: float, signal: npt.ArrayLike) -> StartEnd:
    """Joint distribution of start and end over all bursts that begin on the positions of a target.

    Noise ones after the target lengthen a burst; they are followed until nothing is left.

    Args:
        program: l/m-k.
        noise: probability of a one in noise, before and after the target.
        signal: probability of a one on each position of the target, shape (..., positions).

    Returns:
        The distribution; its sum is the mean number of bursts a target gives.
    """
    automaton = program_automaton(program)
    signal = np.asarray(signal, dtype=float)
    positions = signal.shape[-1]
    state = np.broadcast_to(noise_state(automaton, noise), (*signal.shape[:-1], len(automaton)))
    zeros = np.zeros((*signal.shape[:-1], positions, program.zeros))
    ends = []
    for position in range(_LONGEST_TAIL):
        one = signal[..., position] if position < positions else np.full(signal.shape[:-1], noise)
        wide = one[..., None]
        ends.append((1.0 - wide) * zeros[..., -1])
        moved = np.empty_like(zeros)
        moved[..., 0] = wide * zeros.sum(axis=-1)
        moved[..., 1:] = (1.0 - one)[..., None, None] * zeros[..., :-1]
        zeros = moved
        if position < positions:
            zeros[..., position, 0] += start_probability(automaton, state, one)
            state = step_chain(automaton, state, one)
        elif zeros.sum(axis=(-2, -1)).max() < _REMAINDER:
            break
    return StartEnd(
        np.stack(ends, axis=-1), np.arange(1, positions + 1), np.arange(1, len(ends) + 1)
    )


def _transitions(automaton: Automaton) -> tuple[FloatArray, FloatArray]:
    unit = np.eye(len(automaton))
    return unit[automaton.following[:, 0]], unit[automaton.following[:, 1]]


def _detecting(automaton: Automaton) -> npt.NDArray[np.bool_]:
    enters = automaton.output[automaton.following[:, 1]] == Output.BURST
    return enters & (automaton.output != Output.BURST)
