# SPDX-License-Identifier: Apache-2.0
"""Constant gains of least total error, random and dynamic, for a target that accelerates.

Source: Kuzmin 1967, § 4.5.4, (4.107)-(4.112), exact where the tracker's smoother interpolates. The best gains to smooth
and to predict differ: with growing acceleration the former tend to no smoothing, the latter's alpha never exceeds 1/2.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from secondary_proc.calculators.alpha_beta_dynamics import dynamic_error, random_variance
from secondary_proc.calculators.alpha_beta_gains import (
    CRITERIA,
    manoeuvre_intensity,
    optimal_alpha,
)

_LEAST = 1e-9


@dataclass(frozen=True, slots=True)
class Optimum:
    """Gains and what they achieve.

    Attributes:
        alpha: gain of the coordinate.
        beta: gain of the velocity.
        error: mean square total error over the variance of a plot.
    """

    alpha: float
    beta: float
    error: float


def total_error(criterion: str, alpha: float, beta: float, intensity: float) -> float:
    """Mean square of random and dynamic error together.

    Source: (4.107), (4.108).

    Args:
        criterion: "smoothed" or "predicted" coordinate.
        alpha: gain of the coordinate inside the stability triangle.
        beta: gain of the velocity.
        intensity: Gamma^2, square of (acceleration times T_0^2 over the error of a plot).

    Returns:
        Error over the variance of a plot.

    Raises:
        ValueError: there is no such criterion.
    """
    lag = dynamic_error(criterion, alpha, beta)
    return float(random_variance(criterion, alpha, beta) + intensity * lag**2)


def optimal_gains(intensity: float, criterion: str = "smoothed") -> Optimum:
    """Minimise the total error.

    Args:
        intensity: Gamma^2, square of (acceleration times T_0^2 over the error of a plot), 1e-20 to 1e6.
        criterion: "smoothed" for displays, by (4.111), or "predicted" for gates, by (4.112).

    Returns:
        The optimum.

    Raises:
        ValueError: there is no such criterion, or the intensity is out of its range.
    """
    if criterion not in CRITERIA:
        raise ValueError(f"no criterion {criterion!r}; there are {', '.join(CRITERIA)}")
    if not 1e-20 <= intensity <= 1e6:
        raise ValueError(f"no optimum is computed for the intensity {intensity:g}")
    # Where beta approaches 2 or 4 the intensity grows without bound.
    most = 2.0 if criterion == "smoothed" else 4.0
    beta = _solve(lambda b: float(manoeuvre_intensity(b, criterion)), intensity, most)
    alpha = float(optimal_alpha(beta, criterion))
    return Optimum(alpha, beta, total_error(criterion, alpha, beta, intensity))


def _solve(curve: Callable[[float], float], intensity: float, most: float) -> float:
    # Intensities span many powers of ten, over which the logarithm of beta is nearly straight.
    found = brentq(
        lambda log: np.log(curve(np.exp(log)) / intensity), np.log(_LEAST), np.log(most) - _LEAST
    )
    return float(np.exp(found))
