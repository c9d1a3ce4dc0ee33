# SPDX-License-Identifier: Apache-2.0
"""Probability that one pulse's envelope, in units of the noise's sigma, exceeds a threshold."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from scipy.special import chndtr

FloatArray = npt.NDArray[np.float64]


def threshold_for(noise_probability: npt.ArrayLike) -> FloatArray:
    """Threshold that noise exceeds with a given probability.

    Source: Kuzmin 1967, (2.36).

    Args:
        noise_probability: p_N in (0, 1], any shape.

    Returns:
        x_0 in units of the noise's sigma, same shape.
    """
    return np.asarray(np.sqrt(-2.0 * np.log(noise_probability)))


def steady_probability(threshold: npt.ArrayLike, amplitude: npt.ArrayLike) -> FloatArray:
    """Probability of a one from a target that does not fluctuate (Rice envelope; Marcum's Q_1).

    Source: Kuzmin 1967, (2.37).

    Args:
        threshold: x_0 in units of the noise's sigma.
        amplitude: a, voltage of the target over the noise's sigma; broadcast with the threshold.

    Returns:
        Probability, of the broadcast shape.
    """
    below = chndtr(np.square(threshold), 2.0, np.square(amplitude))
    # scipy 1.11 lets it exceed one by a rounding error.
    return np.asarray(np.maximum(1.0 - below, 0.0))


def fluctuating_probability(threshold: npt.ArrayLike, amplitude: npt.ArrayLike) -> FloatArray:
    """Probability of a one from a target that fluctuates from pulse to pulse (Rayleigh envelope).

    Source: Kuzmin 1967, § 2.3 and (3.18).

    Args:
        threshold: x_0 in units of the noise's sigma.
        amplitude: k, rms voltage ratio; broadcast with the threshold.

    Returns:
        Probability, of the broadcast shape.
    """
    return np.asarray(np.exp(-np.square(threshold) / (2.0 * (1.0 + np.square(amplitude)))))
