# SPDX-License-Identifier: Apache-2.0
"""Extended Kalman filter in modified polar coordinates: azimuth, its rate, range rate over range, and 1 / range.

There the bearing is linear and the first three components do not depend on the range, which alone is unobservable until
the observer manoeuvres. Only the correction is made in these coordinates: motion is linear in the Cartesian ones, and
to convert mean and covariance forth and back at the same points is the same as to linearise the polar motion.
Source: Aidala and Hammel 1983.
"""

from __future__ import annotations

import numpy as np

from bearing_tracker.emitters.corrections.interface import (
    FARTHER,
    NEARER,
    Corrected,
    FloatArray,
    Look,
    correct_linear,
)
from bearing_tracker.emitters.sight import sight
from radar_common.frames import wrap_pi


def modified_polar(mean: FloatArray, covariance: FloatArray, look: Look) -> Corrected:
    """Correct in modified polar coordinates.

    Args:
        mean: of (x, y, vx, vy[, g]), shape (n, B, M, D).
        covariance: of it, shape (n, B, M, D, D).
        look: the bearings; 1 / range is held within reach, since a negative one is an emitter behind the observer.

    Returns:
        The corrected densities, in Cartesian coordinates.
    """
    polar = _polar(mean, look)
    to_polar = np.linalg.inv(_jacobian(polar))
    gradient = np.zeros_like(mean)
    gradient[..., 0] = 1.0
    gradient[..., 4:] = 1.0
    innovation = wrap_pi(look.azimuth - polar[..., 0] - polar[..., 4:].sum(axis=-1))
    corrected = correct_linear(
        polar,
        to_polar @ covariance @ np.swapaxes(to_polar, -1, -2),
        gradient,
        innovation,
        look.variance,
    )
    np.clip(
        corrected.mean[..., 3],
        1.0 / (FARTHER * look.range_high),
        NEARER / look.range_low,
        out=corrected.mean[..., 3],
    )
    back = _jacobian(corrected.mean)
    return corrected._replace(
        mean=_cartesian(corrected.mean, look),
        covariance=back @ corrected.covariance @ np.swapaxes(back, -1, -2),
    )


def _polar(mean: FloatArray, look: Look) -> FloatArray:
    seen = sight(mean[..., :2] - look.observer)
    velocity = (mean[..., 2:4] - look.observer_velocity) / seen.range[..., np.newaxis]
    polar = mean.copy()
    polar[..., 0] = seen.azimuth
    polar[..., 1] = (velocity * seen.across).sum(axis=-1)
    polar[..., 2] = (velocity * seen.along).sum(axis=-1)
    polar[..., 3] = 1.0 / seen.range
    return polar


def _cartesian(polar: FloatArray, look: Look) -> FloatArray:
    along, across = _axes(polar)
    distance = 1.0 / polar[..., 3:4]
    mean = polar.copy()
    mean[..., :2] = look.observer + distance * along
    mean[..., 2:4] = look.observer_velocity + distance * (
        polar[..., 2:3] * along + polar[..., 1:2] * across
    )
    return mean


def _jacobian(polar: FloatArray) -> FloatArray:
    """Of the Cartesian coordinates by the polar ones, shape (..., D, D)."""
    along, across = _axes(polar)
    distance, rate, closing = 1.0 / polar[..., 3:4], polar[..., 1:2], polar[..., 2:3]
    matrix = np.zeros((*polar.shape, polar.shape[-1]))
    matrix[..., :2, 0] = distance * across
    matrix[..., :2, 3] = -(distance**2) * along
    matrix[..., 2:4, 0] = distance * (closing * across - rate * along)
    matrix[..., 2:4, 1] = distance * across
    matrix[..., 2:4, 2] = distance * along
    matrix[..., 2:4, 3] = -(distance**2) * (closing * along + rate * across)
    matrix[..., 4:, 4:] = 1.0
    return matrix


def _axes(polar: FloatArray) -> tuple[FloatArray, FloatArray]:
    sine, cosine = np.sin(polar[..., 0]), np.cos(polar[..., 0])
    return np.stack([sine, cosine], axis=-1), np.stack([cosine, -sine], axis=-1)
