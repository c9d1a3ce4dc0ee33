# SPDX-License-Identifier: Apache-2.0
"""Extended Kalman filter: the azimuth made linear at the predicted position."""

from __future__ import annotations

import numpy as np

from bearing_tracker.emitters.corrections.interface import (
    Corrected,
    FloatArray,
    Look,
    correct_linear,
)
from bearing_tracker.emitters.sight import sight
from radar_common.frames import wrap_pi


def extended(mean: FloatArray, covariance: FloatArray, look: Look) -> Corrected:
    """Correct in Cartesian coordinates.

    Args:
        mean: of (x, y, vx, vy[, g]), shape (n, B, M, D).
        covariance: of it, shape (n, B, M, D, D).
        look: the bearings.

    Returns:
        The corrected densities.
    """
    seen = sight(mean[..., :2] - look.observer)
    gradient = np.zeros_like(mean)
    gradient[..., :2] = seen.gradient
    gradient[..., 4:] = 1.0
    innovation = wrap_pi(look.azimuth - seen.azimuth - mean[..., 4:].sum(axis=-1))
    return correct_linear(mean, covariance, gradient, innovation, look.variance)
