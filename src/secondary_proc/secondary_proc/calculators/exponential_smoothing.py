# SPDX-License-Identifier: Apache-2.0
"""Exponential smoothing of speed or course, each value of which comes from two adjacent plots.

Source: Kuzmin 1967, § 4.6.5-4.6.6, (4.118)-(4.126). The coefficient zeta is the weight of the old value. Successive
values share a plot, so their errors are correlated by -1/2 (4.123). Variances are over that of one value.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from scipy.optimize import brentq
from scipy.stats import norm

from secondary_proc.calculators.rule_chain import FloatArray

QUIET_ZETA, MANOEUVRE_ZETA = 0.4, 0.1
NO_SMOOTHING_FROM = 1.5
"""Intensity of a turn from which on the best smoothing is none."""


def exponential_weights(zeta: float, values: int) -> FloatArray:
    """Weights of the newest values.

    Source: (4.119).

    Args:
        zeta: in [0, 1).
        values: number of values.

    Returns:
        (1 - zeta) zeta^i for the value i scans old, shape (values,).
    """
    return np.asarray((1.0 - zeta) * zeta ** np.arange(values))


def exponential_variance(zeta: npt.ArrayLike) -> FloatArray:
    """Random error.

    Source: (4.124).

    Args:
        zeta: in [0, 1), any shape.

    Returns:
        Variance, same shape.
    """
    z = np.asarray(zeta, dtype=float)
    return np.asarray((1.0 - z) ** 2 / (1.0 + z))


def exponential_lag(zeta: npt.ArrayLike) -> FloatArray:
    """Dynamic error of the prediction in a steady turn, the course a scan ahead less the smoothed one.

    Source: (4.125).

    Args:
        zeta: in [0, 1), any shape.

    Returns:
        Lag over the turn in a scan, same shape.
    """
    return np.asarray(1.0 / (1.0 - np.asarray(zeta, dtype=float)))


def total_variance(zeta: npt.ArrayLike, intensity: npt.ArrayLike) -> FloatArray:
    """Mean square of random and dynamic error together.

    Source: (4.126).

    Args:
        zeta: in [0, 1), any shape.
        intensity: psi^2, square of (turn in a scan over the error of one course), any shape that fits.

    Returns:
        Error, in the common shape.
    """
    return np.asarray(
        exponential_variance(zeta) + np.asarray(intensity) * exponential_lag(zeta) ** 2
    )


def turn_intensity(zeta: npt.ArrayLike) -> FloatArray:
    """Intensity of a turn for which a coefficient is the best.

    Source: the equation of the optimum after (4.126), exponents corrected.

    Args:
        zeta: in [0, 1), any shape.

    Returns:
        psi^2 = (1 - zeta)^4 (3 + zeta) / (2 (1 + zeta)^2), same shape.
    """
    z = np.asarray(zeta, dtype=float)
    return np.asarray((1.0 - z) ** 4 * (3.0 + z) / (2.0 * (1.0 + z) ** 2))


def optimal_zeta(intensity: float) -> float:
    """Coefficient of least total error.

    Args:
        intensity: psi^2, positive.

    Returns:
        zeta in [0, 1).

    Raises:
        ValueError: the intensity is not positive: without turns the longest memory is the best.
    """
    if not intensity > 0.0:
        raise ValueError(f"there is no best coefficient for the intensity {intensity:g}")
    if intensity >= NO_SMOOTHING_FROM:
        return 0.0
    return float(brentq(lambda z: float(turn_intensity(z)) - intensity, 0.0, 1.0 - 1e-12))


def two_scan_detection(turn: npt.ArrayLike, sigmas: npt.ArrayLike = 1.0) -> FloatArray:
    """Probability that a manoeuvre is declared from the mean change of two scans.

    The mean is half the difference of two values that share no plot, so its variance is one half; the book declares a
    manoeuvre from that variance on, g = 1, which one scan of straight flight in three reaches.

    Args:
        turn: change in a scan over the error of one value; 0 for straight flight, any shape.
        sigmas: g, threshold in standard deviations of the mean, any shape that fits.

    Returns:
        Probability, in the common shape.
    """
    shift = np.asarray(turn, dtype=float) * np.sqrt(2.0)
    level = np.asarray(sigmas, dtype=float)
    return np.asarray(norm.sf(level - shift) + norm.sf(level + shift))
