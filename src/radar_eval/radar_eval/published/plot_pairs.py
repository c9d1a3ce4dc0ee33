# SPDX-License-Identifier: Apache-2.0
"""Speed and course from two plots and predictions from them (Kuzmin 1967, § 4.6.7, tables 4.1-4.3, (4.127)-(4.136))."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from radar_eval.published.result import Row
from secondary_proc.calculators.speed_and_course import (
    book_variances,
    horizontal_range,
    linear_variances,
    motion,
)
from secondary_proc.calculators.track_extrapolation import polar_extrapolation, polar_variances

_TRIALS = 40_000
_FOUR_SIGMAS = 4.0
# Signs of a and b: constant and sign of gamma in q.
_QUADRANTS = {(1, 1): (180, -1), (-1, 1): (0, 1), (-1, -1): (360, -1), (1, -1): (180, 1)}
# Signs of x and y: constant and sign of beta'.
_AZIMUTHS = {(1, 1): (0, 1), (-1, 1): (360, -1), (1, -1): (180, -1), (-1, -1): (180, 1)}
# Range, speed, angle: printed course error in degrees, that of (4.131) with the values below.
_TABLE = {
    (200e3, 200.0, 0.0): (26.0, 25.93),
    (200e3, 200.0, 90.0): (5.0, 5.02),
    (20e3, 800.0, 0.0): (0.667, 0.648),
    (20e3, 800.0, 90.0): (1.5, 1.256),
}
_SECONDS, _AZIMUTH_STD, _RANGE_STD = 5.0, np.radians(5.5 / 60.0), 62.0


def plot_pairs() -> Iterator[Row]:
    """Compute speeds, courses, predictions and their errors.

    Yields:
        Quadrants of tables 4.1 and 4.3, table 4.2, and the error formulas against simulated plots.
    """
    ours = float(horizontal_range(50e3, 10e3))
    yield Row("horizontal range of 50 km at 10 km height (4.127)", None, 48989.795, ours, 1e-3)
    yield from _quadrants()
    for (distance, speed, angle), (printed, expected) in _TABLE.items():
        course, _ = book_variances(
            np.radians(angle), distance, speed * _SECONDS, _SECONDS, _RANGE_STD, _AZIMUTH_STD
        )
        finding = (
            "T_0 and the errors are not stated; 5 s, 5.5' and 62 m fit the first line of the table, of whose errors "
            "(4.131) demands a fortieth and a quarter in the second"
        )
        label = f"course error in degrees at {distance / 1e3:g} km, {speed:g} m/s, q = {angle:g}, table 4.2"
        value = float(np.degrees(np.sqrt(course)))
        yield Row(label, printed, expected, value, 6e-3, finding if distance < 50e3 else "")
    yield from _pair_errors()
    yield from _prediction_errors()


def _quadrants() -> Iterator[Row]:
    first, gamma = 50e3, np.degrees(np.arctan2(1.0, 2.0))
    for (a, b), (constant, sign) in _QUADRANTS.items():
        # a = d_(n-1) - d_n cos, b = d_n sin of the second plot.
        nearer, aside = 2e3 * a, 1e3 * b
        distance, turned = np.hypot(first - nearer, aside), np.arctan2(aside, first - nearer)
        ours = float(np.degrees(motion(first, 0.7, distance, 0.7 + turned, 5.0).course_angle))
        label = f"course angle for the signs {a:+d}, {b:+d}, degrees, table 4.1"
        expected = float(constant + sign * gamma)
        yield Row(label, expected, expected, ours, 1e-6)
    for (x, y), (constant, sign) in _AZIMUTHS.items():
        place = np.array([20e3 * x, 30e3 * y])
        start = place - np.array([1e3, 2e3])
        _, azimuth = polar_extrapolation(
            np.hypot(*start), np.arctan2(*start), np.hypot(1e3, 2e3), np.arctan2(1e3, 2e3)
        )
        expected = float(constant + sign * np.degrees(np.arctan2(20.0, 30.0)))
        label = f"predicted azimuth for the signs {x:+d}, {y:+d}, degrees, table 4.3"
        yield Row(label, expected, expected, float(np.degrees(azimuth)), 1e-6)


def _pair_errors() -> Iterator[Row]:
    random = np.random.default_rng(46)
    distance, way, seconds, range_std, azimuth_std = 100e3, 3e3, 10.0, 100.0, np.radians(0.1)
    noise = random.normal(size=(2, 2, _TRIALS))
    for angle in (0.0, 90.0):
        q = np.radians(angle)
        second, azimuth = np.hypot(distance + way * np.cos(q), way * np.sin(q)), 0.0
        azimuth = np.arctan2(way * np.sin(q), distance + way * np.cos(q))
        seen = motion(
            distance + range_std * noise[0, 0],
            azimuth_std * noise[0, 1],
            second + range_std * noise[1, 0],
            azimuth + azimuth_std * noise[1, 1],
            seconds,
        )
        off = (seen.course - q + np.pi) % (2 * np.pi) - np.pi
        book = book_variances(q, second, way, seconds, range_std, azimuth_std)
        linear = linear_variances(
            q, [distance, second], [0.0, azimuth], way, seconds, range_std, azimuth_std
        )
        for name, unit, values, formulas in (
            ("course (4.131), degrees", 180.0 / np.pi, off, (book[0], linear[0])),
            ("speed (4.132), m/s", 1.0, seen.speed - way / seconds, (book[1], linear[1])),
        ):
            simulated = float(values.std()) * unit
            for kind, formula in zip(("", ", each plot by itself"), formulas, strict=True):
                # A sample deviation of n values scatters by 1 / sqrt(2 n); the rest is curvature, 3 %.
                tolerance = (_FOUR_SIGMAS / np.sqrt(2.0 * _TRIALS) + 0.03) * simulated
                ours = float(np.sqrt(formula)) * unit
                label = f"100 km, 300 m/s, q = {angle:g}: rms {name}{kind}, against simulation"
                yield Row(label, None, simulated, ours, tolerance)


def _prediction_errors() -> Iterator[Row]:
    random = np.random.default_rng(47)
    distance, speed, seconds = 50e3, 300.0, 10.0
    range_std, azimuth_std, speed_std, course_std = 100.0, np.radians(0.1), 15.0, np.radians(3.0)
    noise = random.normal(size=(4, _TRIALS))
    for angle in (20.0, 60.0, 120.0):
        course = np.radians(angle)
        ranges, azimuths = polar_extrapolation(
            distance + range_std * noise[0],
            0.5 + azimuth_std * noise[1],
            seconds * (speed + speed_std * noise[2]),
            0.5 + course + course_std * noise[3],
        )
        formulas = polar_variances(
            distance, course, speed, seconds, range_std, azimuth_std, speed_std, course_std
        )
        for name, values, formula in (
            ("range (4.135), metres", ranges, formulas[0]),
            ("azimuth (4.136), milliradians", 1e3 * azimuths, 1e6 * formulas[1]),
        ):
            simulated = float(values.std())
            label = f"50 km, 300 m/s, course {angle:g} off the line of sight: rms predicted {name}"
            finding = (
                "(4.136) neglects the way against the range, 6 % here" if "azimuth" in name else ""
            )
            yield Row(label, None, simulated, float(np.sqrt(formula)), 0.06 * simulated, finding)
