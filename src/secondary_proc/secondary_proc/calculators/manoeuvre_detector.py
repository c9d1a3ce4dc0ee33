# SPDX-License-Identifier: Apache-2.0
"""The manoeuvre detector that compares the estimated acceleration of n plots with its own error.

Source: Kuzmin 1967, § 4.4.4, (4.69) and after: a manoeuvre is declared where (a T_0^2)^2 >= g^2 K sigma_y^2; the book
has g = 1 and no error probabilities.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from scipy.stats import norm

from secondary_proc.calculators.parabola_estimator import (
    parabola_acceleration_variance,
    parabola_acceleration_weights,
)
from secondary_proc.calculators.rule_chain import FloatArray


def false_manoeuvre_probability(sigmas: npt.ArrayLike) -> FloatArray:
    """Probability that a manoeuvre is declared in straight flight, by one coordinate in one scan.

    Args:
        sigmas: g, threshold in standard deviations of the estimate, any shape.

    Returns:
        Probability, same shape.
    """
    return np.asarray(2.0 * norm.sf(np.asarray(sigmas, dtype=float)))


def sigmas_for(false_manoeuvre: float) -> float:
    """Threshold for a wanted error, the inverse of `false_manoeuvre_probability`.

    Args:
        false_manoeuvre: probability that a manoeuvre is declared in straight flight, in (0, 1).

    Returns:
        g in standard deviations of the estimate.
    """
    return float(norm.isf(false_manoeuvre / 2.0))


def manoeuvre_detection(
    plots: int, sigmas: float, intensity: npt.ArrayLike, scans: npt.ArrayLike | None = None
) -> FloatArray:
    """Probability that a manoeuvre is declared in a given scan after its beginning.

    Args:
        plots: n that the acceleration is estimated from, at least 3.
        sigmas: g.
        intensity: acceleration times T_0^2 over sigma_y, any shape.
        scans: scans since the manoeuvre began, any shape that fits; None once all plots are in it.

    Returns:
        Probability, in the common shape.
    """
    since = np.asarray(plots - 1 if scans is None else scans, dtype=float)
    time = np.maximum(since[..., None] - np.arange(plots)[::-1], 0.0)
    seen = (time**2 / 2.0) @ parabola_acceleration_weights(plots)
    shift = np.asarray(intensity) * seen / np.sqrt(parabola_acceleration_variance(plots))
    return np.asarray(norm.sf(sigmas - shift) + norm.sf(sigmas + shift))
