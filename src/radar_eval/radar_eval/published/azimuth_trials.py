# SPDX-License-Identifier: Apache-2.0
"""Simulated bursts and what the node's own weights say of their azimuth."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from primary_proc.calculators.integration.burst_weights import binary_weights
from primary_proc.calculators.pulse.single_pulse import steady_probability
from primary_proc.estimators.antisymmetric_weights import AntisymmetricWeights, Weights
from radar_common.antenna_pattern import PATTERNS

FloatArray = npt.NDArray[np.float64]

_BURSTS = 8000
_SEED = 1967
_THRESHOLD = 2.0
_PULSES = 11
_PATTERN = "sinc2"


def amplitude_errors(
    pulses: int, strength: float, potential: Weights, *, fast: bool = False
) -> FloatArray:
    """Errors of the zero crossing on amplitudes in a Gaussian beam, in phi.

    Args:
        pulses: N_0.
        strength: a_0, or k_0 of fast targets.
        potential: what the weights are the derivative of; see `AntisymmetricWeights`.
        fast: whether targets change from pulse to pulse; then squares are weighted.

    Returns:
        Shape (bursts,).
    """
    generator = np.random.default_rng(_SEED)
    weights = AntisymmetricWeights("gaussian", pulses, np.array([strength]), potential)
    truth = generator.uniform(-0.5, 0.5, _BURSTS)
    shape = _shape("gaussian", pulses, weights.reach, truth)
    noise = generator.standard_normal((2, *shape.shape))
    if fast:
        samples = (1.0 + (strength * shape) ** 2) * (noise**2).sum(axis=0)
    else:
        samples = np.hypot(strength * shape + noise[0], noise[1])
    none = np.zeros(_BURSTS)
    return (weights.crossing(samples, none.astype(int), none) - truth) / (pulses / 2.0)


def binary_errors(strength: float) -> tuple[float, float]:
    """Errors on bits of a sinc^2 burst of 11 pulses over x_0 = 2 that have three ones in four pulses near their place.

    Args:
        strength: a_0, for which the weights are made too.

    Returns:
        (zero crossing of the antisymmetric weights nearest to the largest sum of the symmetric ones, place of that sum,
        which is looked for on N_0 positions): rms errors in steps.
    """
    generator = np.random.default_rng(_SEED)
    noise_one = float(np.exp(-(_THRESHOLD**2) / 2.0))

    def log_odds(amplitude: FloatArray, shape: FloatArray) -> FloatArray:
        one = np.clip(steady_probability(_THRESHOLD, amplitude * shape), 1e-9, 1.0 - 1e-9)
        return np.asarray(np.log(one / (1.0 - one)))

    weights = AntisymmetricWeights(_PATTERN, _PULSES, np.array([strength]), log_odds)
    truth = generator.uniform(-0.5, 0.5, _BURSTS)
    shape = _shape(_PATTERN, _PULSES, weights.reach, truth)
    noise = generator.standard_normal((2, *shape.shape))
    bits = (np.hypot(strength * shape + noise[0], noise[1]) > _THRESHOLD).astype(float)
    near = bits[:, weights.reach - 11 : weights.reach + 9]
    ones = np.lib.stride_tricks.sliding_window_view(near, 4, axis=1)
    found = ((ones.sum(axis=-1) >= 3.0) & (ones[..., -1] == 1.0)).any(axis=1)

    shifts = np.arange(-(_PULSES // 2), _PULSES // 2 + 1)
    place = (np.arange(-weights.reach, weights.reach + 1)[:, None] - shifts) / (_PULSES / 2.0)
    sums = bits @ binary_weights(noise_one, strength * PATTERNS[_PATTERN](place))
    largest = sums >= sums.max(axis=1, keepdims=True) - 1e-6
    peak = (largest * shifts).sum(axis=1) / largest.sum(axis=1)
    crossing = weights.crossing(bits, np.zeros(_BURSTS, int), peak)
    errors = [(estimate - truth)[found] for estimate in (crossing, peak)]
    return float(np.sqrt(np.mean(errors[0] ** 2))), float(np.sqrt(np.mean(errors[1] ** 2)))


def _shape(pattern: str, pulses: int, reach: int, truth: FloatArray) -> FloatArray:
    place = np.arange(-reach, reach + 1) - truth[:, None]
    return PATTERNS[pattern](place / (pulses / 2.0))
