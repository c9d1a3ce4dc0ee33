# SPDX-License-Identifier: Apache-2.0
"""Keeps the places that an emitter was heard from, in memory that does not grow."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import numpy.typing as npt

from bearing_tracker.emitters.belief import Geometry

FloatArray = npt.NDArray[np.float64]

PLACES = 64
"""Places kept; when they are full each two neighbours become one, so that the whole path stays covered."""


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
        np.zeros((emitters, PLACES)), places, weight, one, one, nothing, nothing, observer
    )


def passed(geometry: Geometry, seconds: FloatArray) -> Geometry:
    """Let time pass.

    Args:
        geometry: of n emitters.
        seconds: shape (n,).

    Returns:
        The same at the later time.
    """
    return replace(geometry, now=geometry.now + seconds)


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
    time, places, weight = geometry.time.copy(), geometry.observer.copy(), geometry.weight.copy()
    used, bearings, heard = (
        geometry.places.copy(),
        geometry.bearings.copy(),
        geometry.heard.copy(),
    )
    full = rows[used[rows] == PLACES]
    if len(full):
        _halve(time, places, weight, full)
        used[full] = PLACES // 2
    at = used[rows]
    time[rows, at], places[rows, at], weight[rows, at] = (
        geometry.now[rows],
        observer,
        1.0 / variance,
    )
    used[rows] += 1
    bearings[rows] += 1
    heard[rows] = geometry.now[rows]
    return Geometry(
        time, places, weight, used, bearings, heard, geometry.now, geometry.first_observer
    )


def _halve(
    time: FloatArray, places: FloatArray, weight: FloatArray, rows: npt.NDArray[np.intp]
) -> None:
    """Merge each two neighbours of some emitters, in place, by their weights."""
    pairs = weight[rows].reshape(len(rows), -1, 2)
    total = pairs.sum(axis=-1)
    share = pairs / total[..., np.newaxis]
    half = PLACES // 2
    merged_time = (share * time[rows].reshape(len(rows), half, 2)).sum(axis=-1)
    merged_places = (share[..., np.newaxis] * places[rows].reshape(len(rows), half, 2, 2)).sum(
        axis=2
    )
    for array, merged in ((time, merged_time), (places, merged_places), (weight, total)):
        array[rows, :half] = merged
        array[rows, half:] = 0.0
