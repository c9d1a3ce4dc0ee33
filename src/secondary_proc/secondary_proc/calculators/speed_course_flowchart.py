# SPDX-License-Identifier: Apache-2.0
"""The book's tracker of speed and course as it is drawn, and with its drift cured.

Source: Kuzmin 1967, § 4.6.7, figures 4.23 and 4.24. The flowchart adds the smoothed velocity to the position scan by
scan and never looks at a measured position again, so errors add up without bound as soon as the smoothing coefficient
changes; a share of the position's residual, added back in each scan, holds them.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from radar_common.frames import wrap_pi
from secondary_proc.calculators.exponential_smoothing import MANOEUVRE_ZETA, QUIET_ZETA
from secondary_proc.calculators.rule_chain import FloatArray
from secondary_proc.calculators.speed_and_course import book_variances, motion


@dataclass(frozen=True, kw_only=True)
class Flowchart:
    """Settings.

    Attributes:
        period: T_0, seconds.
        range_std: metres.
        azimuth_std: radians.
        quiet_zeta: weight of the old value in straight flight.
        manoeuvre_zeta: the same while a manoeuvre is declared; equal to the former, there is no switching.
        sigmas: threshold of the manoeuvre detectors, standard deviations of the mean change of two scans.
        feedback: share of the position's residual that is added to the position, in [0, 1]; 0 is the book's dead
            reckoning, 1 starts each prediction at the measured plot as (4.133) does.
    """

    period: float
    range_std: float
    azimuth_std: float
    quiet_zeta: float = QUIET_ZETA
    manoeuvre_zeta: float = MANOEUVRE_ZETA
    sigmas: float = 1.0
    feedback: float = 0.0


@dataclass(frozen=True, slots=True)
class Followed:
    """What comes out from the second plot on.

    Attributes:
        position: smoothed, east and north in metres, shape (scans - 1, ..., 2).
        velocity: smoothed, m/s, shape (scans - 1, ..., 2).
        course_manoeuvre: whether one was declared, shape (scans - 1, ...).
        speed_manoeuvre: whether one was declared, shape (scans - 1, ...).
    """

    position: FloatArray
    velocity: FloatArray
    course_manoeuvre: npt.NDArray[np.bool_]
    speed_manoeuvre: npt.NDArray[np.bool_]


def run_flowchart(settings: Flowchart, ranges: FloatArray, azimuths: FloatArray) -> Followed:
    """Follow tracks that have one plot in each scan.

    Args:
        settings: of the tracker.
        ranges: of the plots, metres, shape (scans, ...), at least two scans.
        azimuths: of the plots, radians, same shape.

    Returns:
        The smoothed tracks.

    Raises:
        ValueError: there are fewer than two scans, or the feedback is not in [0, 1].
    """
    if len(ranges) < 2:
        raise ValueError("speed and course need two plots")
    if not 0.0 <= settings.feedback <= 1.0:
        raise ValueError(f"feedback {settings.feedback:g} is not in [0, 1]")
    current = motion(ranges[:-1], azimuths[:-1], ranges[1:], azimuths[1:], settings.period)
    course_variance, speed_variance = book_variances(
        current.course_angle,
        ranges[1:],
        current.path,
        settings.period,
        settings.range_std,
        settings.azimuth_std,
    )
    turning = _declared(wrap_pi, current.course, course_variance, settings.sigmas)
    speeding = _declared(_plain, current.speed, speed_variance, settings.sigmas)
    zeta_course = np.where(turning, settings.manoeuvre_zeta, settings.quiet_zeta)
    zeta_speed = np.where(speeding, settings.manoeuvre_zeta, settings.quiet_zeta)
    measured = np.stack([ranges * np.sin(azimuths), ranges * np.cos(azimuths)], axis=-1)[1:]
    course, speed, place = current.course[0], current.speed[0], measured[0]
    position, velocity = np.empty((2, *measured.shape))
    for scan in range(len(measured)):
        course = course + (1.0 - zeta_course[scan]) * wrap_pi(current.course[scan] - course)
        speed = speed + (1.0 - zeta_speed[scan]) * (current.speed[scan] - speed)
        velocity[scan] = np.stack([speed * np.sin(course), speed * np.cos(course)], axis=-1)
        if scan:
            place = place + velocity[scan] * settings.period
            place = place + settings.feedback * (measured[scan] - place)
        position[scan] = place
    return Followed(position, velocity, turning, speeding)


def _declared(
    difference: Callable[[FloatArray], FloatArray],
    values: FloatArray,
    variance: FloatArray,
    sigmas: float,
) -> npt.NDArray[np.bool_]:
    """Manoeuvres by the mean change of two scans; none in the first two, which have no such mean."""
    declared = np.zeros(values.shape, dtype=bool)
    change = difference(values[2:] - values[:-2]) / 2.0
    declared[2:] = change**2 >= 0.5 * sigmas**2 * variance[2:]
    return declared


def _plain(value: FloatArray) -> FloatArray:
    return value
