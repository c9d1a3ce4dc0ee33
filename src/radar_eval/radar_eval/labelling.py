# SPDX-License-Identifier: Apache-2.0
"""Which plot came from which target: one plot a target and pass of the antenna, chosen over all of them at once."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.optimize import linear_sum_assignment
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from radar_common.frames import TWO_PI, wrap_pi, wrap_two_pi
from radar_eval.bag_tables import TimedRows
from radar_eval.truth_paths import Looks, TruthPaths

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]

FALSE = -1

_SAME_TIME = 1e-6
_UNPAIRED = 1e6
# Where plot and truth are one report, only the report's own limits bound their difference (I048/130, and a margin).
_SAME_TIME_RANGE, _SAME_TIME_AZIMUTH = 1000.0, np.radians(3.0)


@dataclass(frozen=True, slots=True)
class Gates:
    """How far a plot may lie from a target to be its plot.

    Attributes:
        range: m.
        azimuth: rad.
        time: s, from the antenna's pass over the target to the plot.
    """

    range: float
    azimuth: float
    time: float


@dataclass(frozen=True, slots=True)
class Labels:
    """Which target each plot came from.

    Attributes:
        target: index of the target or FALSE, shape (plots,).
        plot_of_look: index of the plot of each pass over a target, or FALSE, shape (looks,).
    """

    target: IntArray
    plot_of_look: IntArray


def label_plots(plots: TimedRows, paths: TruthPaths, looks: Looks, gates: Gates) -> Labels:
    """Give plots to targets so that as many passes as possible have a plot, and these fit best.

    Args:
        plots: rows of dtype PLOT, shape (n,).
        paths: of the targets.
        looks: passes of the antenna over the targets, shape (m,).
        gates: how far they may be apart.

    Returns:
        The labels.
    """
    look, plot, cost = _candidates(plots, paths, looks, gates)
    chosen = assign(look, plot, cost)
    target = np.full(len(plots), FALSE)
    target[plot[chosen]] = looks.target[look[chosen]]
    plot_of_look = np.full(len(looks), FALSE)
    plot_of_look[look[chosen]] = plot[chosen]
    return Labels(target, plot_of_look)


def assign(row: IntArray, column: IntArray, cost: FloatArray) -> npt.NDArray[np.bool_]:
    """Choose pairs so that no row and no column is used twice, at the smallest cost for the largest number.

    Args:
        row: index of each pair, shape (n,).
        column: index of each pair, shape (n,).
        cost: of each pair, within [0, 10), shape (n,).

    Returns:
        Which pairs are chosen, shape (n,).
    """
    if not len(row):
        return np.zeros(0, dtype=bool)
    rows = int(row.max()) + 1
    nodes = rows + int(column.max()) + 1
    graph = coo_matrix((np.ones(len(row)), (row, rows + column)), shape=(nodes, nodes))
    _, component = connected_components(graph, directed=False)
    pairs_in = np.bincount(component[row])[component[row]]
    chosen = pairs_in == 1
    contested = np.flatnonzero(~chosen)
    contested = contested[np.argsort(component[row[contested]], kind="stable")]
    groups = np.split(contested, np.flatnonzero(np.diff(component[row[contested]])) + 1)
    # Few pairs are contested, and they fall apart into small groups: each is solved by itself.
    for group in groups if len(contested) else ():
        _, i = np.unique(row[group], return_inverse=True)
        _, j = np.unique(column[group], return_inverse=True)
        matrix = np.full((i.max() + 1, j.max() + 1), _UNPAIRED)
        matrix[i, j] = cost[group]
        taken = np.zeros(matrix.shape, dtype=bool)
        taken[linear_sum_assignment(matrix)] = True
        chosen[group] = taken[i, j]
    return chosen


def _candidates(
    plots: TimedRows, paths: TruthPaths, looks: Looks, gates: Gates
) -> tuple[IntArray, IntArray, FloatArray]:
    widest = np.array(
        [
            max(gates.range, _SAME_TIME_RANGE),
            max(gates.azimuth, float(_SAME_TIME_AZIMUTH)),
            gates.time,
        ]
    )
    if not len(looks) or not len(plots):
        return np.zeros(0, np.int64), np.zeros(0, np.int64), np.zeros(0)
    circle = np.array([0.0, TWO_PI / widest[1], 0.0])
    start = min(float(plots.time.min()), float(looks.time.min()))
    near = cKDTree(_scaled(looks.range, looks.azimuth, looks.time - start, widest), boxsize=circle)
    pairs = near.sparse_distance_matrix(
        cKDTree(
            _scaled(plots.rows["range"], plots.rows["azimuth"], plots.time - start, widest),
            boxsize=circle,
        ),
        1.0,
        p=np.inf,
        output_type="ndarray",
    )
    look, plot = pairs["i"].astype(np.int64), pairs["j"].astype(np.int64)
    target, time = looks.target[look], plots.time[plot]
    present, distance, azimuth = paths.polar_at(
        target, np.clip(time, paths.begin[target], paths.end[target])
    )
    range_error = plots.rows["range"][plot] - distance
    azimuth_error = wrap_pi(plots.rows["azimuth"][plot] - azimuth)
    misfit = np.hypot(range_error / gates.range, azimuth_error / gates.azimuth)
    same = paths.rows_near(target, time) < _SAME_TIME
    within = np.hypot(range_error / _SAME_TIME_RANGE, azimuth_error / _SAME_TIME_AZIMUTH) <= 1.0
    taken = present & (misfit <= 1.0) | same & within
    # A pair of one report costs less than any other pair, whatever its misfit.
    cost = np.where(same, misfit / (1.0 + misfit), 1.0 + misfit)
    return look[taken], plot[taken], cost[taken]


def _scaled(
    distance: FloatArray, azimuth: FloatArray, time: FloatArray, widest: FloatArray
) -> FloatArray:
    return np.stack([distance, wrap_two_pi(azimuth), time], axis=1) / widest
