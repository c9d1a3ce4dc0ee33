# SPDX-License-Identifier: Apache-2.0
"""Weights that make a sum of quantised pulses a log-likelihood ratio, and their rounding to short whole numbers."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from primary_proc.calculators.pulse.single_pulse import threshold_for
from primary_proc.calculators.pulse.target_models import TARGETS

FloatArray = npt.NDArray[np.float64]

_LEAST = 1e-16


def binary_weights(noise: float, amplitude: npt.ArrayLike, target: str = "steady") -> FloatArray:
    """Weight of a one at each position of a burst, eta = ln(p_S q_N / (p_N q_S)).

    Source: Kuzmin 1967, (3.7).

    Args:
        noise: probability p_N of a one in noise.
        amplitude: rms amplitude of the target over the noise's sigma at each position, any shape.
        target: name in `TARGETS`.

    Returns:
        eta, same shape; zero where there is no target.
    """
    one = TARGETS[target].single_pulse(threshold_for(noise), amplitude)
    zero = np.maximum(1.0 - one, _LEAST)
    return np.asarray(np.log(one / noise) - np.log(zero / (1.0 - noise)))


def binary_threshold(log_ratio: float, noise: float, signal: npt.ArrayLike) -> float:
    """Threshold of the weighted sum of ones that stands for one of the likelihood ratio.

    Source: Kuzmin 1967, (3.7); over the common weight of a rectangular burst it is (3.8).

    Args:
        log_ratio: ln l_0, see `decision_criteria`.
        noise: probability p_N of a one in noise.
        signal: probability of a one at each position of the target, shape (positions,).

    Returns:
        ln l_0 - sum ln(q_S / q_N).
    """
    zero = np.maximum(1.0 - np.asarray(signal, dtype=float), _LEAST)
    return float(log_ratio - np.log(zero / (1.0 - noise)).sum())


def level_probabilities(
    thresholds: npt.ArrayLike, amplitude: npt.ArrayLike, target: str = "steady"
) -> FloatArray:
    """Probability of each level of a quantised envelope.

    Source: Kuzmin 1967, § 3.1.2: p_j, the integral of the envelope's density between two thresholds.

    Args:
        thresholds: of the envelope in units of the noise's sigma, rising, shape (k,).
        amplitude: rms amplitude over the noise's sigma, any shape; 0 for noise.
        target: name in `TARGETS`.

    Returns:
        Shape (*amplitude.shape, k + 1).
    """
    level = np.asarray(amplitude, dtype=float)[..., None]
    over = TARGETS[target].single_pulse(np.asarray(thresholds, dtype=float), level)
    edge = np.ones_like(over[..., :1])
    return -np.diff(np.concatenate([edge, over, 0.0 * edge], axis=-1), axis=-1)


def level_weights(
    thresholds: npt.ArrayLike, amplitude: npt.ArrayLike, target: str = "steady"
) -> FloatArray:
    """Weight of each level, eta_j = ln(p_jS / p_jN).

    Source: Kuzmin 1967, (3.9)-(3.11).

    Args:
        thresholds: of the envelope in units of the noise's sigma, rising, shape (k,).
        amplitude: rms amplitude over the noise's sigma, any shape.
        target: name in `TARGETS`.

    Returns:
        Shape (*amplitude.shape, k + 1), rising with the level.
    """
    signal = level_probabilities(thresholds, amplitude, target)
    noise = level_probabilities(thresholds, 0.0)
    weights = np.log(np.maximum(signal, _LEAST)) - np.log(noise)
    # The ratio of the densities rises with the envelope; where a level is too unlikely for floats, it stays.
    return np.asarray(np.maximum.accumulate(weights, axis=-1))


def weight_bits(error: float) -> int:
    """Bits that hold a weight to a relative error of the largest one.

    Source: Kuzmin 1967, § 3.1.6: k_b = log2(100 / 2 delta + 1), delta in per cent.

    Args:
        error: largest error over the largest weight, in (0, 0.5].

    Returns:
        k_b.
    """
    return math.ceil(math.log2(1.0 / (2.0 * error) + 1.0))


def whole_weights(weights: npt.ArrayLike, bits: int) -> FloatArray:
    """Round weights to whole numbers of few bits, the largest using them all.

    Args:
        weights: not negative, any shape.
        bits: k_b.

    Returns:
        Same shape.
    """
    values = np.asarray(weights, dtype=float)
    return np.rint(values / values.max() * (2**bits - 1))
