# SPDX-License-Identifier: Apache-2.0
"""Emitters and direction finders on which the locator's filters are compared: many runs past one truth.

R is the ship of Ristic, Arulampalam and Gordon (2004); A an aircraft that weaves before a slow emitter 50 km away.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from bearing_tracker.emitters.belief import Prior
from bearing_tracker.emitters.information import bound_along
from bearing_tracker.emitters.sight import sight

FloatArray = npt.NDArray[np.float64]

KNOT = 1852.0 / 3600.0


@dataclass(frozen=True, slots=True)
class LocationScene:
    """One truth, and what a filter is told before.

    Attributes:
        name: of it.
        title: one line for people.
        observer: where the bearings are taken, metres east and north, shape (T, 2).
        path: of the emitter, (x, y, vx, vy), shape (T, 4).
        period: of the bearings, seconds.
        std: of a bearing's whole error, radians.
        lasting_std: of its part that is an AR(1) process, radians.
        lasting_time: constant of that process, seconds.
        range_std: of the prior, metres.
        velocity_covariance: of the prior, shape (2, 2).
        range_limits: of the prior, metres.
    """

    name: str
    title: str
    observer: FloatArray
    path: FloatArray
    period: float
    std: float
    range_std: float
    velocity_covariance: FloatArray
    range_limits: tuple[float, float]
    lasting_std: float = 0.0
    lasting_time: float = 10.0

    @property
    def distance(self) -> FloatArray:
        """From observer to emitter, metres, shape (T,)."""
        return np.hypot(*(self.path[:, :2] - self.observer).T)

    def bound(self) -> FloatArray:
        """Cramer-Rao bound of (x, y, vx, vy) on a straight path with white errors, shape (T, 4, 4)."""
        seen = sight(self.path[0, :2] - self.observer[0])
        covariance = np.zeros((4, 4))
        covariance[:2, :2] = self.range_std**2 * np.outer(seen.along, seen.along)
        covariance[:2, :2] += (seen.range * self.std) ** 2 * np.outer(seen.across, seen.across)
        covariance[2:, 2:] = self.velocity_covariance
        looks = len(self.path)
        return bound_along(
            self.path,
            self.observer,
            np.full(looks - 1, self.period),
            np.full(looks, self.std),
            covariance,
        )

    def bearings(self, runs: int, random: np.random.Generator) -> FloatArray:
        """Take bearings.

        Args:
            runs: number of them.
            random: source of the errors.

        Returns:
            Azimuths, radians, not wrapped, shape (T, runs).
        """
        azimuth = sight(self.path[:, :2] - self.observer).azimuth
        looks = len(azimuth)
        white = np.sqrt(self.std**2 - self.lasting_std**2)
        errors = white * random.standard_normal((looks, runs))
        kept = np.exp(-self.period / self.lasting_time)
        lasting = self.lasting_std * random.standard_normal(runs)
        renewal = self.lasting_std * np.sqrt(1.0 - kept**2)
        for look in range(looks):
            errors[look] += lasting
            lasting = kept * lasting + renewal * random.standard_normal(runs)
        return azimuth[:, np.newaxis] + errors

    def prior(self, runs: int, random: np.random.Generator) -> Prior:
        """Draw what filters are told: expectations about the truth, spread as they are said to be.

        Args:
            runs: number of them.
            random: source of the expectations.

        Returns:
            One prior a run, its mean range within the limits.
        """
        low, high = self.range_limits
        expected = self.distance[0] + self.range_std * random.standard_normal(4 * runs)
        expected = expected[(expected > low) & (expected < high)][:runs]
        velocity = random.multivariate_normal(self.path[0, 2:], self.velocity_covariance, runs)
        return Prior(
            np.full(runs, low),
            np.full(runs, high),
            expected,
            np.full(runs, self.range_std),
            velocity,
            np.tile(self.velocity_covariance, (runs, 1, 1)),
        )


def ship() -> LocationScene:
    """Scenario R: 5 kn against 4 kn at 5 km, one turn after 13 minutes, a bearing of 1.5 degrees a minute."""
    seconds = np.arange(30 * 60) + 0.5
    course = np.radians(np.interp(seconds / 60.0, [13.0, 17.0], [140.0, 20.0]))
    observer = _travelled(course, 5.0 * KNOT, 1.0)[::60]
    heading = _heading(np.radians(-140.0))
    sideways = np.array([heading[1], -heading[0]])
    velocity = 4.0 * KNOT * heading
    return LocationScene(
        "R",
        "ship, one turn of the observer",
        observer,
        _straight(5e3 * _heading(np.radians(80.0)), velocity, 60.0, len(observer)),
        60.0,
        float(np.radians(1.5)),
        2e3,
        (2.0 * KNOT) ** 2 * np.outer(heading, heading)
        + (4.0 * KNOT * np.radians(52.0)) ** 2 * np.outer(sideways, sideways),
        (500.0, 12e3),
    )


def aircraft(
    name: str = "A",
    title: str = "aircraft, courses of 30 degrees to both sides",
    *,
    turn_deg: float = 30.0,
    speed: float = 15.0,
    lasting_std_deg: float = 0.0,
) -> LocationScene:
    """Scenario A and its variants: 150 m/s, a new course every 80 s, a bearing of one degree every 2 s.

    Args:
        name: of the scene.
        title: of the scene.
        turn_deg: of the courses to both sides of the mean one, degrees.
        speed: of the emitter, m/s.
        lasting_std_deg: of the part of the bearing error that is an AR(1) process of 10 s, degrees.

    Returns:
        The scene.
    """
    period = 2.0
    # A little later, so that a course begins with its first step.
    seconds = period * np.arange(200) + 1e-6
    course = np.radians(turn_deg) * np.sign(np.sin(2.0 * np.pi * seconds / 160.0))
    observer = _travelled(course, 150.0, period)
    start = 50e3 * _heading(np.radians(60.0))
    return LocationScene(
        name,
        title,
        observer,
        _straight(start, speed * _heading(2.0), period, len(observer)),
        period,
        float(np.radians(1.0)),
        20e3,
        20.0**2 * np.eye(2),
        (5e3, 120e3),
        lasting_std=float(np.radians(lasting_std_deg)),
    )


def turning() -> LocationScene:
    """An emitter of 15 m/s at 20 km that turns by 90 degrees within a minute, bearings of 0.3 degrees."""
    base = aircraft("turning", "emitter that turns after 200 s", turn_deg=40.0)
    seconds = base.period * np.arange(len(base.path))
    course = 2.0 - np.radians(np.interp(seconds, [200.0, 260.0], [0.0, 90.0]))
    velocity = 15.0 * np.column_stack([np.sin(course), np.cos(course)])
    moves = base.period * velocity[:-1]
    places = 0.4 * base.path[0, :2] + np.concatenate([np.zeros((1, 2)), np.cumsum(moves, axis=0)])
    return replace(
        base,
        path=np.column_stack([places, velocity]),
        std=float(np.radians(0.3)),
        range_std=6e3,
        velocity_covariance=15.0**2 * np.eye(2),
        range_limits=(2e3, 60e3),
    )


def _heading(course: float) -> FloatArray:
    return np.array([np.sin(course), np.cos(course)])


def _travelled(course: FloatArray, speed: float, step: float) -> FloatArray:
    moves = speed * step * np.column_stack([np.sin(course), np.cos(course)])
    return np.concatenate([np.zeros((1, 2)), np.cumsum(moves, axis=0)])


def _straight(start: FloatArray, velocity: FloatArray, period: float, looks: int) -> FloatArray:
    places = start + period * np.arange(looks)[:, np.newaxis] * velocity
    return np.column_stack([places, np.tile(velocity, (looks, 1))])
