# SPDX-License-Identifier: Apache-2.0
"""A bank of Gaussian filters, one for each bin of range and each motion model, of all emitters at once."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import numpy.typing as npt

from bearing_tracker.emitters import heard_from, mixture, motion
from bearing_tracker.emitters.belief import Belief, Prior
from bearing_tracker.emitters.corrections.interface import FARTHER, NEARER, Correction, Look
from bearing_tracker.emitters.interface import (
    BoolArray,
    Estimate,
    Expected,
    FilterSettings,
    FloatArray,
)
from bearing_tracker.emitters.range_prior import merged, range_bins, whole_range
from bearing_tracker.emitters.reading import expect_bearings, read_estimate
from radar_common.frames import enu_from_polar


class FilterBank:
    """Locates emitters; every filter of this package is one, with its own correction and number of bins."""

    def __init__(
        self, settings: FilterSettings, correction: Correction, range_bins: int = 1
    ) -> None:
        """Choose what one filter does with a bearing, and how many share the range.

        Args:
            settings: motion, correlated error and what counts as known.
            correction: of one Gaussian density by one bearing.
            range_bins: number of filters over range; 1 makes it a single one.

        Raises:
            ValueError: there is no bin, or the treatment of correlated errors is unknown.
        """
        error = settings.correlated
        if range_bins < 1:
            raise ValueError(f"a bank needs a bin of range, got {range_bins}")
        if error.treatment not in ("inflate", "augment"):
            raise ValueError(
                f"correlated errors are treated by inflate or augment, not {error.treatment!r}"
            )
        self._settings = settings
        self._correction = correction
        self._bins = range_bins
        self._augmented = error.treatment == "augment" and error.std > 0.0
        levels = [settings.acceleration_std]
        if settings.manoeuvre_std > 0.0:
            levels.append(settings.manoeuvre_std)
        self._acceleration_std = np.array(levels)

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

        Raises:
            ValueError: a bearing is not finite, or its deviation not positive.
        """
        _check(azimuth, std)
        bins = whole_range(prior) if self._bins == 1 else range_bins(prior, self._bins)
        emitters, models = len(azimuth), len(self._acceleration_std)
        dimension = 5 if self._augmented else 4
        shape = (emitters, self._bins, models, dimension)
        distance, spread = bins.mean[..., np.newaxis], bins.std[..., np.newaxis]
        sine, cosine = np.sin(azimuth), np.cos(azimuth)
        along = np.stack([sine, cosine], axis=-1)[:, np.newaxis, np.newaxis]
        across = np.stack([cosine, -sine], axis=-1)[:, np.newaxis, np.newaxis]
        error = std[:, np.newaxis, np.newaxis]

        mean = np.zeros(shape)
        mean[..., :2] = observer[:, np.newaxis, np.newaxis] + distance[..., np.newaxis] * along
        mean[..., 2:4] = prior.velocity[:, np.newaxis, np.newaxis]
        covariance = np.zeros((*shape, dimension))
        covariance[..., :2, :2] = _outer(spread, along) + _outer(distance * error, across)
        covariance[..., 2:4, 2:4] = prior.velocity_covariance[:, np.newaxis, np.newaxis]
        if self._augmented:
            lasting = self._settings.correlated.std**2
            # The bearing was off by g too, which put the emitter as far to the other side.
            covariance[..., :2, 4] = covariance[..., 4, :2] = (
                -lasting * distance[..., np.newaxis] * across
            )
            covariance[..., 4, 4] = lasting
        at_rest = mixture.switching(
            np.full(1, np.inf), self._settings.quiet_time, self._settings.manoeuvre_time
        )[0, 0]
        weight = bins.probability[..., np.newaxis] * (at_rest if models == 2 else np.ones(1))
        return Belief(
            mean,
            covariance,
            weight,
            observer,
            np.zeros_like(observer),
            heard_from.first_heard(observer, std**2),
            prior,
            merged(bins).std[:, 0],
        )

    def predict(self, belief: Belief, seconds: FloatArray, observer: FloatArray) -> Belief:
        """Let time pass without bearings.

        Args:
            belief: of n emitters.
            seconds: from the belief's time, not negative, shape (n,).
            observer: where the observer is then, metres east and north, shape (n, 2).

        Returns:
            The belief at the later time.

        Raises:
            ValueError: time runs backwards.
        """
        if not (seconds >= 0.0).all():
            raise ValueError("emitters cannot be predicted backwards")
        weight, mean, covariance = belief.weight, belief.mean, belief.covariance
        if len(self._acceleration_std) == 2:
            passing = mixture.switching(
                seconds, self._settings.quiet_time, self._settings.manoeuvre_time
            )
            weight, mean, covariance = mixture.interacted(weight, mean, covariance, passing)
        step = seconds[:, np.newaxis, np.newaxis]
        mean, covariance = motion.propagate(mean, covariance, step, self._acceleration_std)
        if self._augmented:
            motion.wander(mean, covariance, step, self._settings.correlated)
        moved = seconds > 0.0
        velocity = (observer - belief.observer) / np.where(moved, seconds, 1.0)[:, np.newaxis]
        return replace(
            belief,
            mean=mean,
            covariance=covariance,
            weight=weight,
            observer=observer,
            observer_velocity=np.where(moved[:, np.newaxis], velocity, belief.observer_velocity),
            geometry=heard_from.passed(
                belief.geometry, seconds, weight.sum(axis=1) @ self._acceleration_std**2
            ),
        )

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

        Raises:
            ValueError: time runs backwards, a bearing is not finite, or its deviation not positive.
        """
        predicted = self.predict(belief, seconds, observer)
        rows = np.flatnonzero(heard)
        azimuth, std = azimuth[rows], std[rows]
        _check(azimuth, std)
        geometry = predicted.geometry
        interval = (geometry.now - geometry.heard)[rows]
        error = self._settings.correlated
        inflated = motion.inflated_variance(std, interval, error)
        variance = motion.white_variance(std, error) if self._augmented else inflated
        part = predicted if len(rows) == len(belief) else predicted.take(rows)
        look = Look(
            azimuth[:, np.newaxis, np.newaxis],
            variance[:, np.newaxis, np.newaxis],
            part.observer[:, np.newaxis, np.newaxis],
            part.observer_velocity[:, np.newaxis, np.newaxis],
            part.prior.range_low[:, np.newaxis, np.newaxis],
            part.prior.range_high[:, np.newaxis, np.newaxis],
        )
        corrected = self._correction(part.mean, part.covariance, look)
        weight, mean, covariance = mixture.revived(
            mixture.reweighted(part.weight, corrected.log_likelihood),
            _within_reach(corrected.mean, look),
            corrected.covariance,
        )
        return replace(
            predicted,
            mean=_put(predicted.mean, rows, mean),
            covariance=_put(predicted.covariance, rows, covariance),
            weight=_put(predicted.weight, rows, weight),
            geometry=heard_from.heard_again(geometry, part.observer, inflated, rows),
        )

    def expected(self, belief: Belief) -> Expected:
        """Tell where each emitter would be heard now, for gates and assignment.

        Args:
            belief: predicted to the time of the bearings.

        Returns:
            Azimuths and their deviations, the correlated error included where the filter estimates it.
        """
        return expect_bearings(belief)

    def estimate(self, belief: Belief) -> Estimate:
        """Tell where each emitter is now, and how much of that the bearings tell.

        Args:
            belief: of n emitters.

        Returns:
            State, covariance, range and what they are worth.
        """
        return read_estimate(belief, self._settings)


def _within_reach(mean: FloatArray, look: Look) -> FloatArray:
    """Hold components before the observer: past it or on it, the azimuth says nothing linear any more."""
    direction = np.stack(enu_from_polar(np.ones_like(look.azimuth), look.azimuth), axis=-1)
    distance = ((mean[..., :2] - look.observer) * direction).sum(axis=-1)
    shift = np.clip(distance, look.range_low / NEARER, look.range_high * FARTHER) - distance
    if not shift.any():
        return mean
    held = mean.copy()
    held[..., :2] += shift[..., np.newaxis] * direction
    return held


def _outer(length: FloatArray, direction: FloatArray) -> FloatArray:
    scaled = length[..., np.newaxis] * direction
    return scaled[..., :, np.newaxis] * scaled[..., np.newaxis, :]


def _put(before: FloatArray, rows: npt.NDArray[np.intp], after: FloatArray) -> FloatArray:
    if len(rows) == len(before):
        return after
    changed = before.copy()
    changed[rows] = after
    return changed


def _check(azimuth: FloatArray, std: FloatArray) -> None:
    if not (np.isfinite(azimuth).all() and (std > 0.0).all() and np.isfinite(std).all()):
        raise ValueError("bearings need a finite azimuth and a positive deviation")
