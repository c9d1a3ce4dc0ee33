# SPDX-License-Identifier: Apache-2.0
"""What a bank of filters asks of the correction of one Gaussian density by one bearing."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]

NEARER, FARTHER = 3.0, 2.0
"""No density is kept that is nearer than the prior's range_low over the one, or beyond range_high times the other."""


class Look(NamedTuple):
    """Bearings, broadcast over the components of the bank.

    Attributes:
        azimuth: radians clockwise from north, shape (n, 1, 1).
        variance: of its white error, square radians, shape (n, 1, 1).
        observer: metres east and north, shape (n, 1, 1, 2).
        observer_velocity: m/s, shape (n, 1, 1, 2).
        range_low: smallest distance that the prior allows, metres, shape (n, 1, 1).
        range_high: largest, metres, shape (n, 1, 1).
    """

    azimuth: FloatArray
    variance: FloatArray
    observer: FloatArray
    observer_velocity: FloatArray
    range_low: FloatArray
    range_high: FloatArray


class Corrected(NamedTuple):
    """Densities after their bearings.

    Attributes:
        mean: shape (n, B, M, D).
        covariance: shape (n, B, M, D, D), symmetric and positive definite.
        log_likelihood: of the bearing, its density in 1/rad, shape (n, B, M).
    """

    mean: FloatArray
    covariance: FloatArray
    log_likelihood: FloatArray


Correction = Callable[[FloatArray, FloatArray, Look], Corrected]
"""Takes mean, covariance and look."""


def correct_linear(
    mean: FloatArray,
    covariance: FloatArray,
    gradient: FloatArray,
    innovation: FloatArray,
    variance: FloatArray,
) -> Corrected:
    """Correct by one linear measurement z = h x + error, its covariance in the form of Joseph.

    P' = (I - k h) P (I - k h)' + k R k', which stays symmetric and positive definite.
    Source: Bucy and Joseph 1968, ch. 16.

    Args:
        mean: shape (..., D).
        covariance: shape (..., D, D).
        gradient: h, shape (..., D).
        innovation: z less its expectation, shape (...).
        variance: R, shape (...).

    Returns:
        The corrected density; the likelihood is a density of z.
    """
    projected = np.einsum("...ij,...j->...i", covariance, gradient)
    innovation_variance = (gradient * projected).sum(axis=-1) + variance
    gain = projected / innovation_variance[..., np.newaxis]
    kept = covariance - gain[..., :, np.newaxis] * projected[..., np.newaxis, :]
    remaining = np.einsum("...ij,...j->...i", kept, gradient)
    # The last two terms of Joseph's form, (P - k h P)(I - k h)' + k R k', share the right factor k'.
    right = variance[..., np.newaxis] * gain - remaining
    updated = kept + right[..., :, np.newaxis] * gain[..., np.newaxis, :]
    return Corrected(
        mean + gain * innovation[..., np.newaxis],
        0.5 * (updated + np.swapaxes(updated, -1, -2)),
        log_density(innovation, innovation_variance),
    )


def log_density(innovation: FloatArray, variance: FloatArray) -> FloatArray:
    """Logarithm of the Gaussian density.

    Args:
        innovation: difference from the mean, any shape.
        variance: positive, same shape.

    Returns:
        Same shape.
    """
    return -0.5 * (innovation**2 / variance + np.log(2.0 * np.pi * variance))
