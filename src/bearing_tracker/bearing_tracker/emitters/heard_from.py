# SPDX-License-Identifier: Apache-2.0
"""Keeps the places that an emitter was heard from, in memory that does not grow."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import numpy.typing as npt

from bearing_tracker.emitters.belief import Geometry

FloatArray = npt.NDArray[np.float64]

PLACES = 64
"""Places kept; when they are full each two become one for twice as many bearings, so that all of the path stays."""


def first_heard(observer: FloatArray, variance: FloatArray) -> Geometry:
    """Begin with one place.

    Args:
        observer: metres east and north, shape (n, 2).
        variance: of the first bearing, square radians, shape (n,).

    Returns:
        The geometry of one bearing.
    """
    emitters = len(observer)
    places = np.zeros((emitters, PLACES, 2))
    weight = np.zeros((emitters, PLACES))
    places[:, 0], weight[:, 0] = observer, 1.0 / variance
    one, nothing = np.ones(emitters, dtype=np.intp), np.zeros(emitters)
    return Geometry(
        time=np.zeros((emitters, PLACES)),
        observer=places,
        weight=weight,
        unrest=np.zeros((emitters, PLACES)),
        bearings=one,
        stride=one,
        heard=nothing,
        now=nothing,
        unrest_now=nothing,
        first_observer=observer,
    )


def passed(geometry: Geometry, seconds: FloatArray, acceleration_variance: FloatArray) -> Geometry:
    """Let time pass.

    Args:
        geometry: of n emitters.
        seconds: shape (n,).
        acceleration_variance: of the emitters in that time, m^2/s^4, shape (n,).

    Returns:
        The same at the later time.
    """
    return replace(
        geometry,
        now=geometry.now + seconds,
        unrest_now=geometry.unrest_now + acceleration_variance * seconds**2,
    )


def heard_again(
    geometry: Geometry, observer: FloatArray, variance: FloatArray, rows: npt.NDArray[np.intp]
) -> Geometry:
    """Add a place for those that were heard now.

    Args:
        geometry: of n emitters.
        observer: metres east and north, of the k that were heard, shape (k, 2).
        variance: of their bearings, square radians, shape (k,).
        rows: which were heard, shape (k,).

    Returns:
        The geometry with the new places.
    """
    time, places = geometry.time.copy(), geometry.observer.copy()
    weight, unrest = geometry.weight.copy(), geometry.unrest.copy()
    bearings, stride = geometry.bearings.copy(), geometry.stride.copy()
    heard = geometry.heard.copy()
    full = rows[bearings[rows] == PLACES * stride[rows]]
    if len(full):
        share = weight[full].reshape(len(full), -1, 2)
        for array in (time, places, unrest):
            array[full] = _paired(array[full], share)
        weight[full] = np.concatenate([share.sum(axis=-1), np.zeros_like(share[..., 0])], axis=1)
        stride[full] *= 2
    at = bearings[rows] // stride[rows]
    now = geometry.now[rows]
    weight[rows, at] += 1.0 / variance
    share = 1.0 / variance / weight[rows, at]
    time[rows, at] += share * (now - time[rows, at])
    unrest[rows, at] += share * (geometry.unrest_now[rows] - unrest[rows, at])
    places[rows, at] += share[:, np.newaxis] * (observer - places[rows, at])
    bearings[rows] += 1
    heard[rows] = now
    return replace(
        geometry,
        time=time,
        observer=places,
        weight=weight,
        unrest=unrest,
        bearings=bearings,
        stride=stride,
        heard=heard,
    )


def places_used(geometry: Geometry) -> int:
    """Count places that any emitter uses; they are the first ones.

    Args:
        geometry: of n emitters.

    Returns:
        Their number, one at least.
    """
    return int((-(-geometry.bearings // geometry.stride)).max(initial=1))


def _paired(values: FloatArray, weight: FloatArray) -> FloatArray:
    """Weighted means of neighbours on axis 1, then zeros; weights of shape (k, K / 2, 2)."""
    pairs = values.reshape(len(values), PLACES // 2, 2, -1)
    means = (weight[..., np.newaxis] * pairs).sum(axis=2) / weight.sum(axis=2)[..., np.newaxis]
    return np.concatenate([means, np.zeros_like(means)], axis=1).reshape(values.shape)
