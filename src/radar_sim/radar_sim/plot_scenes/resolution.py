# SPDX-License-Identifier: Apache-2.0
"""Targets too near each other give one plot."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from radar_common.frames import TWO_PI, wrap_two_pi

FloatArray = npt.NDArray[np.float64]


def merge(
    distance: FloatArray,
    azimuth: FloatArray,
    power: FloatArray,
    *,
    range_resolution: float,
    azimuth_resolution: float,
) -> tuple[npt.NDArray[np.intp], FloatArray, FloatArray]:
    """Merge plots of one scan that lie within a resolution cell of each other.

    A merged plot lies in the centre of power of its parts.

    Args:
        distance: m, shape (n,).
        azimuth: rad, shape (n,).
        power: shape (n,).
        range_resolution: m, targets apart by less are not resolved; 0 resolves all.
        azimuth_resolution: rad, the same across; only pairs within both are merged.

    Returns:
        (strongest, range, azimuth): index of the strongest part of each plot that is left, and where that plot lies,
        each shape (m,), m <= n.
    """
    number = len(distance)
    everything = np.arange(number)
    if number < 2 or range_resolution <= 0.0 or azimuth_resolution <= 0.0:
        return everything, distance, azimuth
    scaled = np.stack(
        [distance / range_resolution, wrap_two_pi(azimuth) / azimuth_resolution], axis=1
    )
    # Ranges are not periodic: a box that none of them can cross leaves them alone.
    box = [2.0 * scaled[:, 0].max() + 2.0, TWO_PI / azimuth_resolution]
    pairs = cKDTree(scaled, boxsize=box).query_pairs(1.0, p=np.inf, output_type="ndarray")
    if not len(pairs):
        return everything, distance, azimuth
    graph = coo_matrix((np.ones(len(pairs)), pairs.T), shape=(number, number))
    groups, group = connected_components(graph, directed=False)
    weight = np.bincount(group, power, groups)
    centre = np.bincount(group, power * distance, groups) / weight
    direction = np.bincount(group, power * np.cos(azimuth), groups) + 1j * np.bincount(
        group, power * np.sin(azimuth), groups
    )
    # In rising order of power, so that the last one written to a group is its strongest.
    strongest = np.empty(groups, dtype=np.intp)
    rising = np.argsort(power, kind="stable")
    strongest[group[rising]] = rising
    return strongest, centre, wrap_two_pi(np.angle(direction))
