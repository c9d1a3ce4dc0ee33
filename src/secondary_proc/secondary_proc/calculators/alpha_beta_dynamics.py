# SPDX-License-Identifier: Apache-2.0
"""The alpha-beta filter with constant gains: stability, transients, random and dynamic errors.

Source: Kuzmin 1967, § 4.5.4, (4.92)-(4.106). Velocity is per scan; variances are over that of a plot.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from scipy.signal import lfilter

from secondary_proc.calculators.rule_chain import FloatArray

OUTPUTS = ("smoothed", "velocity", "predicted", "residual")


def transfer(output: str, alpha: float, beta: float) -> tuple[FloatArray, FloatArray]:
    """Transfer function from the plot.

    Source: (4.94)-(4.97).

    Args:
        output: "smoothed" coordinate, "velocity", "predicted" coordinate, or "residual", the plot less its prediction.
        alpha: gain of the coordinate.
        beta: gain of the velocity.

    Returns:
        (numerator, denominator), coefficients of the powers 0, 1, 2 of Z^-1, as scipy.signal.lfilter takes them.

    Raises:
        ValueError: there is no such output.
    """
    denominator = np.array([1.0, alpha + beta - 2.0, 1.0 - alpha])
    numerators = {
        "smoothed": (alpha, beta - alpha, 0.0),
        "velocity": (beta, -beta, 0.0),
        "predicted": (0.0, alpha + beta, -alpha),
        "residual": (1.0, -2.0, 1.0),
    }
    if output not in numerators:
        raise ValueError(f"no output {output!r}; there are {', '.join(OUTPUTS)}")
    return np.array(numerators[output]), denominator


def is_stable(alpha: npt.ArrayLike, beta: npt.ArrayLike) -> npt.NDArray[np.bool_]:
    """Whether errors die out: the inside of the stability triangle.

    On its base beta = 0, which the book counts in, the velocity is never corrected.

    Args:
        alpha: gain of the coordinate, any shape.
        beta: gain of the velocity, any shape that fits.

    Returns:
        Verdict, in the common shape.
    """
    a, b = np.asarray(alpha, dtype=float), np.asarray(beta, dtype=float)
    return np.asarray((a > 0.0) & (b > 0.0) & (2.0 * a + b < 4.0))


def aperiodic_alpha(beta: npt.ArrayLike) -> FloatArray:
    """Least gain of the coordinate with which a transient does not oscillate: critical damping.

    Args:
        beta: gain of the velocity in [0, 1], any shape.

    Returns:
        alpha = 2 sqrt(beta) - beta, same shape.
    """
    b = np.asarray(beta, dtype=float)
    return np.asarray(2.0 * np.sqrt(b) - b)


def speed_jump_errors(alpha: float, beta: float, scans: int) -> FloatArray:
    """Errors of the prediction in the scans after the target's speed has jumped.

    A gate must be wider than the jump times the largest of them.

    Args:
        alpha: gain of the coordinate.
        beta: gain of the velocity.
        scans: number of scans.

    Returns:
        Errors over the jump in the way of a scan, shape (scans,).
    """
    numerator, denominator = transfer("residual", alpha, beta)
    return np.asarray(lfilter(numerator, denominator, np.arange(1.0, scans + 1)))


def speed_jump_square(alpha: npt.ArrayLike, beta: npt.ArrayLike) -> FloatArray:
    """Sum of the squares of `speed_jump_errors` over all scans.

    Args:
        alpha: gain of the coordinate, any shape.
        beta: gain of the velocity, any shape that fits.

    Returns:
        Sum, in the common shape.
    """
    a, b = np.asarray(alpha, dtype=float), np.asarray(beta, dtype=float)
    return np.asarray((2.0 - a) / (a * b * (4.0 - 2.0 * a - b)))


def random_variance(output: str, alpha: npt.ArrayLike, beta: npt.ArrayLike) -> FloatArray:
    """Steady variance that independent errors of the plots cause.

    Source: (4.102), (4.104), (4.103); that of the residual is one more than the prediction's.

    Args:
        output: as for `transfer`.
        alpha: gain of the coordinate inside the stability triangle, any shape.
        beta: gain of the velocity, any shape that fits.

    Returns:
        Variance, in the common shape.

    Raises:
        ValueError: there is no such output.
    """
    a, b = np.asarray(alpha, dtype=float), np.asarray(beta, dtype=float)
    numerators = {
        "smoothed": 2.0 * a**2 - 3.0 * a * b + 2.0 * b,
        "velocity": 2.0 * b**2,
        "predicted": 2.0 * a**2 + a * b + 2.0 * b,
        "residual": 4.0 * a + 2.0 * b,
    }
    if output not in numerators:
        raise ValueError(f"no output {output!r}; there are {', '.join(OUTPUTS)}")
    return np.asarray(numerators[output] / (a * (4.0 - 2.0 * a - b)))


def dynamic_error(output: str, alpha: npt.ArrayLike, beta: npt.ArrayLike) -> FloatArray:
    """Steady lag behind a target of constant acceleration, true value less the filter's.

    Source: (4.105), (4.106).

    Args:
        output: "smoothed" or "predicted".
        alpha: gain of the coordinate, any shape.
        beta: gain of the velocity, any shape that fits.

    Returns:
        Lag over the acceleration per scan squared, in the common shape.

    Raises:
        ValueError: it is neither.
    """
    a, b = np.asarray(alpha, dtype=float), np.asarray(beta, dtype=float)
    if output == "smoothed":
        return np.asarray((1.0 - a) / b)
    if output == "predicted":
        return np.asarray(np.ones(np.shape(a)) / b)
    raise ValueError(f"no dynamic error of {output!r}; there is that of smoothed and predicted")
