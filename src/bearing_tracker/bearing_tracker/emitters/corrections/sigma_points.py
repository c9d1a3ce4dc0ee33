# SPDX-License-Identifier: Apache-2.0
"""Unscented and cubature Kalman filters: the azimuth averaged over points that stand for the density.

Sources: Julier and Uhlmann 1997, Wan and van der Merwe 2000 (unscented); Arasaratnam and Haykin 2009 (cubature).
"""

from __future__ import annotations

import numpy as np

from bearing_tracker.emitters.corrections.interface import (
    Corrected,
    FloatArray,
    Look,
    log_density,
)
from bearing_tracker.emitters.sight import sight
from radar_common.frames import wrap_pi

_LAMBDA, _BETA = 1.0, 2.0


def unscented(mean: FloatArray, covariance: FloatArray, look: Look) -> Corrected:
    """Correct by the unscented transform with alpha = 1, beta = 2, lambda = 1.

    Args:
        mean: of (x, y, vx, vy[, g]), shape (n, B, M, D).
        covariance: of it, shape (n, B, M, D, D).
        look: the bearings.

    Returns:
        The corrected densities.
    """
    total = mean.shape[-1] + _LAMBDA
    return _correct(mean, covariance, look, total, _LAMBDA / total, _LAMBDA / total + _BETA)


def cubature(mean: FloatArray, covariance: FloatArray, look: Look) -> Corrected:
    """Correct by the third-degree cubature rule: 2 D points of equal weight.

    Args:
        mean: of (x, y, vx, vy[, g]), shape (n, B, M, D).
        covariance: of it, shape (n, B, M, D, D).
        look: the bearings.

    Returns:
        The corrected densities.
    """
    return _correct(mean, covariance, look, float(mean.shape[-1]), 0.0, 0.0)


def triangular_root(covariance: FloatArray) -> FloatArray:
    """Cholesky factors of many small matrices, without failing where rounding took a matrix's definiteness.

    Args:
        covariance: symmetric, shape (..., D, D).

    Returns:
        Lower triangular L with L L' = covariance, shape (..., D, D); a pivot that is not positive counts as next to
        nothing of its variance.
    """
    root = np.zeros_like(covariance)
    for column in range(covariance.shape[-1]):
        done = root[..., column:, :column]
        rest = covariance[..., column:, column] - (done @ done[..., :1, :].swapaxes(-1, -2))[..., 0]
        least = np.finfo(float).eps * covariance[..., column, column]
        pivot = np.sqrt(np.maximum(rest[..., 0], least))
        root[..., column:, column] = rest / pivot[..., np.newaxis]
        root[..., column, column] = pivot
    return root


def _correct(
    mean: FloatArray,
    covariance: FloatArray,
    look: Look,
    scale: float,
    centre_weight: float,
    centre_covariance_weight: float,
) -> Corrected:
    columns = np.sqrt(scale) * np.swapaxes(triangular_root(covariance), -1, -2)
    offsets = np.concatenate([np.zeros_like(columns[..., :1, :]), columns, -columns], axis=-2)
    weights = np.full(offsets.shape[-2], 0.5 / scale)
    covariance_weights = weights.copy()
    weights[0], covariance_weights[0] = centre_weight, centre_covariance_weight

    points = mean[..., np.newaxis, :] + offsets
    azimuths = sight(points[..., :2] - look.observer[..., np.newaxis, :]).azimuth
    # Differences from one reference, so that points on both sides of north average rightly.
    reference = azimuths[..., :1]
    angles = wrap_pi(azimuths - reference) + points[..., 4:].sum(axis=-1)
    expected = angles @ weights
    spread = (angles - expected[..., np.newaxis]) * covariance_weights
    variance = (spread * (angles - expected[..., np.newaxis])).sum(axis=-1) + look.variance
    cross = (np.swapaxes(offsets, -1, -2) @ spread[..., np.newaxis])[..., 0]
    innovation = wrap_pi(look.azimuth - reference[..., 0] - expected)
    gain = cross / variance[..., np.newaxis]
    return Corrected(
        mean + gain * innovation[..., np.newaxis],
        covariance - gain[..., :, np.newaxis] * cross[..., np.newaxis, :],
        log_density(innovation, variance),
    )
