# SPDX-License-Identifier: Apache-2.0
"""What a burst's peak tells about the accuracy of its azimuth: a table made once from the exact chain."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from primary_proc.automata.automaton_chain import StartEnd, first_detection, start_end_distribution
from primary_proc.automata.burst_rule import BurstRule
from primary_proc.calculators.pulse.burst_shape import burst_shape
from primary_proc.calculators.pulse.single_pulse import threshold_for
from primary_proc.calculators.pulse.target_models import TARGETS, TargetModel

FloatArray = npt.NDArray[np.float64]

_AMPLITUDES = np.geomspace(1.0, 32.0, 26)
_OFFSETS = np.array([-0.375, -0.125, 0.125, 0.375])
_BISECTIONS = 30


@dataclass(frozen=True, slots=True)
class AccuracyTable:
    """Bias and standard deviation of the start-end azimuth as a function of the burst's peak.

    Attributes:
        strength: mean power of the target at the beam's axis over the mean noise power, rising, shape (n,).
        power: median peak power over the mean noise power that goes with it, rising, shape (n,).
        bias: of the middle between start and end, in steps, shape (n,).
        std: in steps, shape (n,).
    """

    strength: FloatArray
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

    def std_at(self, snr_db: npt.ArrayLike) -> FloatArray:
        """Standard deviation for targets of known strength, for predictions.

        Args:
            snr_db: mean power at the beam's axis over the mean noise power, shape (n,).

        Returns:
            In steps, shape (n,); beyond the ends the last value holds.
        """
        grid = 10.0 * np.log10(self.strength)
        return np.asarray(np.interp(np.asarray(snr_db, dtype=float), grid, self.std))


def accuracy_table(
    rule: BurstRule, noise: float, pattern: str, pulses: float, target: str = "steady"
) -> AccuracyTable:
    """Make the table for a detector and a beam.

    The target lies anywhere between two pulses. Its amplitude is judged by the peak, which in the median over the
    burst's pulses belongs to it.

    Args:
        rule: of the detector.
        noise: probability p_N of a one in noise.
        pattern: antenna pattern's name.
        pulses: N_0.
        target: name in `TARGETS`. What is common to a burst's pulses shows in its peak, so that slow models have the
            table of steady targets.

    Returns:
        The table.
    """
    threshold = float(threshold_for(noise))
    shape = burst_shape(pattern, pulses, _OFFSETS, book=False)
    amplitude = _AMPLITUDES[:, None, None] * shape
    signal = TARGETS[target].single_pulse(threshold, amplitude)
    joint = start_end_distribution(rule.automaton, noise, signal)
    position = (shape.shape[-1] + 1) / 2.0 + _OFFSETS[:, None, None]
    weight = _of_plots(rule.memory, joint, position, first_detection(rule.automaton, noise, signal))
    weight /= weight.sum(axis=(1, 2, 3), keepdims=True)
    error = (joint.start[:, None] + joint.end) / 2.0 - position
    bias = (weight * error).sum(axis=(1, 2, 3))
    variance = (weight * error**2).sum(axis=(1, 2, 3)) - bias**2
    peak = np.maximum(_median_peak(TARGETS[target], amplitude[:, 1]), threshold)
    rising = np.maximum.accumulate(peak**2 / 2.0)
    return AccuracyTable(_AMPLITUDES**2 / 2.0, rising, bias, np.sqrt(variance))


def _of_plots(
    memory: int, joint: StartEnd, position: FloatArray, detected: FloatArray
) -> FloatArray:
    """Probability of each start and end to be the burst that a plot is made of.

    Where a target gives several bursts, the one over its middle outweighs the fragments beside it. Those count as far
    as there is no burst over the middle.
    """
    over = (joint.start[:, None] - memory - 1 < position) & (joint.end >= position)
    middle = np.where(over, joint.probability, 0.0)
    beside = joint.probability - middle
    alone = np.maximum(detected - middle.sum(axis=(-2, -1)), 0.0)
    fragments = np.maximum(beside.sum(axis=(-2, -1)), np.finfo(float).tiny)
    return middle + beside * np.minimum(alone / fragments, 1.0)[..., None, None]


def _median_peak(target: TargetModel, amplitude: FloatArray) -> FloatArray:
    """Median of the largest envelope over a burst's pulses, amplitudes of shape (n, positions)."""
    low = np.zeros(len(amplitude))
    high = 5.0 * amplitude.max(axis=1) + 10.0
    for _ in range(_BISECTIONS):
        middle = (low + high) / 2.0
        below = (1.0 - target.single_pulse(middle[:, None], amplitude)).prod(axis=1) < 0.5
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    return (low + high) / 2.0
