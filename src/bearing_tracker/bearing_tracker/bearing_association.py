# SPDX-License-Identifier: Apache-2.0
"""Which bearing belongs to which target: gates around the circle, then the likeliest one-to-one assignment."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from radar_common import assignment
from radar_common.frames import TWO_PI, wrap_pi, wrap_two_pi

FloatArray = npt.NDArray[np.float64]
IndexArray = npt.NDArray[np.intp]

_MOST_EDGES = 2_000_000
_FIRST = 1e4


@dataclass(frozen=True, slots=True)
class Directions:
    """Azimuths with their errors.

    Attributes:
        azimuth: radians, shape (n,).
        std: radians, shape (n,).
    """

    azimuth: FloatArray
    std: FloatArray


@dataclass(frozen=True, slots=True)
class Edges:
    """Pairs that a gate lets through, one row a pair.

    Attributes:
        target: number of the target, shape (k,).
        bearing: number of the bearing, shape (k,).
        cost: negative logarithm of the likelihood, but for a constant, shape (k,).
    """

    target: IndexArray
    bearing: IndexArray
    cost: FloatArray


def gate(targets: Directions, bearings: Directions, sigmas: float) -> Edges:
    """Find the bearings in each target's gate.

    The bearings are sorted once around the circle, so that a target looks only at those near it.

    Args:
        targets: where they are expected.
        bearings: what was reported.
        sigmas: half width of the gate in standard deviations of the difference.

    Returns:
        Pairs in order of the targets. Of more than two million the targets that come last get none.
    """
    none = np.zeros(0, np.intp)
    if not len(targets.azimuth) or not len(bearings.azimuth):
        return Edges(none, none, np.zeros(0))
    order = np.argsort(bearings.azimuth, kind="stable")
    turn = bearings.azimuth[order]
    circle = np.concatenate([turn - TWO_PI, turn, turn + TWO_PI])
    reach = sigmas * np.hypot(targets.std, bearings.std.max())
    # Half a turn either way is all there is; a hair less, lest a bearing be met from both sides.
    reach = np.minimum(reach, np.nextafter(np.pi, 0.0))
    centre = wrap_two_pi(targets.azimuth)
    begin = np.searchsorted(circle, centre - reach, side="left")
    length = np.searchsorted(circle, centre + reach, side="right") - begin
    length[np.cumsum(length) > _MOST_EDGES] = 0
    target = np.repeat(np.arange(len(begin)), length)
    ends = np.cumsum(length)
    position = np.arange(ends[-1]) + np.repeat(begin - (ends - length), length)
    bearing = order[position % len(turn)]
    variance = targets.std[target] ** 2 + bearings.std[bearing] ** 2
    difference = wrap_pi(bearings.azimuth[bearing] - centre[target])
    distance = difference**2 / variance
    inside = distance <= sigmas**2
    cost = 0.5 * (distance + np.log(variance))
    return Edges(target[inside], bearing[inside], cost[inside])


def assign(edges: Edges, rank: npt.NDArray[np.integer] | None = None) -> IndexArray:
    """Choose pairs so that their common likelihood, held against that of the unlikeliest pair, is greatest.

    Args:
        edges: of the gates.
        rank: pairs of a higher one come first whatever their likelihood, shape (k,); None if all are equal.

    Returns:
        Indices of the chosen pairs, ascending; no target and no bearing stands in two of them.
    """
    gain = edges.cost.max(initial=0.0) + 1.0 - edges.cost
    if rank is not None:
        gain += _FIRST * rank
    return assignment.assign(edges.target, edges.bearing, gain)
