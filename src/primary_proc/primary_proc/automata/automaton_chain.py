# SPDX-License-Identifier: Apache-2.0
"""An automaton fed with independent random bits is a Markov chain; here it is exact, state by state.

Probabilities of a one may carry leading axes (signal-to-noise ratios, target positions); all are followed at once.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.sparse import csc_array, csr_array, identity
from scipy.sparse.linalg import spsolve

from primary_proc.automata.automaton import Automaton, Output

FloatArray = npt.NDArray[np.float64]

_REMAINDER = 1e-9
_LONGEST_TAIL = 2000
_DENSE = 40


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


class _Moves:
    """Transitions of a table of states, by which a distribution over them goes on."""

    def __init__(
        self, following: npt.NDArray[np.integer], taken: npt.NDArray[np.bool_] | None = None
    ) -> None:
        """Take the transitions `following`, or those `taken` of them, both of shape (states, 2)."""
        shape = (len(following), len(following))
        self._by_bit = []
        for bit in (0, 1):
            state = np.arange(len(following)) if taken is None else np.flatnonzero(taken[:, bit])
            place = following[state, bit], state
            self._by_bit.append(csr_array((np.ones(len(state)), place), shape))

    def step(self, state: FloatArray, one: npt.ArrayLike) -> FloatArray:
        """Move (..., states) on with the probability of a one, shape (...)."""
        wide = np.asarray(one, dtype=float)[..., None]
        size = state.shape[-1]
        zeros, ones = ((state * p).reshape(-1, size).T for p in (1.0 - wide, wide))
        return np.asarray((self._by_bit[0] @ zeros + self._by_bit[1] @ ones).T).reshape(state.shape)

    def matrix(self, zero: float, one: float) -> csr_array:
        """Probability of each transition from those of the bits, shape (to, from)."""
        return csr_array(self._by_bit[0] * zero + self._by_bit[1] * one)


def step_chain(automaton: Automaton, state: FloatArray, one: npt.ArrayLike) -> FloatArray:
    """Distribution over the states after one more position, P(n+1) = P(n) A (3.48).

    Args:
        automaton: the automaton.
        state: probability of each state, shape (..., states).
        one: probability of a one, shape (...).

    Returns:
        Probability of each state, shape (..., states).
    """
    return _Moves(automaton.following).step(state, one)


def noise_state(automaton: Automaton, noise: float) -> FloatArray:
    """Limiting distribution in noise, P = P A (3.49)-(3.50).

    Args:
        automaton: the automaton; noise must bring it back to its initial state.
        noise: probability p_N of a one.

    Returns:
        Probability of each state, shape (states,).
    """
    size = len(automaton)
    ahead = automaton.following.T.reshape(-1)
    behind = np.tile(np.arange(size), 2)
    chance = np.repeat([noise - 1.0, -noise], size)
    # I - A less the row and column of the initial state: relative to it the smallest probabilities keep their digits.
    inner, first = (ahead > 0) & (behind > 0), (ahead > 0) & (behind == 0)
    place = ahead[inner] - 1, behind[inner] - 1
    entered = np.zeros(size - 1)
    np.subtract.at(entered, ahead[first] - 1, chance[first])
    if size <= _DENSE:
        matrix = np.eye(size - 1)
        np.add.at(matrix, place, chance[inner])
        others = np.linalg.solve(matrix, entered)
    else:
        moves = csc_array((chance[inner], place), (size - 1, size - 1))
        others = spsolve(moves + identity(size - 1, format="csc"), entered)
    state = np.concatenate([[1.0], others])
    return np.asarray(state / state.sum())


def start_probability(automaton: Automaton, state: FloatArray, one: npt.ArrayLike) -> FloatArray:
    """Probability that a burst is declared at the next position.

    Args:
        automaton: the automaton.
        state: probability of each state before, shape (..., states).
        one: probability of a one at the next position, shape (...).

    Returns:
        Probability, shape (...).
    """
    return _taken(automaton.declaring, state, one)


def first_detection(
    automaton: Automaton, noise: float, signal: npt.ArrayLike, state: FloatArray | None = None
) -> FloatArray:
    """Probability that at least one burst is declared on the positions of a target.

    Args:
        automaton: the automaton.
        noise: probability of a one in noise, before the target.
        signal: probability of a one on each position of the target, shape (..., positions).
        state: distribution over the states before the target, that in noise if not given, shape (states,).

    Returns:
        Probability, shape (...).
    """
    signal = np.asarray(signal, dtype=float)
    # What is declared is absorbed; a burst that noise began goes on beside it.
    going_on = _Moves(automaton.following, ~automaton.declaring)
    first = noise_state(automaton, noise) if state is None else state
    now = np.broadcast_to(first, (*signal.shape[:-1], len(automaton)))
    detected = np.zeros(signal.shape[:-1])
    for one in np.moveaxis(signal, -1, 0):
        detected = detected + start_probability(automaton, now, one)
        now = going_on.step(now, one)
    return detected


def start_end_distribution(automaton: Automaton, noise: float, signal: npt.ArrayLike) -> StartEnd:
    """Joint distribution of start and end over all bursts that begin on the positions of a target.

    Noise ones after the target lengthen a burst; they are followed until nothing is left.

    Args:
        automaton: the automaton.
        noise: probability of a one in noise, before and after the target.
        signal: probability of a one on each position of the target, shape (..., positions).

    Returns:
        The distribution; its sum is the mean number of bursts a target gives.
    """
    signal = np.asarray(signal, dtype=float)
    leading, positions = signal.shape[:-1], signal.shape[-1]
    begins, stops = np.searchsorted(automaton.output, [Output.BURST, Output.END])
    inside = slice(begins, stops)
    declared = _Moves(automaton.following, automaton.declaring)
    moves = _Moves(automaton.following)
    onward = automaton.following[inside] - begins
    ending = onward >= stops - begins
    bursts = _Moves(onward, ~ending)

    state = np.broadcast_to(noise_state(automaton, noise), (*leading, len(automaton)))
    burst = np.zeros((*leading, positions, stops - begins))
    ends = []
    for position in range(_LONGEST_TAIL):
        one = signal[..., position] if position < positions else np.full(leading, noise)
        begun = burst[..., : min(position, positions), :]
        end = np.zeros((*leading, positions))
        end[..., :position] = _taken(ending, begun, one[..., None])
        ends.append(end)
        burst[..., :position, :] = bursts.step(begun, one[..., None])
        if position < positions:
            burst[..., position, :] = declared.step(state, one)[..., inside]
            state = moves.step(state, one)
        elif burst.sum(axis=(-2, -1)).max() < _REMAINDER:
            break
    return StartEnd(
        np.stack(ends, axis=-1), np.arange(1, positions + 1), np.arange(1, len(ends) + 1)
    )


def bursts_without(automaton: Automaton, noise: float, marked: float) -> float:
    """Share of the bursts of noise that hold no marked one, each one being marked by chance.

    The ones of a burst are those since the automaton last was in its initial or an end state.

    Args:
        automaton: the automaton.
        noise: probability p_N of a one.
        marked: probability that a one is marked.

    Returns:
        Share.
    """
    limit = noise_state(automaton, noise)
    burst = automaton.output == Output.BURST
    ends = automaton.output == Output.END
    fresh = ends.copy()
    fresh[0] = True
    plain = _Moves(automaton.following).matrix(1.0 - noise, noise * (1.0 - marked))
    entering = (plain @ np.where(fresh, limit, 0.0))[~fresh]
    inner = identity(len(entering)) - plain[~fresh][:, ~fresh]
    without = np.zeros(len(automaton))
    without[~fresh] = spsolve(inner.tocsc(), entering)
    ended = (plain @ np.where(burst, without, 0.0))[ends].sum()
    return float(ended / limit[ends].sum())


def _taken(which: npt.NDArray[np.bool_], state: FloatArray, one: npt.ArrayLike) -> FloatArray:
    """Probability to take any of some transitions, `which` of shape (states, 2)."""
    one = np.asarray(one, dtype=float)
    on_zero, on_one = (state[..., which[:, bit]].sum(axis=-1) for bit in (0, 1))
    return np.asarray(on_zero * (1.0 - one) + on_one * one)
