# SPDX-License-Identifier: Apache-2.0
"""When the beam will pass a track next, and from when on a missing plot is a miss.

The time runs from the last passage of the same track, never from north, and moves with the target's own azimuth; so
neither the wrap of the azimuth nor a fast crossing target is counted twice.
"""

from __future__ import annotations

import numpy as np

from radar_common.frames import TWO_PI
from secondary_proc.motion import FloatArray, predict_position_variance

_LEAST_MARGIN = 0.03
_MOST_MARGIN = 0.25


def passage(
    state: FloatArray,
    covariance: FloatArray,
    time: FloatArray,
    crossing: FloatArray,
    *,
    period: float,
    sense: float,
    sigmas: float,
    noise_density: float,
) -> tuple[FloatArray, FloatArray]:
    """Predict the next passage of the beam.

    Args:
        state: (x, y, vx, vy), shape (n, 4).
        covariance: of the state, shape (n, 4, 4).
        time: of the state, seconds, shape (n,).
        crossing: last passage, with a plot or without, seconds, shape (n,).
        period: of the antenna, seconds.
        sense: +1 for clockwise rotation, -1 for the other, 0 if unknown.
        sigmas: half axis of the gate in standard deviations.
        noise_density: power spectral density of the acceleration that the gate stays open for, m^2/s^3.

    Returns:
        (next, margin): seconds, shape (n,); the target may be found up to `margin` before and after `next`.
    """
    velocity = state[:, 2:]
    last = state[:, :2] + velocity * (crossing - time)[:, None]
    later = last + velocity * period
    (x, y), (later_x, later_y) = last.T, later.T
    # The angle between both directions, clockwise: never off by a turn, as a difference of azimuths would be.
    turn = np.arctan2(later_x * y - later_y * x, later_x * x + later_y * y)
    following = crossing + (period + turn * (period * sense / TWO_PI))
    spread = predict_position_variance(covariance, following - time, noise_density)
    width = np.sqrt(spread) / np.maximum(np.hypot(later_x, later_y), 1.0)
    width *= sigmas / TWO_PI
    width += _LEAST_MARGIN
    return following, period * np.minimum(width, _MOST_MARGIN)
