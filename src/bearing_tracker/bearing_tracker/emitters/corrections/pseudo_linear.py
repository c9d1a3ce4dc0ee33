# SPDX-License-Identifier: Apache-2.0
"""Pseudo-linear filter: the measured direction taken for a line through the emitter, with an error in metres.

For comparison only: the measured azimuth is in the coefficients too, and that pulls the estimate towards the observer.
Source: Lindgren and Gong 1978; Aidala and Nardone 1982.
"""

from __future__ import annotations

import numpy as np

from bearing_tracker.emitters.corrections.interface import (
    Corrected,
    FloatArray,
    Look,
    correct_linear,
)
from bearing_tracker.emitters.sight import sight


def pseudo_linear(mean: FloatArray, covariance: FloatArray, look: Look) -> Corrected:
    """Correct by (x - x_p) cos beta - (y - y_p) sin beta = -r (g + w).

    Args:
        mean: of (x, y, vx, vy[, g]), shape (n, B, M, D).
        covariance: of it, shape (n, B, M, D, D).
        look: the bearings.

    Returns:
        The corrected densities.
    """
    relative = mean[..., :2] - look.observer
    distance = sight(relative).range
    gradient = np.zeros_like(mean)
    gradient[..., 0] = np.cos(look.azimuth)
    gradient[..., 1] = -np.sin(look.azimuth)
    gradient[..., 4:] = distance[..., np.newaxis]
    innovation = -(gradient[..., :2] * relative).sum(axis=-1) - (gradient * mean)[..., 4:].sum(
        axis=-1
    )
    corrected = correct_linear(mean, covariance, gradient, innovation, distance**2 * look.variance)
    # A density by metres across the line of sight becomes one by radians.
    return corrected._replace(log_likelihood=corrected.log_likelihood + np.log(distance))
