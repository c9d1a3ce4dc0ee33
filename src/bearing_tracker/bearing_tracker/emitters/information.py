# SPDX-License-Identifier: Apache-2.0
"""How much bearings tell of an emitter: Fisher information about its range, and the Cramer-Rao bound.

A filter's own covariance is no witness of observability: it is linearised at estimates that jump, and so finds range
where there is none. Here all bearings are linearised again along one path, the estimated one; on it an observer that
has not manoeuvred has exactly no information about the range of an emitter of unknown velocity.
Sources: Nardone and Aidala 1981; Tichavsky, Muravchik and Nehorai 1998 (recursion).
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from bearing_tracker.emitters.belief import Geometry, Prior
from bearing_tracker.emitters.corrections.interface import correct_linear
from bearing_tracker.emitters.heard_from import places_used
from bearing_tracker.emitters.motion import propagate
from bearing_tracker.emitters.sight import Sight, sight

FloatArray = npt.NDArray[np.float64]


def bearing_information(geometry: Geometry, state: FloatArray) -> FloatArray:
    """Fisher information of all bearings about the state now, along the path that leads to it.

    The path is less certain the longer ago, by the accelerations since: each place's variance grows by that, as if the
    growths were independent. They are not, so this is exact for none and to first order for few.

    Args:
        geometry: where the bearings came from.
        state: (x, y, vx, vy) now, metres and m/s, shape (n, 4).

    Returns:
        Shape (n, 4, 4).
    """
    used = places_used(geometry)
    weight, observer = geometry.weight[:, :used], geometry.observer[:, :used]
    taken = weight > 0.0
    age = np.where(taken, geometry.now[:, np.newaxis] - geometry.time[:, :used], 0.0)
    then = state[:, np.newaxis, :2] - age[..., np.newaxis] * state[:, np.newaxis, 2:]
    seen = sight(then - observer)
    unrest = np.where(taken, geometry.unrest_now[:, np.newaxis] - geometry.unrest[:, :used], 0.0)
    drift = unrest * age**2 / 3.0 / seen.range**2
    weight = weight / (1.0 + weight * drift)
    east, north = np.moveaxis(seen.gradient, -1, 0)
    squares = np.stack([east * east, east * north, north * north], axis=1)
    by_age = np.stack([weight, -age * weight, age**2 * weight], axis=-1)
    # Every block of the sum of h' h / variance, h = (gradient, -age gradient), is one matrix by a power of the age.
    blocks = (squares @ by_age)[:, [[0, 1], [1, 2]]]
    information = np.empty((len(state), 4, 4))
    information[:, :2, :2], information[:, 2:, 2:] = blocks[..., 0], blocks[..., 2]
    information[:, :2, 2:] = information[:, 2:, :2] = blocks[..., 1]
    return information


def range_information(
    bearings: FloatArray, velocity_covariance: FloatArray, line_of_sight: Sight
) -> FloatArray:
    """Information about the logarithm of range when azimuth and velocity are unknown too.

    Args:
        bearings: information of the bearings, shape (n, 4, 4).
        velocity_covariance: what is known of the velocity beside them, shape (n, 2, 2).
        line_of_sight: to the emitter now, n of them.

    Returns:
        Its inverse square root is the smallest relative error of range, shape (n,).
    """
    total = bearings.copy()
    total[:, 2:, 2:] += np.linalg.inv(velocity_covariance)
    turned, _ = _by_range(total, line_of_sight)
    others = np.linalg.solve(turned[:, 1:, 1:], turned[:, 1:, :1])
    known = turned[:, 0, 0] - (turned[:, :1, 1:] @ others)[:, 0, 0]
    return np.maximum(known, 0.0)


def bound(
    bearings: FloatArray,
    geometry: Geometry,
    state: FloatArray,
    line_of_sight: Sight,
    prior: Prior,
    range_spread: FloatArray,
) -> FloatArray:
    """Cramer-Rao bound of the state now, from the bearings and the prior.

    Args:
        bearings: information of the bearings, shape (n, 4, 4).
        geometry: where they came from.
        state: (x, y, vx, vy) now, shape (n, 4).
        line_of_sight: to it, n of them.
        prior: of n emitters.
        range_spread: standard deviation of its range, metres, shape (n,).

    Returns:
        Covariances that no unbiased estimate can undercut, shape (n, 4, 4).
    """
    age, unrest = geometry.now, geometry.unrest_now
    start = state[:, :2] - age[:, np.newaxis] * state[:, 2:]
    along = sight(start - geometry.first_observer).along
    gradient = np.concatenate([along, -age[:, np.newaxis] * along], axis=-1)
    variance = range_spread**2 + unrest * age**2 / 3.0
    total = bearings + (
        gradient[:, :, np.newaxis] * gradient[:, np.newaxis] / variance[:, np.newaxis, np.newaxis]
    )
    velocity = prior.velocity_covariance + unrest[:, np.newaxis, np.newaxis] * np.eye(2)
    total[:, 2:, 2:] += np.linalg.inv(velocity)
    scaled, basis = _by_range(total, line_of_sight)
    return basis @ np.linalg.inv(scaled) @ np.swapaxes(basis, -1, -2)


def bound_along(
    path: FloatArray,
    observer: FloatArray,
    seconds: FloatArray,
    std: FloatArray,
    covariance: FloatArray,
    acceleration_std: float = 0.0,
) -> FloatArray:
    """Cramer-Rao bound along a path that is known, by recursion.

    J' = (M + b J^-1 b')^-1 + h' h / sigma^2, kept as the inverse of J.

    Args:
        path: true states of one emitter, (x, y, vx, vy), shape (T, 4).
        observer: metres east and north, shape (T, 2).
        seconds: from each bearing to the next, shape (T - 1,).
        std: of the bearings, radians, shape (T,).
        covariance: of the prior with the first bearing in it, shape (4, 4).
        acceleration_std: sigma_M, m/s^2.

    Returns:
        Bound after each bearing, shape (T, 4, 4).
    """
    bounds = [covariance]
    for state, place, step, error in zip(path[1:], observer[1:], seconds, std[1:], strict=True):
        _, predicted = propagate(state, bounds[-1], np.asarray(step), np.asarray(acceleration_std))
        gradient = np.concatenate([sight(state[:2] - place).gradient, np.zeros(2)])
        corrected = correct_linear(state, predicted, gradient, np.zeros(()), np.asarray(error**2))
        bounds.append(corrected.covariance)
    return np.stack(bounds)


def _by_range(matrix: FloatArray, line_of_sight: Sight) -> tuple[FloatArray, FloatArray]:
    """Information in units of range along and across the sight, and their basis; in metres it is ill-conditioned."""
    basis = np.zeros_like(matrix)
    basis[:, :2, 0], basis[:, :2, 1] = line_of_sight.along, line_of_sight.across
    basis *= line_of_sight.range[:, np.newaxis, np.newaxis]
    basis[:, 2, 2] = basis[:, 3, 3] = 1.0
    return np.swapaxes(basis, -1, -2) @ matrix @ basis, basis
