# SPDX-License-Identifier: Apache-2.0
"""The estimate of least mean square error (Kuzmin 1967, § 1.4.2)."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]


def posterior_mean(
    values: npt.ArrayLike, log_likelihood: npt.ArrayLike, prior: npt.ArrayLike | None = None
) -> tuple[FloatArray, FloatArray]:
    """Mean of a parameter over its posterior on a grid, best under the quadratic loss (1.55).

    Source: Kuzmin 1967, (1.63)-(1.64). Of a symmetric posterior with one maximum it is the maximum.

    Args:
        values: the parameter on an even grid, shape (points,).
        log_likelihood: ln w(U | theta) up to a constant, shape (..., points).
        prior: w(theta) up to a factor, shape (points,); None for a flat one.

    Returns:
        (mean, standard deviation) of the posterior, each of shape (...).
    """
    theta, log = np.asarray(values, dtype=float), np.asarray(log_likelihood, dtype=float)
    weight = np.exp(log - log.max(axis=-1, keepdims=True))
    if prior is not None:
        weight = weight * np.asarray(prior, dtype=float)
    weight = weight / weight.sum(axis=-1, keepdims=True)
    mean = weight @ theta
    variance = (weight * (theta - mean[..., None]) ** 2).sum(axis=-1)
    return np.asarray(mean), np.sqrt(variance)
