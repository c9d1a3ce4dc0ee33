# SPDX-License-Identifier: Apache-2.0
"""Law of a sliding weighted sum and of two neighbouring ones, for independent pulses with scores on any levels.

The characteristic function of a pair of sums is a product over the pulses, each a sum over its levels; one Fourier
transform turns it into probabilities. Whole scores give exact probabilities on the whole numbers. Sums with more values
than that is worth are smoothed to a step far under what a new pulse changes.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]

_FINEST = 1500
_STEPS_PER_CHANGE = 8.0
_STEPS_PER_SUM = 16.0
_SPREAD = 10.0
_NOTHING = 1e-300


@dataclass(frozen=True, slots=True)
class StartRate:
    """How often a sliding sum of noise comes up through a threshold.

    Attributes:
        threshold: on the sum, rising, evenly spaced, shape (n,).
        probability: per position that the sum reaches the threshold and the one before did not, shape (n,).
        whole: whether thresholds between those given mean the next above.
    """

    threshold: FloatArray
    probability: FloatArray
    whole: bool

    def at(self, threshold: float) -> float:
        """Probability at a threshold.

        Args:
            threshold: on the sum.

        Returns:
            Per position; zero above what the sum can reach.
        """
        if self.whole:
            index = int(np.searchsorted(self.threshold, threshold - 1e-9))
            return float(self.probability[index]) if index < len(self.probability) else 0.0
        rising = self.probability > 0.0
        logarithm = np.log(self.probability[rising])
        return float(np.exp(np.interp(threshold, self.threshold[rising], logarithm)))

    def threshold_for(self, probability: float) -> float:
        """Lowest threshold beyond the peak of the rate that is crossed no more often than wanted.

        Args:
            probability: per position.

        Returns:
            Threshold on the sum.

        Raises:
            ValueError: the sum cannot be crossed so seldom or so often.
        """
        top = int(np.argmax(self.probability))
        falling = self.probability[top:]
        seldom = np.flatnonzero(falling <= probability)
        if not len(seldom) or falling[seldom[0]] <= 0.0 or not seldom[0]:
            raise ValueError(
                f"no threshold of the sum is crossed with a probability of {probability:.3g} per position; "
                f"it can be {falling[falling > 0.0].min():.3g} to {falling[0]:.3g}"
            )
        index = top + int(seldom[0])
        if self.whole:
            return float(self.threshold[index])
        pair = slice(index - 1, index + 1)
        logarithm = np.log(self.probability[pair])
        share = (logarithm[0] - np.log(probability)) / (logarithm[0] - logarithm[1])
        return float(self.threshold[index - 1] + share * np.diff(self.threshold[pair])[0])


def sum_law(scores: npt.ArrayLike, probability: npt.ArrayLike) -> FloatArray:
    """Exact law of a sum of independent whole scores, by adding one pulse after another.

    Args:
        scores: whole score of each level, from 0, of each pulse, shape (pulses, levels).
        probability: of each level, shape (levels,) or (pulses, levels).

    Returns:
        Probability of the sums 0, 1, ..., shape (largest sum + 1,).
    """
    whole = np.rint(np.asarray(scores)).astype(np.int64)
    chance = np.broadcast_to(np.asarray(probability, dtype=float), whole.shape)
    law = np.ones(1)
    for score, weight in zip(whole, chance, strict=True):
        law = np.convolve(law, np.bincount(score, weight))
    return law


def start_rate(scores: npt.ArrayLike, probability: npt.ArrayLike) -> StartRate:
    """P(s_(j-1) < L <= s_j) for all thresholds L: a sliding sum starts a burst at position j.

    Args:
        scores: score of each level at each place in the register, the oldest pulse first, zero for the lowest level
            and never negative in sum, shape (pulses, levels).
        probability: of each level in noise, shape (levels,).

    Returns:
        The rate against the threshold.
    """
    table = np.asarray(scores, dtype=float)
    chance = np.asarray(probability, dtype=float)
    top = table.max(axis=1)
    whole = bool((table == np.rint(table)).all()) and top.sum() <= _FINEST
    if whole and (table == table[0]).all():
        return _equal_weights(table[0], chance, len(table))
    edge = np.zeros((1, table.shape[1]))
    now = np.concatenate([edge, table])
    change = now - np.concatenate([table, edge])
    if whole:
        span = int(max(np.clip(side * change, 0.0, None).max(axis=1).sum() for side in (1, -1)))
        return _rate_of(now, change, chance, 1.0, int(top.sum()) + 1, 2 * span + 1, True)
    step = _spread(change, chance) / _STEPS_PER_CHANGE
    width = 2 * int(_SPREAD * _STEPS_PER_CHANGE) + 1
    # The sum itself varies more slowly than it changes from pulse to pulse.
    stride = max(1, int(_spread(now, chance) / (_STEPS_PER_SUM * step)))
    reach = _reach(now, chance, stride * step)
    return _rate_of(now, change, chance, step, reach, width, False, stride)


def _spread(scores: FloatArray, chance: FloatArray) -> float:
    """Standard deviation of a sum of independent scores."""
    return float(np.sqrt((np.square(scores) @ chance - np.square(scores @ chance)).sum()))


def _equal_weights(score: FloatArray, chance: FloatArray, pulses: int) -> StartRate:
    """One pulse leaves, one comes, all others stay."""
    single = np.bincount(score.astype(np.int64), chance)
    others = sum_law(np.tile(score, (pulses - 1, 1)), chance)
    reaches = np.append(np.cumsum(single[::-1])[::-1], 0.0)
    largest = len(others) + len(single) - 2
    threshold = np.arange(1, largest + 1)
    lacking = np.clip(threshold[:, None] - np.arange(len(others)), 0, len(single))
    return StartRate(
        threshold.astype(float), (others * reaches[lacking] * (1.0 - reaches[lacking])).sum(1), True
    )


def _reach(now: FloatArray, chance: FloatArray, step: float) -> int:
    """Steps up to where the sum of noise comes with a probability of about 1e-15, by Chernoff's bound."""
    top = float(now.max(axis=1).sum())
    tilt = np.geomspace(1e-3, 1e3, 121) / max(float((now @ chance).sum()), step)
    peak = now.max(axis=1)
    with np.errstate(over="ignore", under="ignore"):
        moment = [
            float((np.log(np.exp(t * (now - peak[:, None])) @ chance) + t * peak).sum())
            for t in tilt
        ]
    bound = float(np.min((np.array(moment) + 34.5) / tilt))
    return int(np.ceil(min(1.02 * bound, top) / step)) + 8


def _rate_of(
    now: FloatArray,
    change: FloatArray,
    chance: FloatArray,
    step: float,
    sums: int,
    changes: int,
    whole: bool,
    stride: int = 1,
) -> StartRate:
    """Joint law of a sum, in strides of steps, and its change since the position before; from it the rate."""
    sums += sums % 2
    spacing = stride * step
    turn_sum = 2.0 * np.pi / (sums * spacing) * np.arange(sums // 2 + 1)
    turn_change = 2.0 * np.pi * np.fft.fftfreq(changes) / step
    joint = np.ones((len(turn_sum), changes), complex)
    for score, moved in zip(now, change, strict=True):
        left = np.exp(-1j * np.outer(turn_sum, score)) * chance
        joint *= left @ np.exp(-1j * np.outer(moved, turn_change))
    law = np.fft.irfft(np.fft.ifft(joint, axis=1), n=sums, axis=0)
    # A rise by d crosses the thresholds that lie within d under the sum reached.
    rises = np.arange(1, changes // 2 + 1)
    room = rises[-1] // stride + 2
    above = np.zeros((sums + room, len(rises)))
    above[:sums] = np.cumsum(law[::-1, rises], axis=0)[::-1]
    column = np.arange(len(rises))
    past, part = np.divmod(rises, stride)
    row = np.arange(sums)[:, None] + past
    near, far = above[row, column], above[row + 1, column]
    if stride > 1:
        # Between two sums the tail falls off exponentially.
        near, far = np.maximum(near, _NOTHING), np.maximum(far, _NOTHING)
    ahead = near * (far / near) ** (part / stride) if stride > 1 else near
    probability = np.maximum((above[:sums] - ahead).sum(axis=1), 0.0)
    threshold = np.arange(sums, dtype=float) * spacing
    return StartRate(threshold if whole else threshold - spacing / 2.0, probability, whole)
