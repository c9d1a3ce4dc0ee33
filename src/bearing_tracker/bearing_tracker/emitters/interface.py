# SPDX-License-Identifier: Apache-2.0
"""What the locator asks of a filter that finds emitters from bearings taken by a moving observer.

All filters work in ENU: x east, y north, azimuth clockwise from north. One call serves all emitters: axis 0 of every
array is the emitter, each has its own time, observer position and bearing.

    filter = FILTERS["range_parameterised"](FilterSettings())
    belief = filter.start(azimuth, std, observer, Prior.between(1e3, 200e3, speed_std=15.0, emitters=n))
    belief = filter.step(belief, seconds, observer, azimuth, std, heard)
    estimate = filter.estimate(belief)

Emitters come and go by `belief.take(kept)` and `belief.joined(started)`. Bearings are given to emitters with
`filter.expected(filter.predict(belief, seconds, observer))`: gate distance and likelihood of every pair.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Protocol

import numpy as np
import numpy.typing as npt

from bearing_tracker.emitters.belief import Belief, Geometry, Prior, Rows
from radar_common.frames import wrap_pi

__all__ = [
    "Belief",
    "CorrelatedError",
    "EmitterFilter",
    "Estimate",
    "Expected",
    "FilterSettings",
    "Geometry",
    "Prior",
    "Rows",
]

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class Expected(Rows):
    """Where the next bearing is expected.

    Attributes:
        azimuth: radians clockwise from north in [0, 2 pi), shape (n,).
        azimuth_std: of that expectation, without the error of the bearing, radians, shape (n,).
    """

    azimuth: FloatArray
    azimuth_std: FloatArray

    def distance(self, azimuth: FloatArray, std: FloatArray) -> FloatArray:
        """Squared distance of bearings from emitters in standard deviations, to be compared with a gate.

        Args:
            azimuth: of k bearings, radians, shape (k,).
            std: of their errors, radians, shape (k,).

        Returns:
            Shape (n, k); chi-square with one degree of freedom where they belong together.
        """
        innovation = wrap_pi(azimuth - self.azimuth[:, np.newaxis])
        return innovation**2 / self._variance(std)

    def log_likelihood(self, azimuth: FloatArray, std: FloatArray) -> FloatArray:
        """Logarithm of the density of bearings if they come from the emitters.

        Args:
            azimuth: of k bearings, radians, shape (k,).
            std: of their errors, radians, shape (k,).

        Returns:
            Density in 1/rad, shape (n, k).
        """
        normalisation = np.log(2.0 * np.pi * self._variance(std))
        return -0.5 * (self.distance(azimuth, std) + normalisation)

    def _variance(self, std: FloatArray) -> FloatArray:
        return self.azimuth_std[:, np.newaxis] ** 2 + std**2


@dataclass(frozen=True, slots=True)
class Estimate(Rows):
    """Where emitters are now.

    Attributes:
        state: (x, y, vx, vy), metres and m/s, east and north, shape (n, 4).
        covariance: of the state, shape (n, 4, 4); along the bearing no less than the prior's where the range is not
            known.
        azimuth: from the observer, radians clockwise from north in [0, 2 pi), shape (n,).
        azimuth_std: radians, shape (n,).
        range: from the observer, metres, shape (n,).
        range_std: metres, shape (n,).
        range_known: whether the bearings taken so far tell the range, whatever the filter believes, shape (n,).
        range_information: Fisher information of the bearings about the logarithm of range, shape (n,): its inverse
            square root is the smallest relative error of range that they allow.
        bound_std: root of the Cramer-Rao bound of the position (x and y together) along the estimated geometry,
            metres, shape (n,).
    """

    state: FloatArray
    covariance: FloatArray
    azimuth: FloatArray
    azimuth_std: FloatArray
    range: FloatArray
    range_std: FloatArray
    range_known: BoolArray
    range_information: FloatArray
    bound_std: FloatArray


@dataclass(frozen=True, slots=True, kw_only=True)
class CorrelatedError:
    """A part of the bearing error that lasts, as the wander of an antenna's phase centre does (an AR(1) process).

    Attributes:
        std: radians; a bearing's `std` is the root of the sum of squares of this part and a white one.
        time: constant of correlation, seconds.
        treatment: `inflate` takes the error of a long run of bearings for each of them, `augment` estimates the
            wander beside the emitter.
    """

    std: float = 0.0
    time: float = 10.0
    treatment: str = "inflate"


@dataclass(frozen=True, slots=True, kw_only=True)
class FilterSettings:
    """What all filters are made of.

    Attributes:
        acceleration_std: of the emitter, constant between two bearings, m/s^2 (P004's sigma_M).
        manoeuvre_std: the same while it manoeuvres, m/s^2; 0 leaves that model out.
        quiet_time: mean time between manoeuvres, seconds.
        manoeuvre_time: mean length of one, seconds.
        range_bins: of the range-parameterised filter.
        correlated: part of the bearing error that lasts.
        known_range_error: largest relative standard error of range, by the bearings alone, that counts as known.
        speed_doubt: how many times the prior's deviation of velocity is taken when it is asked whether the range is
            known, since an observer that does not manoeuvre has the range from that assumption only.
    """

    acceleration_std: float = 0.01
    manoeuvre_std: float = 0.0
    quiet_time: float = 300.0
    manoeuvre_time: float = 30.0
    range_bins: int = 7
    correlated: CorrelatedError = field(default_factory=CorrelatedError)
    known_range_error: float = 0.25
    speed_doubt: float = 3.0


class EmitterFilter(Protocol):
    """Locates emitters from bearings, all of them at once."""

    def start(
        self, azimuth: FloatArray, std: FloatArray, observer: FloatArray, prior: Prior
    ) -> Belief:
        """Begin with the first bearing of each emitter.

        Args:
            azimuth: radians clockwise from north, shape (n,).
            std: total standard deviation of its error, radians, positive, shape (n,).
            observer: where it was taken, metres east and north, shape (n, 2).
            prior: what was known before.

        Returns:
            The belief at the time of the bearing.
        """
        ...

    def predict(self, belief: Belief, seconds: FloatArray, observer: FloatArray) -> Belief:
        """Let time pass without bearings.

        Args:
            belief: of n emitters.
            seconds: from the belief's time, not negative, shape (n,).
            observer: where the observer is then, metres east and north, shape (n, 2).

        Returns:
            The belief at the later time.
        """
        ...

    def step(
        self,
        belief: Belief,
        seconds: FloatArray,
        observer: FloatArray,
        azimuth: FloatArray,
        std: FloatArray,
        heard: BoolArray,
    ) -> Belief:
        """Let time pass and use the bearings that came.

        Args:
            belief: of n emitters.
            seconds: from the belief's time, not negative, shape (n,).
            observer: where the observer is then, metres east and north, shape (n, 2).
            azimuth: radians clockwise from north, shape (n,); of no meaning where not heard.
            std: total standard deviation of its error, radians, shape (n,); of no meaning where not heard.
            heard: which emitters have a bearing, shape (n,); the others are predicted.

        Returns:
            The belief at the later time.
        """
        ...

    def expected(self, belief: Belief) -> Expected:
        """Tell where each emitter would be heard now, for gates and assignment.

        Args:
            belief: predicted to the time of the bearings.

        Returns:
            Azimuths and their deviations, the correlated error included where the filter estimates it.
        """
        ...

    def estimate(self, belief: Belief) -> Estimate:
        """Tell where each emitter is now, and how much of that the bearings tell.

        Args:
            belief: of n emitters.

        Returns:
            State, covariance, range and what they are worth.
        """
        ...
