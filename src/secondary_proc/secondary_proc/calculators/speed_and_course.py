# SPDX-License-Identifier: Apache-2.0
"""Speed and course from two plots, and their errors.

Source: Kuzmin 1967, § 4.6.7, (4.127)-(4.132), table 4.1. Angles in radians, azimuth and course clockwise from north.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from radar_common.frames import wrap_two_pi
from secondary_proc.calculators.rule_chain import FloatArray


@dataclass(frozen=True, slots=True)
class Motion:
    """What two plots tell, each attribute in the common shape of the plots.

    Attributes:
        course_angle: q, clockwise from the line of sight of the first plot, in [0, 2 pi).
        course: Q, clockwise from north, in [0, 2 pi).
        path: l, way between both plots, metres.
        speed: V, metres per second.
    """

    course_angle: FloatArray
    course: FloatArray
    path: FloatArray
    speed: FloatArray


def horizontal_range(slant: npt.ArrayLike, height: npt.ArrayLike) -> FloatArray:
    """Range over the ground.

    Source: (4.127); (4.127a) is slant range times the cosine of the elevation.

    Args:
        slant: metres, any shape.
        height: over the horizon of the radar, metres, at most the slant range, any shape that fits.

    Returns:
        Metres, in the common shape.
    """
    return np.asarray(np.sqrt(_real(slant) ** 2 - _real(height) ** 2))


def motion(
    first_range: npt.ArrayLike,
    first_azimuth: npt.ArrayLike,
    ranges: npt.ArrayLike,
    azimuth: npt.ArrayLike,
    seconds: npt.ArrayLike,
) -> Motion:
    """Compute speed and course.

    Source: (4.128)-(4.130); the arc tangent of two arguments is what table 4.1 does by cases.

    Args:
        first_range: over the ground, metres, any shape.
        first_azimuth: radians, any shape that fits, as all the following.
        ranges: of the second plot, metres.
        azimuth: of the second plot, radians.
        seconds: between both plots, positive.

    Returns:
        The motion.
    """
    turned = _real(azimuth) - _real(first_azimuth)
    nearer = _real(first_range) - _real(ranges) * np.cos(turned)
    aside = _real(ranges) * np.sin(turned)
    angle = np.arctan2(aside, -nearer)
    path = np.hypot(nearer, aside)
    return Motion(
        wrap_two_pi(angle),
        wrap_two_pi(_real(first_azimuth) + angle),
        path,
        np.asarray(path / _real(seconds)),
    )


def book_variances(
    course_angle: npt.ArrayLike,
    ranges: npt.ArrayLike,
    path: npt.ArrayLike,
    seconds: npt.ArrayLike,
    range_std: npt.ArrayLike,
    azimuth_std: npt.ArrayLike,
) -> tuple[FloatArray, FloatArray]:
    """Error variances of course and speed for a path short against the range.

    Source: (4.131), (4.132).

    Args:
        course_angle: q, radians, any shape.
        ranges: of the second plot, metres, any shape that fits, as all the following.
        path: l, metres.
        seconds: between both plots.
        range_std: metres.
        azimuth_std: radians.

    Returns:
        (course, rad^2; speed, (m/s)^2), in the common shape.
    """
    angle = _real(course_angle)
    return _variances(
        2.0 * _real(range_std) ** 2,
        2.0 * (_real(ranges) * _real(azimuth_std)) ** 2,
        np.sin(angle) ** 2,
        _real(path),
        _real(seconds),
    )


def linear_variances(
    course: npt.ArrayLike,
    ranges: npt.ArrayLike,
    azimuths: npt.ArrayLike,
    path: npt.ArrayLike,
    seconds: npt.ArrayLike,
    range_std: npt.ArrayLike,
    azimuth_std: npt.ArrayLike,
) -> tuple[FloatArray, FloatArray]:
    """Error variances of course and speed, each plot with its own range and azimuth.

    The errors of both plots along and across the path, which (4.131) and (4.132) take at one place.

    Args:
        course: Q, radians, any shape.
        ranges: of both plots, metres, shape (2, ...).
        azimuths: of both plots, radians, shape (2, ...).
        path: l, metres, any shape that fits, as all the following.
        seconds: between both plots.
        range_std: metres.
        azimuth_std: radians.

    Returns:
        (course, rad^2; speed, (m/s)^2), in the common shape.
    """
    angle = _real(course) - _real(azimuths)
    radial, across = _real(range_std) ** 2, (_real(ranges) * _real(azimuth_std)) ** 2
    course_variance, speed_variance = _variances(
        radial, across, np.sin(angle) ** 2, _real(path), _real(seconds)
    )
    return course_variance.sum(axis=0), speed_variance.sum(axis=0)


def _variances(
    radial: FloatArray,
    across: FloatArray,
    square: FloatArray,
    path: FloatArray,
    seconds: FloatArray,
) -> tuple[FloatArray, FloatArray]:
    """Errors aside and ahead of a path whose angle to the line of sight has the sine's square given."""
    course = (radial * square + across * (1.0 - square)) / path**2
    speed = (radial * (1.0 - square) + across * square) / seconds**2
    return np.asarray(course), np.asarray(speed)


def _real(values: npt.ArrayLike) -> FloatArray:
    return np.asarray(values, dtype=float)
