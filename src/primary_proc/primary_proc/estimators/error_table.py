# SPDX-License-Identifier: Apache-2.0
"""Bias and standard deviation of an estimator against the burst's peak, learnt from trial bursts."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.optimize import nnls

from primary_proc.estimators.trial_bursts import TrialBursts

FloatArray = npt.NDArray[np.float64]

_FEWEST = 20
_CLOSEST = 1.5
_LEAST_VARIANCE = 1e-6


@dataclass(frozen=True, slots=True)
class ErrorTable:
    """What the peak of a burst says about the error of its azimuth.

    A peak tells the target's strength roughly only. So the table is not the error at the strength that has such a peak
    in the median: it is made so that over the peaks of each strength the mean of the stated variances is the true one.

    Attributes:
        power: peak power over the mean noise power, rising, shape (n,).
        bias: in pulses, shape (n,).
        variance: in pulses squared, shape (n,).
    """

    power: FloatArray
    bias: FloatArray
    variance: FloatArray

    @classmethod
    def learn(cls, trial: TrialBursts, positions: FloatArray) -> ErrorTable:
        """Fit the table, linear over the logarithm of the peak, to the errors at all strengths.

        Args:
            trial: bursts whose truth is known.
            positions: what an estimator says of them, in pulses, shape (bursts,).

        Returns:
            The table.
        """
        strengths = len(trial.amplitudes)
        count = np.bincount(trial.strength, minlength=strengths)
        used = np.flatnonzero(count >= _FEWEST)
        power = _spread(trial.powers[used])
        hats = _hats(trial.bursts["power"], power)
        error = positions - trial.truth
        summed = [np.bincount(trial.strength, hat, strengths)[used] for hat in hats.T]
        mean_hats = np.stack(summed, axis=1) / count[used, None]
        mean, mean_square = (
            np.bincount(trial.strength, error**order, strengths)[used] / count[used]
            for order in (1, 2)
        )
        certainty = np.sqrt(count[used] / np.maximum(mean_square - mean**2, _LEAST_VARIANCE))
        bias = np.linalg.lstsq(mean_hats * certainty[:, None], mean * certainty, rcond=None)[0]
        square = (error - hats @ bias) ** 2
        true = np.bincount(trial.strength, square, strengths)[used] / count[used]
        true = np.maximum(true, _LEAST_VARIANCE)
        certainty = np.sqrt(count[used]) / true
        variance, _ = nnls(mean_hats * certainty[:, None], true * certainty)
        return cls(power, bias.astype(float), np.maximum(variance, true.min() / 4.0))

    def look_up(self, power: npt.ArrayLike) -> tuple[FloatArray, FloatArray]:
        """Interpolate; beyond the ends the last value holds.

        Args:
            power: peak power over the mean noise power, shape (n,).

        Returns:
            (bias, std) in pulses, each of shape (n,).
        """
        position, grid = np.log(power), np.log(self.power)
        return (
            np.interp(position, grid, self.bias),
            np.sqrt(np.interp(position, grid, self.variance)),
        )


def _spread(power: FloatArray) -> FloatArray:
    """Leave out powers that are too near the one before to be told apart by single peaks."""
    kept = [power[0]]
    for value in power[1:]:
        if value >= _CLOSEST * kept[-1]:
            kept.append(value)
    return np.array(kept)


def _hats(power: npt.NDArray[np.float32], grid: FloatArray) -> FloatArray:
    """Weight of each node of a linear interpolation over the logarithm, shape (powers, nodes)."""
    place = np.interp(np.log(power), np.log(grid), np.arange(len(grid)))
    return np.maximum(1.0 - np.abs(place[:, None] - np.arange(len(grid))), 0.0)
