# SPDX-License-Identifier: Apache-2.0
"""What a burst's peak tells about the accuracy of its azimuth: a table made once from the exact chain."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.special import chndtr

from primary_proc.antenna_pattern import burst_shape
from primary_proc.automaton import Program
from primary_proc.azimuth_accuracy import azimuth_error
from primary_proc.single_pulse import steady_probability, threshold_for

FloatArray = npt.NDArray[np.float64]

_AMPLITUDES = np.geomspace(1.0, 32.0, 26)
_OFFSETS = np.array([-0.375, -0.125, 0.125, 0.375])
_BISECTIONS = 30


@dataclass(frozen=True, slots=True)
class AccuracyTable:
    """Bias and standard deviation of the start-end azimuth as a function of the burst's peak.

    Attributes:
        power: median peak power over the mean noise power, rising, shape (n,).
        bias: of the middle between start and end, in steps, shape (n,).
        std: in steps, shape (n,).
    """

    power: FloatArray
    bias: FloatArray
    std: FloatArray

    def look_up(self, power: npt.ArrayLike) -> tuple[FloatArray, FloatArray]:
        """Interpolate over the logarithm of the peak; beyond the ends the last value holds.

        Args:
            power: peak power over the mean noise power, shape (n,).

        Returns:
            (bias, std) in steps, each of shape (n,).
        """
        position = np.log(power)
        grid = np.log(self.power)
        return np.interp(position, grid, self.bias), np.interp(position, grid, self.std)


def accuracy_table(program: Program, noise: float, pattern: str, pulses: float) -> AccuracyTable:
    """Make the table for a detector and a beam.

    The target does not fluctuate and lies anywhere between two pulses. Its amplitude is judged by the peak, which in
    the median over the burst's pulses belongs to it.

    Args:
        program: l/m-k.
        noise: probability p_N of a one in noise.
        pattern: antenna pattern's name.
        pulses: N_0.

    Returns:
        The table.
    """
    threshold = float(threshold_for(noise))
    shape = burst_shape(pattern, pulses, _OFFSETS, book=False)
    amplitude = _AMPLITUDES[:, None, None] * shape
    error = azimuth_error(program, noise, steady_probability(threshold, amplitude), _OFFSETS)
    weight = error.bursts / error.bursts.sum(axis=1, keepdims=True)
    bias = (weight * error.bias).sum(axis=1)
    variance = (weight * (error.std**2 + (error.bias - bias[:, None]) ** 2)).sum(axis=1)
    peak = np.maximum(_median_peak(amplitude[:, 1]), threshold)
    return AccuracyTable(np.maximum.accumulate(peak**2 / 2.0), bias, np.sqrt(variance))


def _median_peak(amplitude: FloatArray) -> FloatArray:
    """Median of the largest envelope over a burst's pulses, amplitudes of shape (n, positions)."""
    low = np.zeros(len(amplitude))
    high = amplitude.max(axis=1) + 10.0
    for _ in range(_BISECTIONS):
        middle = (low + high) / 2.0
        below = chndtr(middle[:, None] ** 2, 2.0, amplitude**2).prod(axis=1) < 0.5
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    return (low + high) / 2.0
