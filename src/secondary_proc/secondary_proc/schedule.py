# SPDX-License-Identifier: Apache-2.0
"""When the beam will pass a track next, and from when on a missing plot is a miss.

The time runs from the last passage of the same track, never from north, and moves with the target's own azimuth; so
neither the wrap of the azimuth nor a fast crossing target is counted twice.
"""

from __future__ import annotations

import numpy as np

from radar_common.frames import TWO_PI, wrap_pi
from secondary_proc.motion import FloatArray, predict_position_covariance, trace

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
    last = state[:, :2] + state[:, 2:] * (crossing - time)[:, None]
    later = last + state[:, 2:] * period
    turn = wrap_pi(np.arctan2(later[:, 0], later[:, 1]) - np.arctan2(last[:, 0], last[:, 1]))
    following = crossing + period * (1.0 + sense * turn / TWO_PI)
    spread = trace(predict_position_covariance(covariance, following - time, noise_density))
    distance = np.maximum(np.hypot(later[:, 0], later[:, 1]), 1.0)
    width = sigmas * np.sqrt(spread) / distance / TWO_PI
    return following, period * np.minimum(_LEAST_MARGIN + width, _MOST_MARGIN)
