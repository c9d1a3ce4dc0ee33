# SPDX-License-Identifier: Apache-2.0
"""Maximum-likelihood polynomials through the last plots of many tracks at once, each plot with its time and error.

Source: Kuzmin 1967, § 4.4.1-4.4.2, (4.38)-(4.48), in two coordinates whose errors are correlated.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from secondary_proc.motion import FloatArray


@dataclass(frozen=True, slots=True)
class Fit:
    """Polynomials at the time of the last plot.

    Attributes:
        estimate: coordinates, velocities and, of a parabola, accelerations, shape (n, 2 degree + 2).
        covariance: of the estimate, shape (n, 2 degree + 2, 2 degree + 2).
    """

    estimate: FloatArray
    covariance: FloatArray


def fit(
    age: FloatArray,
    position: FloatArray,
    information: FloatArray,
    degree: int,
    noise_density: float,
) -> Fit:
    """Fit polynomials.

    The weights are those of independent plots; the covariance adds what white acceleration makes of the target's way.

    Args:
        age: of the plots, seconds before the last one, shape (n, k).
        position: of the plots, metres, shape (n, k, 2).
        information: inverse covariances of their errors, zero for a plot that there is not, shape (n, k, 2, 2); there
            are more than `degree` plots of different ages.
        degree: 1 for a line, the book's hypothesis 1; 2 for a parabola, its hypothesis 2.
        noise_density: power spectral density of the target's acceleration per axis, m^2/s^3.

    Returns:
        The polynomials.
    """
    tracks, plots = age.shape
    terms = degree + 1
    # In units of the oldest plot's age the powers of time stay near one, and the equations solvable.
    span = age.max(axis=1, where=information[:, :, 0, 0] > 0.0, initial=1e-9)
    powers = np.empty((tracks, plots, terms))
    powers[:, :, 0] = 1.0
    for power in range(1, terms):
        powers[:, :, power] = powers[:, :, power - 1] * (-age / span[:, None]) / power
    # Rows 2 p + i: derivative p of coordinate i.
    design = powers[:, :, :, None, None] * information[:, :, None]
    right = design.transpose(0, 2, 3, 1, 4).reshape(tracks, 2 * terms, 2 * plots)
    normal = (
        (right.reshape(tracks, 2 * terms, plots, 2).transpose(0, 1, 3, 2) @ powers[:, None])
        .transpose(0, 1, 3, 2)
        .reshape(tracks, 2 * terms, 2 * terms)
    )
    inverse = np.linalg.inv(normal)
    weights = inverse @ right
    unit = np.repeat(span[:, None] ** -np.arange(terms), 2, axis=1)
    weights *= unit[:, :, None]
    inverse *= unit[:, :, None] * unit[:, None, :]
    estimate = (weights @ position.reshape(tracks, 2 * plots, 1))[:, :, 0]
    covariance = inverse + _wandering(age, weights, noise_density)
    return Fit(estimate, 0.5 * (covariance + covariance.transpose(0, 2, 1)))


def _wandering(age: FloatArray, weights: FloatArray, noise_density: float) -> FloatArray:
    """What white acceleration since the plots adds to the estimate's covariance.

    A plot of age s lies off the last velocity's line by the integral of u a(t_n - s + u) over u from 0 to s, so two
    plots' deviations have the covariance q s^2 (3 s' - s) / 6 with the smaller age s and the larger s'.
    """
    younger = np.minimum(age[:, :, None], age[:, None, :])
    older = np.maximum(age[:, :, None], age[:, None, :])
    away = (noise_density / 6.0) * younger**2 * (3.0 * older - younger)
    split = weights.reshape(*weights.shape[:2], age.shape[1], 2)
    spread = np.zeros((len(age), weights.shape[1], weights.shape[1]))
    for axis in (0, 1):
        part = split[..., axis]
        spread += part @ away @ part.transpose(0, 2, 1)
    return spread
