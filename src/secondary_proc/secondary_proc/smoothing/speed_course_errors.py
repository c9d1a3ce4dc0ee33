# SPDX-License-Identifier: Apache-2.0
"""Errors of smoothed speed and course, with the correlation that successive values have because they share a plot.

The recursion is linear in the errors of position, velocity and last plot, once the weights along the course and across
it are given; so the covariance of all three is carried on exactly, where (4.124) and (4.135) of Kuzmin 1967 are its
steady state for equal intervals.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from secondary_proc.motion import FloatArray, unit_noise
from secondary_proc.smoothing.interface import Measured

_EYE = np.eye(2)


def propagate(
    measured: Measured,
    memory: npt.NDArray[Any],
    keep: FloatArray,
    course: FloatArray,
    feedback: float,
    noise_density: float,
) -> tuple[FloatArray, FloatArray]:
    """Carry the covariance over one plot.

    With the weights Z of the old velocity, the share f of the residual, the time T, the plots' errors e and the
    target's own deviations w from uniform motion, the errors are
    dv = Z dv' + (1 - Z) (w_p + e - e') / T - w_v and dp = (1 - f) (dp' + T dv + T w_v - w_p) + f e.

    Args:
        measured: tracks and plots.
        memory: structured, with the last plot's `position_covariance` and what it has in common with the state,
            `shared`, shape (n,).
        keep: weights of the old speed and of the old course, shape (n, 2).
        course: smoothed, rad, shape (n,).
        feedback: share of the position's residual that is added to the position.
        noise_density: power spectral density of the target's acceleration per axis, m^2/s^3.

    Returns:
        (covariance of the state, covariance of the state's errors with the new plot's), shapes (n, 4, 4), (n, 4, 2).
    """
    count = len(course)
    seconds = measured.seconds[:, None, None]
    ahead = np.stack([np.sin(course), np.cos(course)], axis=1)
    along = ahead[:, :, None] * ahead[:, None, :]
    old = keep[:, 0, None, None] * along + keep[:, 1, None, None] * (_EYE - along)
    fresh = (_EYE - old) / seconds
    moved, back = (1.0 - feedback) * seconds, 1.0 - feedback
    # Columns: position, velocity and last plot before; the target's deviations in both; the new plot.
    gain = np.zeros((count, 4, 12))
    gain[:, 2:, 2:4] = old
    gain[:, 2:, 4:6] = -fresh
    gain[:, 2:, 6:8] = fresh
    gain[:, 2:, 8:10] = -_EYE
    gain[:, 2:, 10:] = fresh
    gain[:, :2] = moved * gain[:, 2:]
    gain[:, :2, :2] += back * _EYE
    gain[:, :2, 6:8] -= back * _EYE
    gain[:, :2, 8:10] += moved * _EYE
    gain[:, :2, 10:] += feedback * _EYE
    errors = np.zeros((count, 12, 12))
    errors[:, :4, :4] = measured.covariance
    errors[:, :4, 4:6] = memory["shared"]
    errors[:, 4:6, :4] = memory["shared"].transpose(0, 2, 1)
    errors[:, 4:6, 4:6] = memory["position_covariance"]
    errors[:, 6:10, 6:10] = noise_density * unit_noise(measured.seconds)
    errors[:, 10:, 10:] = measured.position_covariance
    covariance = gain @ errors @ gain.transpose(0, 2, 1)
    covariance = 0.5 * (covariance + covariance.transpose(0, 2, 1))
    return covariance, gain[:, :, 10:] @ measured.position_covariance
