# SPDX-License-Identifier: Apache-2.0
"""Where a track of given speed and course will be, in rectangular and in polar form, with variances.

Source: Kuzmin 1967, § 4.6.2 and 4.6.7, (4.133)-(4.136), table 4.3. Angles in radians clockwise from north; x east,
y north.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from radar_common.frames import wrap_two_pi
from secondary_proc.calculators.rule_chain import FloatArray


def rectangular_extrapolation(
    position: npt.ArrayLike,
    speed: npt.ArrayLike,
    course: npt.ArrayLike,
    seconds: npt.ArrayLike,
    *,
    gain: npt.ArrayLike = 0.0,
    turn: npt.ArrayLike = 0.0,
    chord: float = 0.5,
) -> FloatArray:
    """Predict the position.

    Source: § 4.6.2, with the units of its increments made consistent.

    Args:
        position: metres, shape (..., 2).
        speed: V, m/s, shape (...), as all the following.
        course: Q, radians.
        seconds: to the prediction, T_0.
        gain: of speed until then, m/s.
        turn: of course until then, radians.
        chord: share of the turn in the direction of the way; one half is that of an arc's chord, the book has 1.

    Returns:
        Metres, shape (..., 2).
    """
    way = (_real(speed) + _real(gain) / 2.0) * _real(seconds)
    direction = _real(course) + chord * _real(turn)
    step = np.stack([way * np.sin(direction), way * np.cos(direction)], axis=-1)
    return np.asarray(_real(position) + step)


def rectangular_covariance(
    covariance: npt.ArrayLike,
    speed: npt.ArrayLike,
    course: npt.ArrayLike,
    seconds: npt.ArrayLike,
    speed_variance: npt.ArrayLike,
    course_variance: npt.ArrayLike,
) -> FloatArray:
    """Error covariance of the predicted position in uniform straight motion.

    Args:
        covariance: of the position now, shape (..., 2, 2), independent of speed and course.
        speed: V, m/s, shape (...), as all the following.
        course: Q, radians.
        seconds: to the prediction, T_0.
        speed_variance: (m/s)^2.
        course_variance: rad^2.

    Returns:
        m^2, shape (..., 2, 2).
    """
    sine, cosine = np.sin(_real(course)), np.cos(_real(course))
    ahead = np.stack([sine, cosine], axis=-1)
    aside = np.stack([cosine, -sine], axis=-1)
    along = _real(seconds) ** 2 * _real(speed_variance)
    across = (_real(seconds) * _real(speed)) ** 2 * _real(course_variance)
    spread = along[..., None, None] * ahead[..., :, None] * ahead[..., None, :]
    spread = spread + across[..., None, None] * aside[..., :, None] * aside[..., None, :]
    return np.asarray(_real(covariance) + spread)


def polar_extrapolation(
    ranges: npt.ArrayLike, azimuth: npt.ArrayLike, way: npt.ArrayLike, course: npt.ArrayLike
) -> tuple[FloatArray, FloatArray]:
    """Predict range and azimuth from the measured ones, exactly.

    Source: (4.133), (4.134), with the sign that the book's modulus of Q - beta loses.

    Args:
        ranges: over the ground, metres, any shape.
        azimuth: radians, any shape that fits, as all the following.
        way: l, speed times time, metres.
        course: Q, radians.

    Returns:
        (range in metres, azimuth in [0, 2 pi)), in the common shape.
    """
    angle = _real(course) - _real(azimuth)
    ahead, aside = _real(ranges) + _real(way) * np.cos(angle), _real(way) * np.sin(angle)
    return np.hypot(ahead, aside), wrap_two_pi(_real(azimuth) + np.arctan2(aside, ahead))


def polar_variances(
    ranges: npt.ArrayLike,
    angle: npt.ArrayLike,
    speed: npt.ArrayLike,
    seconds: npt.ArrayLike,
    range_std: npt.ArrayLike,
    azimuth_std: npt.ArrayLike,
    speed_std: npt.ArrayLike,
    course_std: npt.ArrayLike,
) -> tuple[FloatArray, FloatArray]:
    """Error variances of the predicted range and azimuth for a way short against the range.

    Source: (4.135), (4.136).

    Args:
        ranges: over the ground, metres, any shape.
        angle: Q - beta between course and line of sight, radians, any shape that fits, as all the following.
        speed: V, m/s.
        seconds: to the prediction, T_0.
        range_std: of the measured range, metres.
        azimuth_std: of the measured azimuth, radians.
        speed_std: of the smoothed speed, m/s.
        course_std: of the smoothed course, radians.

    Returns:
        (range, m^2; azimuth, rad^2), in the common shape.
    """
    ahead = (_real(seconds) * _real(speed_std)) ** 2
    aside = (_real(seconds) * _real(speed) * _real(course_std)) ** 2
    cosine, sine = np.cos(_real(angle)) ** 2, np.sin(_real(angle)) ** 2
    return (
        np.asarray(_real(range_std) ** 2 + cosine * ahead + sine * aside),
        np.asarray(_real(azimuth_std) ** 2 + (sine * ahead + cosine * aside) / _real(ranges) ** 2),
    )


def _real(values: npt.ArrayLike) -> FloatArray:
    return np.asarray(values, dtype=float)
