# SPDX-License-Identifier: Apache-2.0
"""Gates: probability of a hit from the size, size from the probability, growth by manoeuvres and misses.

Source: Kuzmin 1967, § 4.7.2, (4.137)-(4.139). Sizes are half sizes over the error of a plot.
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt
from scipy.special import erf, erfinv

from secondary_proc.calculators.line_estimator import line_position_variance
from secondary_proc.calculators.rule_chain import FloatArray

SHAPES = ("coordinate", "rectangle", "ellipse")


def hit_probability(sigmas: npt.ArrayLike, shape: str = "ellipse") -> FloatArray:
    """Probability that the plot of a target lies in its gate.

    Args:
        sigmas: half size in standard deviations of the predicted difference, any shape.
        shape: "coordinate" for a gate in one of them, "rectangle" for both each with its own (4.137), "ellipse" for the
            normalised distance of both (4.144).

    Returns:
        Probability, same shape.

    Raises:
        ValueError: there is no such shape.
    """
    k = np.asarray(sigmas, dtype=float)
    _check(shape)
    if shape == "ellipse":
        return np.asarray(-np.expm1(-(k**2) / 2.0))
    return np.asarray(erf(k / np.sqrt(2.0)) ** (2 if shape == "rectangle" else 1))


def sigmas_for_hits(probability: npt.ArrayLike, shape: str = "ellipse") -> FloatArray:
    """Gate for a wanted probability, the inverse of `hit_probability`.

    Args:
        probability: in [0, 1), any shape.
        shape: as there.

    Returns:
        Half size in standard deviations, same shape.

    Raises:
        ValueError: there is no such shape.
    """
    p = np.asarray(probability, dtype=float)
    _check(shape)
    if shape == "ellipse":
        return np.asarray(np.sqrt(-2.0 * np.log1p(-p)))
    return np.asarray(np.sqrt(2.0) * erfinv(np.sqrt(p) if shape == "rectangle" else p))


def line_gate(plots: npt.ArrayLike, misses: npt.ArrayLike = 0, sigmas: float = 3.0) -> FloatArray:
    """Half size for a track that is the straight line through its last plots.

    Source: (4.138), (4.139); (4.66) after misses.

    Args:
        plots: n, at least 2, any shape.
        misses: scans in a row without a plot, any shape that fits.
        sigmas: k.

    Returns:
        Half size over the error of a plot, in the common shape.
    """
    ahead = np.asarray(misses) + 1
    return np.asarray(sigmas * np.sqrt(1.0 + line_position_variance(plots, ahead)))


def alpha_beta_gate(
    alpha: float, beta: float, *, intensity: float = 0.0, misses: int = 0, sigmas: float = 3.0
) -> float:
    """Half size for an alpha-beta filter in its steady state.

    The random part grows with the covariance of coordinate and velocity, the lag behind a target that accelerates is
    added in full: with (4.103) and (4.106) for no misses.

    Args:
        alpha: gain of the coordinate.
        beta: gain of the velocity.
        intensity: acceleration times T_0^2 over the error of a plot, that the gate must hold.
        misses: scans in a row without a plot.
        sigmas: k.

    Returns:
        Half size over the error of a plot.
    """
    p = misses + 1
    scale = 1.0 / (alpha * (4.0 - 2.0 * alpha - beta))
    coordinate = scale * (2.0 * alpha**2 - 3.0 * alpha * beta + 2.0 * beta)
    common = scale * beta * (2.0 * alpha - beta)
    velocity = scale * 2.0 * beta**2
    random = 1.0 + coordinate + 2.0 * p * common + p**2 * velocity
    lag = (1.0 - alpha) / beta + p * (alpha / beta - 0.5) + p**2 / 2.0
    return sigmas * math.sqrt(random) + intensity * lag


def three_gates(
    alpha: float, beta: float, *, intensity: float, misses: int, sigmas: float = 3.0
) -> tuple[float, float, float]:
    """The book's least number of gate sizes.

    Args:
        alpha: gain of the coordinate.
        beta: gain of the velocity.
        intensity: strongest acceleration times T_0^2 over the error of a plot.
        misses: scans in a row without a plot that the widest gate is for.
        sigmas: k.

    Returns:
        (narrow for straight flight, medium for manoeuvres, wide for manoeuvres after misses), over the error of a plot.
    """
    return (
        alpha_beta_gate(alpha, beta, sigmas=sigmas),
        alpha_beta_gate(alpha, beta, intensity=intensity, sigmas=sigmas),
        alpha_beta_gate(alpha, beta, intensity=intensity, misses=misses, sigmas=sigmas),
    )


def _check(shape: str) -> None:
    if shape not in SHAPES:
        raise ValueError(f"no gate {shape!r}; there are {', '.join(SHAPES)}")
