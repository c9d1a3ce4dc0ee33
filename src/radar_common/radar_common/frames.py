# SPDX-License-Identifier: Apache-2.0
"""All conversions between angles and frames.

Azimuth and course run clockwise from north in [0, 2 pi); yaw (REP-103) runs counter-clockwise from east. Positions
are ENU metres (REP-105 `map`). Slant range and height give ground range; a surveillance radar without elevation
leaves z at zero, so that slant range is taken for ground range.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]

TWO_PI = 2.0 * np.pi


def wrap_two_pi(angle: npt.ArrayLike) -> FloatArray:
    """Wrap angles to [0, 2 pi).

    Args:
        angle: radians, any shape.

    Returns:
        Radians, same shape; never 2 pi itself, which a plain modulo can round to.
    """
    wrapped = np.mod(angle, TWO_PI)
    return np.where(wrapped >= TWO_PI, 0.0, wrapped)


def wrap_pi(angle: npt.ArrayLike) -> FloatArray:
    """Wrap angles, as a difference of two azimuths, to [-pi, pi).

    Args:
        angle: radians, any shape.

    Returns:
        Radians, same shape.
    """
    return wrap_two_pi(np.asarray(angle) + np.pi) - np.pi


def yaw_from_azimuth(azimuth: npt.ArrayLike) -> FloatArray:
    """Convert azimuth to yaw of REP-103.

    Args:
        azimuth: radians clockwise from north, any shape.

    Returns:
        Radians counter-clockwise from east in [-pi, pi), same shape.
    """
    return wrap_pi(np.pi / 2 - np.asarray(azimuth))


def azimuth_from_yaw(yaw: npt.ArrayLike) -> FloatArray:
    """Convert yaw of REP-103 to azimuth.

    Args:
        yaw: radians counter-clockwise from east, any shape.

    Returns:
        Radians clockwise from north in [0, 2 pi), same shape.
    """
    return wrap_two_pi(np.pi / 2 - np.asarray(yaw))


def enu_from_polar(
    ground_range: npt.ArrayLike, azimuth: npt.ArrayLike
) -> tuple[FloatArray, FloatArray]:
    """Convert range and azimuth to east and north.

    Args:
        ground_range: metres, any shape.
        azimuth: radians clockwise from north, same shape.

    Returns:
        (x, y): metres east and north, same shape.
    """
    ground_range = np.asarray(ground_range, dtype=float)
    return ground_range * np.sin(azimuth), ground_range * np.cos(azimuth)


def polar_from_enu(x: npt.ArrayLike, y: npt.ArrayLike) -> tuple[FloatArray, FloatArray]:
    """Convert east and north to range and azimuth; also a velocity to speed and course.

    Args:
        x: metres (or m/s) east, any shape.
        y: metres (or m/s) north, same shape.

    Returns:
        (range, azimuth): metres (or m/s) and radians clockwise from north in [0, 2 pi), same shape.
    """
    return np.hypot(x, y), wrap_two_pi(np.arctan2(x, y))


def enu_covariance(
    ground_range: npt.ArrayLike,
    azimuth: npt.ArrayLike,
    range_std: npt.ArrayLike,
    azimuth_std: npt.ArrayLike,
) -> FloatArray:
    """Covariance of (x, y) from independent errors of range and azimuth, to first order.

    Args:
        ground_range: metres, shape (n,).
        azimuth: radians clockwise from north, shape (n,).
        range_std: metres, shape (n,).
        azimuth_std: radians, shape (n,).

    Returns:
        Covariances in square metres, shape (n, 2, 2).
    """
    sine, cosine = np.sin(azimuth), np.cos(azimuth)
    along = np.square(range_std)
    across = np.square(np.asarray(ground_range, dtype=float) * azimuth_std)
    covariance = np.empty((*np.shape(sine), 2, 2))
    covariance[..., 0, 0] = along * sine**2 + across * cosine**2
    covariance[..., 1, 1] = along * cosine**2 + across * sine**2
    covariance[..., 0, 1] = covariance[..., 1, 0] = (along - across) * sine * cosine
    return covariance


def ground_from_slant(slant_range: npt.ArrayLike, height: npt.ArrayLike) -> FloatArray:
    """Ground range of a target whose height over the antenna is known.

    Source: Kuzmin 1967, (4.127).

    Args:
        slant_range: metres, any shape.
        height: metres over the antenna, same shape.

    Returns:
        Metres, same shape; zero where the height exceeds the slant range.
    """
    return np.sqrt(np.maximum(np.square(slant_range) - np.square(height), 0.0))
