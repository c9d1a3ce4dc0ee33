# SPDX-License-Identifier: Apache-2.0
"""Gains of the alpha-beta filter: growing memory, and where it has to stop for a target that manoeuvres.

Source: Kuzmin 1967, § 4.5.1-4.5.4, (4.82a), (4.86), (4.88)-(4.91), (4.107)-(4.112).
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from secondary_proc.calculators.rule_chain import FloatArray

CRITERIA = ("smoothed", "predicted")
GAIN_RULES = (*CRITERIA, "second_increment")
"""What constant gains can be the best for."""

_MOST_BETA = {"smoothed": 1.95, "predicted": 3.8}


def growing_coefficients(n: npt.ArrayLike) -> tuple[FloatArray, FloatArray]:
    """Coefficients that make the recursion equal to the least-squares line through all plots so far.

    Source: (4.86) and (4.82a).

    Args:
        n: number of plots, the new one included, at least 2, any shape.

    Returns:
        (alpha, beta), same shape.
    """
    n = np.asarray(n, dtype=float)
    return 2 * (2 * n - 1) / (n * (n + 1)), 6 / (n * (n + 1))


def aided_coefficients(
    n: npt.ArrayLike, ratio: npt.ArrayLike
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """The same where every plot has an observed velocity too.

    Source: (4.90), (4.91), alpha_n corrected.

    Args:
        n: number of plots, the new one included, at least 2, any shape.
        ratio: c = sigma_y^2 / (sigma_v T_0)^2, any shape that fits; 0 without velocity.

    Returns:
        (alpha, beta, Delta, nabla): gains of the coordinate's residual in coordinate and velocity, then of the
        velocity's residual in both, in the common shape.
    """
    n, c = np.asarray(n, dtype=float), np.asarray(ratio, dtype=float)
    common = n * (n**2 - 1.0 + 12.0 * c)
    return (
        np.asarray(2.0 * ((n - 1.0) * (2.0 * n - 1.0) + 6.0 * c) / common),
        np.asarray(6.0 * (n - 1.0) / common),
        np.asarray(6.0 * c * (n - 1.0) / common),
        np.asarray(12.0 * c / common),
    )


def optimal_alpha(beta: npt.ArrayLike, criterion: str = "smoothed") -> FloatArray:
    """Position coefficient that belongs to a rate coefficient in the optimum.

    Source: (4.111), (4.112).

    Args:
        beta: rate coefficient in (0, 2), in (0, 4) for the prediction, any shape.
        criterion: "smoothed" or "predicted" coordinate.

    Returns:
        alpha, same shape.
    """
    b = np.asarray(beta, dtype=float)
    if criterion == "smoothed":
        return np.asarray(0.5 * np.sqrt(4.0 * b - b**2))
    return np.asarray(np.sqrt(b) - b / 2.0)


def manoeuvre_intensity(beta: npt.ArrayLike, criterion: str = "smoothed") -> FloatArray:
    """Intensity for which given coefficients are optimal.

    Source: after (4.111) and (4.112): gamma^2 = 4 beta^3 / (alpha (4 - 2 alpha - beta)^2) with the alpha of
    `optimal_alpha`.

    Args:
        beta: rate coefficient in (0, 2), in (0, 4) for the prediction, any shape.
        criterion: "smoothed" or "predicted" coordinate.

    Returns:
        Square of (acceleration times period squared over measurement error), same shape.
    """
    b = np.asarray(beta, dtype=float)
    alpha = optimal_alpha(b, criterion)
    return np.asarray(4.0 * b**3 / (alpha * (4.0 - 2.0 * alpha - b) ** 2))


def _table(criterion: str) -> tuple[FloatArray, FloatArray]:
    beta = np.concatenate(
        [
            np.geomspace(1e-6, 0.1, 400, endpoint=False),
            np.linspace(0.1, _MOST_BETA[criterion], 400),
        ]
    )
    return np.log(manoeuvre_intensity(beta, criterion)), np.log(beta)


_TABLES = {criterion: _table(criterion) for criterion in CRITERIA}


def optimal_coefficients(
    intensity: npt.ArrayLike, criterion: str = "smoothed"
) -> tuple[FloatArray, FloatArray]:
    """Constant coefficients that minimise random plus dynamic error, interpolated for many tracks at once.

    Args:
        intensity: square of (acceleration times period squared over measurement error), any shape.
        criterion: "smoothed" or "predicted" coordinate.

    Returns:
        (alpha, beta), same shape.
    """
    beta = np.exp(np.interp(np.log(np.maximum(intensity, 1e-18)), *_TABLES[criterion]))
    return optimal_alpha(beta, criterion), np.asarray(beta)


def steady_second_increment_gains(intensity: npt.ArrayLike) -> tuple[FloatArray, FloatArray]:
    """Gains that the Kalman form of the filter tends to where the velocity changes at random from scan to scan.

    Source: (4.88), (4.89) with the covariance that the book does not write down; its steady state gives
    beta = alpha^2 / (2 - alpha) and beta^2 = (sigma_gamma / sigma_y)^2 (1 - alpha).

    Args:
        intensity: rms second increment over the error of a plot, any shape.

    Returns:
        (alpha, beta), same shape.
    """
    ratio = np.asarray(intensity, dtype=float)
    # With r^2 = 1 - alpha both equations become one for r + 1/r.
    double = (ratio + np.sqrt(ratio**2 + 16.0)) / 2.0
    root = 2.0 / (double + np.sqrt(np.maximum(double**2 - 4.0, 0.0)))
    alpha = 1.0 - root**2
    return np.asarray(alpha), np.asarray(alpha**2 / (2.0 - alpha))


def steady_coefficients(intensity: npt.ArrayLike, rule: str) -> tuple[FloatArray, FloatArray]:
    """Constant coefficients by one of the rules.

    Args:
        intensity: square of (acceleration times period squared over measurement error), any shape.
        rule: one of GAIN_RULES.

    Returns:
        (alpha, beta), same shape.
    """
    if rule in CRITERIA:
        return optimal_coefficients(intensity, rule)
    return steady_second_increment_gains(np.sqrt(intensity))
