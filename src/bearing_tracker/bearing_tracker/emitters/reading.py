# SPDX-License-Identifier: Apache-2.0
"""What a belief says: the next bearing, and the emitter with what its range is worth."""

from __future__ import annotations

import numpy as np

from bearing_tracker.emitters import information, mixture
from bearing_tracker.emitters.belief import Belief
from bearing_tracker.emitters.interface import Estimate, Expected, FilterSettings, FloatArray
from bearing_tracker.emitters.sight import Sight, sight
from radar_common.frames import wrap_pi, wrap_two_pi


def expect_bearings(belief: Belief) -> Expected:
    """Foretell bearings taken now.

    Args:
        belief: of n emitters.

    Returns:
        Azimuths and their deviations.
    """
    seen = sight(belief.mean[..., :2] - belief.observer[:, np.newaxis, np.newaxis])
    gradient = np.zeros_like(belief.mean)
    gradient[..., :2] = seen.gradient
    gradient[..., 4:] = 1.0
    azimuth = seen.azimuth + belief.mean[..., 4:].sum(axis=-1)
    return Expected(*_angle_moments(belief.weight, azimuth, _along(belief.covariance, gradient)))


def read_estimate(belief: Belief, settings: FilterSettings) -> Estimate:
    """Put the components of a belief together and judge them by the information in the bearings.

    Args:
        belief: of n emitters.
        settings: of its filter.

    Returns:
        Estimates of n emitters.
    """
    components = (len(belief), belief.weight.shape[1] * belief.weight.shape[2])
    mean, covariance = belief.mean[..., :4], belief.covariance[..., :4, :4]
    state, spread = mixture.moments(
        belief.weight.reshape(components),
        mean.reshape(*components, 4),
        covariance.reshape(*components, 4, 4),
    )
    each = sight(mean[..., :2] - belief.observer[:, np.newaxis, np.newaxis])
    across = _along(covariance[..., :2, :2], each.gradient)
    azimuth, azimuth_std = _angle_moments(belief.weight, each.azimuth, across)
    seen = sight(state[:, :2] - belief.observer)
    geometry = belief.geometry
    bearings = information.bearing_information(geometry, state)
    doubtful = settings.speed_doubt**2 * belief.prior.velocity_covariance
    told = information.range_information(bearings, doubtful, seen)
    known = told * settings.known_range_error**2 >= 1.0
    limit = information.bound(bearings, geometry, state, seen, belief.prior, belief.range_spread)
    least = np.where(known, 0.0, belief.range_spread)
    spread, range_std = _no_surer(spread, seen, least)
    return Estimate(
        state,
        spread,
        azimuth,
        azimuth_std,
        seen.range,
        range_std,
        known,
        told,
        np.sqrt(limit[:, 0, 0] + limit[:, 1, 1]),
    )


def _no_surer(
    covariance: FloatArray, seen: Sight, least: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Widen covariances along the line of sight to a deviation of range at least; also gives that deviation."""
    variance = _along(covariance[:, :2, :2], seen.along)
    missing = np.maximum(least**2 - variance, 0.0)
    covariance = covariance.copy()
    along = np.sqrt(missing)[:, np.newaxis] * seen.along
    covariance[:, :2, :2] += along[:, :, np.newaxis] * along[:, np.newaxis]
    return covariance, np.sqrt(variance + missing)


def _angle_moments(
    weight: FloatArray, azimuth: FloatArray, variance: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Mean and deviation of mixtures of angles, (n, B, M) each, about the likeliest component."""
    flat = weight.reshape(len(weight), weight.shape[1] * weight.shape[2])
    best = flat.argmax(axis=-1)[:, np.newaxis]
    reference = np.take_along_axis(azimuth.reshape(flat.shape), best, axis=-1)
    apart = wrap_pi(azimuth.reshape(flat.shape) - reference)
    mean = (flat * apart).sum(axis=-1, keepdims=True)
    total = (flat * (variance.reshape(flat.shape) + (apart - mean) ** 2)).sum(axis=-1)
    return wrap_two_pi(reference + mean)[:, 0], np.sqrt(total)


def _along(covariance: FloatArray, gradient: FloatArray) -> FloatArray:
    return np.einsum("...ij,...i,...j->...", covariance, gradient, gradient)
