# SPDX-License-Identifier: Apache-2.0
"""How the pulses of a burst change as the target's azimuth changes: what azimuth accuracy is made of."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.special import chndtr, ive

from primary_proc.calculators.pulse.single_pulse import fluctuating_probability
from radar_common.antenna_pattern import PATTERNS

FloatArray = npt.NDArray[np.float64]

_STEP = 1e-6
_LEAST_ZERO = 1e-30


@dataclass(frozen=True, slots=True)
class OnesAndSlopes:
    """Bits of a burst.

    Attributes:
        probability: of a one at each position, p, shape (..., positions).
        slope: its derivative by the target's azimuth, per step, same shape.
        zero: of a zero, 1 - p without cancellation near one, same shape.
    """

    probability: FloatArray
    slope: FloatArray
    zero: FloatArray


def pattern_slope(pattern: str, alpha: npt.ArrayLike) -> FloatArray:
    """Derivative of the two-way amplitude by the normalised angle, dg / d alpha.

    A central difference over 2e-6. The step at the edge of a rectangle is no derivative and is left out.

    Args:
        pattern: antenna pattern's name.
        alpha: angle off the axis over the half width phi, any shape.

    Returns:
        Same shape; zero beyond the pattern's extent.
    """
    beam, angle = PATTERNS[pattern], np.asarray(alpha, dtype=float)
    slope = (beam.amplitude(angle + _STEP) - beam.amplitude(angle - _STEP)) / (2.0 * _STEP)
    return np.where(np.abs(angle) <= beam.extent, slope, 0.0)


def ones_and_slopes(
    threshold: float,
    strength: npt.ArrayLike,
    shape: npt.ArrayLike,
    shape_slope: npt.ArrayLike,
    fluctuation: str = "steady",
) -> OnesAndSlopes:
    """Probability of a one on each position and its derivative by the target's azimuth.

    Source: Kuzmin 1967, (2.37) and (3.27) for steady targets, the factor before the exponential being x_0; (3.33) for
    targets that fluctuate from pulse to pulse, with k_0^2 for the first factor.

    Args:
        threshold: x_0 in units of the noise's sigma.
        strength: a_0 of a steady target, k_0 of a fluctuating one; broadcast with the shape.
        shape: g on the positions, shape (..., positions).
        shape_slope: its derivative by the target's azimuth, per step, same shape.
        fluctuation: "steady" or "fast".

    Returns:
        Probabilities and slopes.

    Raises:
        ValueError: the fluctuation is neither.
    """
    strength, shape = np.asarray(strength, dtype=float), np.asarray(shape, dtype=float)
    amplitude = strength * shape
    if fluctuation == "steady":
        zero = chndtr(threshold**2, 2.0, amplitude**2)
        # exp(-(x0^2 + a^2) / 2) I_1(x0 a), scaled so that it does not overflow.
        bell = np.exp(-0.5 * (threshold - amplitude) ** 2) * ive(1, threshold * amplitude)
        slope = threshold * bell * strength * np.asarray(shape_slope)
        # A zero that never comes tells nothing, and scipy 1.11 loses the digits of its probability far out.
        told = np.where(zero > _LEAST_ZERO, slope, 0.0)
        return OnesAndSlopes(np.maximum(1.0 - zero, 0.0), told, zero)
    if fluctuation != "fast":
        raise ValueError(f"fluctuation {fluctuation!r} is neither steady nor fast")
    probability = fluctuating_probability(threshold, amplitude)
    spread = 1.0 + amplitude**2
    slope = probability * threshold**2 * strength**2 * shape * np.asarray(shape_slope) / spread**2
    return OnesAndSlopes(probability, slope, -np.expm1(-(threshold**2) / (2.0 * spread)))
