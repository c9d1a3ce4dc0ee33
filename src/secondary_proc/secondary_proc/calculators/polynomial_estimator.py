# SPDX-License-Identifier: Apache-2.0
"""Maximum-likelihood estimate of a polynomial of any order in noise of any covariance.

Source: Kuzmin 1967, § 4.4.1-4.4.2, (4.38)-(4.48). Every estimate is a weighted sum of the plots, so the weights are
what is computed; they depend on times and covariance alone.
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt
from scipy.linalg import solve_triangular

from secondary_proc.calculators.rule_chain import FloatArray


def polynomial_weights(
    times: npt.ArrayLike,
    degree: int,
    at: npt.ArrayLike,
    *,
    derivative: int = 0,
    covariance: npt.ArrayLike | None = None,
) -> FloatArray:
    """Weights of the plots in the value of the polynomial, or of one of its derivatives, at any times.

    Source: (4.43), (4.44).

    Args:
        times: of the plots, seconds or scans, shape (n,), at least degree + 1 different ones.
        degree: s of (4.3); 1 is the book's hypothesis 1, 2 its hypothesis 2.
        at: times of the estimates, a number or shape (m,); later than the last plot for a prediction.
        derivative: 0 for the coordinate, 1 for its velocity, 2 for its acceleration.
        covariance: of the plots' errors, positive definite, shape (n, n); None for independent equal ones.

    Returns:
        Weights, shape (n,) or (m, n); the estimate is weights @ plots.

    Raises:
        ValueError: there are too few different times, or the covariance is not positive definite.
    """
    times = np.asarray(times, dtype=float)
    if degree < 0 or len(np.unique(times)) <= degree:
        raise ValueError(f"{len(np.unique(times))} times are too few for degree {degree}")
    # Powers of centred and scaled time keep the system well conditioned.
    centre = times.mean()
    scale = float(np.abs(times - centre).max()) or 1.0
    design = ((times - centre) / scale)[:, None] ** np.arange(degree + 1)
    place = (np.asarray(at, dtype=float) - centre) / scale
    wanted = np.zeros((*place.shape, degree + 1))
    for power in range(derivative, degree + 1):
        factor = math.perm(power, derivative) / scale**derivative
        wanted[..., power] = factor * place ** (power - derivative)
    if covariance is None:
        return np.asarray(wanted @ np.linalg.pinv(design))
    root = _root(np.asarray(covariance, dtype=float))
    whitened = np.linalg.pinv(solve_triangular(root, design, lower=True))
    return np.asarray(solve_triangular(root.T, (wanted @ whitened).T, lower=False).T)


def estimate_variance(weights: FloatArray, covariance: npt.ArrayLike | None = None) -> FloatArray:
    """Error variance of a weighted sum of plots.

    Source: (4.62).

    Args:
        weights: shape (..., n).
        covariance: of the plots' errors, shape (n, n); None for independent ones of variance one.

    Returns:
        Variance, shape (...).
    """
    spread = weights if covariance is None else weights @ np.asarray(covariance, dtype=float)
    return np.asarray((spread * weights).sum(axis=-1))


def _root(covariance: FloatArray) -> FloatArray:
    try:
        return np.asarray(np.linalg.cholesky(covariance))
    except np.linalg.LinAlgError:
        raise ValueError("the covariance is not positive definite") from None
