# SPDX-License-Identifier: Apache-2.0
"""How an emitter and the lasting part of a bearing's error move on (Khmarskiy and Sushchinskiy 2015).

The paper's state is [x, Vx, z, Vz] with x north and z east; here it is (x, y, vx, vy) with x east and y north, which is
its z, x, Vz, Vx. Both axes move alike, so nothing else changes. Its S is printed 2 x 4; S mu and M = S S' sigma^2 need
the 4 x 2 that is used here: one acceleration an axis, constant over the step.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from bearing_tracker.emitters.interface import CorrelatedError

FloatArray = npt.NDArray[np.float64]

_LARGEST_INFLATION = 1e6


def propagate(
    mean: FloatArray, covariance: FloatArray, seconds: FloatArray, acceleration_std: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Move position and velocity on: alpha' = b alpha + S mu, P' = b P b' + S S' sigma_M^2.

    Args:
        mean: (x, y, vx, vy, ...), metres and m/s, shape (..., D).
        covariance: of it, shape (..., D, D).
        seconds: of each, broadcast over the leading axes.
        acceleration_std: sigma_M of each, m/s^2, broadcast over the leading axes.

    Returns:
        Mean and covariance at the later time; components beyond the fourth are left as they are.
    """
    moved, spread = mean.copy(), covariance.copy()
    step = seconds[..., np.newaxis]
    moved[..., :2] += step * mean[..., 2:4]
    spread[..., :2, :] += step[..., np.newaxis] * spread[..., 2:4, :]
    spread[..., :, :2] += step[..., np.newaxis] * spread[..., :, 2:4]
    by_position, by_velocity = 0.5 * seconds**2 * acceleration_std, seconds * acceleration_std
    for axis in (0, 1):
        spread[..., axis, axis] += by_position**2
        spread[..., axis, axis + 2] += by_position * by_velocity
        spread[..., axis + 2, axis] += by_position * by_velocity
        spread[..., axis + 2, axis + 2] += by_velocity**2
    return moved, spread


def wander(
    mean: FloatArray, covariance: FloatArray, seconds: FloatArray, error: CorrelatedError
) -> None:
    """Let the lasting error, the fifth component, fade and be renewed: g' = rho g + sigma_g sqrt(1 - rho^2) w.

    Args:
        mean: of which component 4 is changed, shape (..., 5).
        covariance: of which row and column 4 are changed, shape (..., 5, 5).
        seconds: of each, broadcast over the leading axes.
        error: its deviation and its time.
    """
    kept = np.exp(-seconds / error.time)
    mean[..., 4] *= kept
    covariance[..., 4, :] *= kept[..., np.newaxis]
    covariance[..., :, 4] *= kept[..., np.newaxis]
    covariance[..., 4, 4] += error.std**2 * (1.0 - kept**2)


def white_variance(std: FloatArray, error: CorrelatedError) -> FloatArray:
    """Variance of what is left of the bearing error beside the lasting part.

    Args:
        std: of the whole error, radians, any shape.
        error: the lasting part.

    Returns:
        Square radians; a hundredth of the whole at least, for a deviation that is stated too small.
    """
    return np.maximum(std**2 - error.std**2, 0.01 * std**2)


def inflated_variance(std: FloatArray, interval: FloatArray, error: CorrelatedError) -> FloatArray:
    """Variance of white errors that leave as much in a long run's mean as the correlated ones do.

    sigma_w^2 + sigma_g^2 (1 + rho) / (1 - rho), with rho = exp(-interval / time).

    Args:
        std: of the whole error, radians, shape (n,).
        interval: between the bearings, seconds, shape (n,).
        error: the lasting part.

    Returns:
        Square radians, shape (n,).
    """
    if error.std == 0.0:
        return std**2
    kept = np.exp(-interval / error.time)
    lasting = (1.0 + kept) / np.maximum(1.0 - kept, 1.0 / _LARGEST_INFLATION)
    return white_variance(std, error) + error.std**2 * lasting
