# SPDX-License-Identifier: Apache-2.0
"""Smoothing of speed and course, each value of which comes from two adjacent plots; a detector watches each of them.

Source: Kuzmin 1967, § 4.6, (4.113)-(4.135), figures 4.23 and 4.24. The book adds the smoothed velocity to the position
plot by plot and never looks at a measured position again, so that errors add up; `feedback` cures it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from radar_common.frames import wrap_pi
from secondary_proc.calculators.exponential_smoothing import turn_intensity
from secondary_proc.calculators.speed_and_course import motion
from secondary_proc.calculators.track_extrapolation import rectangular_extrapolation
from secondary_proc.calculators.weighted_mean import combine
from secondary_proc.motion import FloatArray, quadratic_form
from secondary_proc.smoothing.interface import Measured, Smoothed
from secondary_proc.smoothing.manoeuvre import ManoeuvreDetector
from secondary_proc.smoothing.speed_course_errors import propagate

SPEED_COURSE_WEIGHTS = ("exponential", "weighted_mean")

_ZETA = np.linspace(0.0, 0.999, 1000)[::-1]
_LOG_INTENSITY = np.log(turn_intensity(_ZETA))

_MEMORY: np.dtype[Any] = np.dtype(
    [
        ("plots", np.int64),
        ("position", float, (2,)),
        ("position_covariance", float, (2, 2)),
        # Covariance of the last plot's error with the errors of position and velocity.
        ("shared", float, (4, 2)),
        # Speed and course, and their variances: of the last pair of plots, of the pair before, of the mean.
        ("last", float, (2,)),
        ("last_variance", float, (2,)),
        ("before", float, (2,)),
        ("before_variance", float, (2,)),
        ("mean_variance", float, (2,)),
    ]
)


@dataclass(frozen=True, kw_only=True, slots=True)
class SpeedCourseSettings:
    """How speed and course are smoothed.

    Attributes:
        weights: "exponential" for a memory that fades, "weighted_mean" for one that grows until a manoeuvre.
        acceleration: m/s^2 that the fading memory is the best for between manoeuvres.
        manoeuvre_acceleration: the same in a manoeuvre.
        feedback: share of the position's residual that is added to the position; 0 is the book's dead reckoning.
        noise_density: power spectral density of the acceleration that the covariance accounts for, m^2/s^3.
    """

    weights: str
    acceleration: float
    manoeuvre_acceleration: float
    feedback: float
    noise_density: float


class SpeedCourseSmoother:
    """Smoother of speed and course."""

    memory: np.dtype[Any] = _MEMORY

    def __init__(self, settings: SpeedCourseSettings, detector: ManoeuvreDetector) -> None:
        """Set what is smoothed how.

        Args:
            settings: of the smoothing.
            detector: of changes of speed and of course, each for itself.
        """
        self._settings = settings
        self._detector = detector

    def update(self, measured: Measured) -> Smoothed:
        """Combine the smoothed speed and course with those of the last two plots.

        Args:
            measured: tracks and plots.

        Returns:
            The tracks at the time of their plots; memory holds the last plot and what the detectors compare.
        """
        memory = self._started(measured)
        seconds = measured.seconds
        pair, variance = _from_pair(memory, measured)
        smoothed = _polar(measured.state[:, 2:])
        declared = self._declared(memory, smoothed, pair, variance)
        keep = self._keep(memory, pair, variance, declared, seconds)
        change = (1.0 - keep) * _difference(pair, smoothed)
        speed, course = (smoothed + change).T
        feedback = self._settings.feedback
        place = rectangular_extrapolation(measured.state[:, :2], speed, course, seconds)
        place += feedback * (measured.position - place)
        velocity = np.stack([speed * np.sin(course), speed * np.cos(course)], axis=1)
        covariance, shared = propagate(
            measured, memory, keep, course, feedback, self._settings.noise_density
        )
        after = np.empty_like(memory)
        after["plots"] = memory["plots"] + 1
        after["position"] = measured.position
        after["position_covariance"] = measured.position_covariance
        after["shared"] = shared
        after["last"], after["last_variance"] = pair, variance
        after["before"], after["before_variance"] = memory["last"], memory["last_variance"]
        _, mean_variance = combine(0.0, memory["mean_variance"], 0.0, variance)
        after["mean_variance"] = np.where(declared, variance, mean_variance)
        return Smoothed(np.concatenate([place, velocity], axis=1), covariance, after)

    def _started(self, measured: Measured) -> npt.NDArray[Any]:
        """Memory; a track without one has just been opened by two plots, the state's position being the second."""
        new = measured.memory["plots"] == 0
        if not new.any():
            return measured.memory
        state, covariance = measured.state, measured.covariance
        begun = np.zeros(len(new), _MEMORY)
        begun["plots"] = 2
        begun["position"] = state[:, :2]
        begun["position_covariance"] = covariance[:, :2, :2]
        begun["shared"] = covariance[:, :, :2]
        begun["last"] = _polar(state[:, 2:])
        begun["last_variance"] = begun["mean_variance"] = _polar_variances(
            begun["last"], covariance[:, 2:, 2:]
        )
        return np.where(new, begun, measured.memory)

    def _declared(
        self,
        memory: npt.NDArray[Any],
        smoothed: FloatArray,
        pair: FloatArray,
        variance: FloatArray,
    ) -> npt.NDArray[np.bool_]:
        """Manoeuvres in speed and in course, shape (n, 2)."""
        if self._settings.weights == "weighted_mean":
            change = _difference(pair, smoothed)
            return self._detector.declared(change**2 / (variance + memory["mean_variance"]), 1)
        # Values two plots apart share none, so their errors are independent; the third plot has no such value.
        change = _difference(pair, memory["before"])
        known = memory["before_variance"] > 0.0
        return known & self._detector.declared(
            change**2 / (variance + memory["before_variance"]), 1
        )

    def _keep(
        self,
        memory: npt.NDArray[Any],
        pair: FloatArray,
        variance: FloatArray,
        declared: npt.NDArray[np.bool_],
        seconds: FloatArray,
    ) -> FloatArray:
        """Weights of the old speed and course, shape (n, 2)."""
        settings = self._settings
        if settings.weights == "weighted_mean":
            mean = memory["mean_variance"]
            return np.where(declared, 0.0, variance / (variance + mean))
        acceleration = np.where(declared, settings.manoeuvre_acceleration, settings.acceleration)
        change = acceleration * seconds[:, None]
        change[:, 1] /= np.maximum(pair[:, 0], 1.0)
        log_intensity = np.log(np.maximum(change**2 / variance, 1e-18))
        zeta = np.interp(log_intensity, _LOG_INTENSITY, _ZETA)
        # Of the first values the plain mean is best: nothing has been smoothed yet.
        return np.minimum(zeta, 1.0 - 1.0 / memory["plots"][:, None])


def _from_pair(memory: npt.NDArray[Any], measured: Measured) -> tuple[FloatArray, FloatArray]:
    """Speed and course from the last plot and the new one, with variances, each of shape (n, 2)."""
    first, second = memory["position"], measured.position
    ranges = [np.hypot(*place.T) for place in (first, second)]
    azimuths = [np.arctan2(*place.T) for place in (first, second)]
    found = motion(ranges[0], azimuths[0], ranges[1], azimuths[1], measured.seconds)
    pair = np.stack([found.speed, found.course], axis=1)
    errors = memory["position_covariance"] + measured.position_covariance
    return pair, _polar_variances(pair, errors / measured.seconds[:, None, None] ** 2)


def _polar(velocity: FloatArray) -> FloatArray:
    return np.stack([np.hypot(*velocity.T), np.arctan2(*velocity.T)], axis=1)


def _polar_variances(speed_course: FloatArray, covariance: FloatArray) -> FloatArray:
    """Variances of speed and course from a velocity's covariance: those ahead and, over the speed, aside."""
    speed, course = speed_course.T
    ahead = np.stack([np.sin(course), np.cos(course)], axis=1)
    aside = np.stack([ahead[:, 1], -ahead[:, 0]], axis=1)
    across = quadratic_form(aside, covariance) / np.maximum(speed, 1.0) ** 2
    return np.stack([quadratic_form(ahead, covariance), across], axis=1)


def _difference(new: FloatArray, old: FloatArray) -> FloatArray:
    difference = new - old
    difference[:, 1] = wrap_pi(difference[:, 1])
    return difference
