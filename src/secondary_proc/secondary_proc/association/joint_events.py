# SPDX-License-Identifier: Apache-2.0
"""Probabilities that plots belong to tracks, over all joint events of a gate graph.

A joint event gives each plot to one track at most and each track one plot at most; its probability is the product of
the ratios of its edges. Source: Bar-Shalom and Fortmann 1988, § 9.3; the events are summed as a network whose nodes
are the sets of plots used so far (Horridge and Maskell 2006), not one by one.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from secondary_proc.association.interface import FloatArray, IndexArray

MOST_SETS = 8
"""Tracks or plots, whichever are fewer, of a component that is still summed: 2^8 sets."""
MOST_ROWS = 64
_GREATEST_GAIN = 30.0


def joint_probabilities(track: IndexArray, plot: IndexArray, gain: FloatArray) -> FloatArray:
    """Sum over joint events.

    Args:
        track: number of the track, a row an edge, shape (n,).
        plot: number of the plot, shape (n,).
        gain: logarithm of the ratio of likelihoods, the plot being the track's against both being alone, shape (n,).

    Returns:
        Probability that the edge is true, shape (n,); NaN in components that are too large.
    """
    probability = np.full(len(track), np.nan)
    ratio = np.exp(np.minimum(gain, _GREATEST_GAIN))
    for edges, row, column in _alike(track, plot):
        matrices = np.zeros((len(edges), int(row.max()) + 1, int(column.max()) + 1))
        which = np.arange(len(edges))[:, None]
        matrices[which, row, column] = ratio[edges]
        if matrices.shape[1] < matrices.shape[2]:
            marginal = marginals(matrices.transpose(0, 2, 1)).transpose(0, 2, 1)
        else:
            marginal = marginals(matrices)
        probability[edges] = marginal[which, row, column]
    return probability


def marginals(ratio: FloatArray) -> FloatArray:
    """Probability of each pair of a row and a column, over all ways to pair some of them.

    Args:
        ratio: what a pair multiplies the probability by, zero where it is impossible, shape (k, rows, columns) with
            few columns: time and memory grow as 2^columns.

    Returns:
        Probabilities, same shape.
    """
    count, rows, columns = ratio.shape
    sets = np.arange(2**columns)
    without = np.array([sets[(sets >> column) & 1 == 0] for column in range(columns)])
    added = without + (1 << np.arange(columns))[:, None]
    forward = np.zeros((rows + 1, count, len(sets)))
    forward[0, :, 0] = 1.0
    for row in range(rows):
        forward[row + 1] = forward[row]
        for column in range(columns):
            step = ratio[:, row, column, None] * forward[row][:, without[column]]
            forward[row + 1][:, added[column]] += step
    backward = np.ones((count, len(sets)))
    out = np.empty_like(ratio)
    for row in range(rows - 1, -1, -1):
        paths = (forward[row][:, without] * backward[:, added]).sum(axis=2)
        out[:, row] = ratio[:, row] * paths
        previous = backward.copy()
        for column in range(columns):
            step = ratio[:, row, column, None] * backward[:, added[column]]
            previous[:, without[column]] += step
        backward = previous
    out /= backward[:, 0, None, None]
    return out


def _alike(
    track: IndexArray, plot: IndexArray
) -> Iterator[tuple[IndexArray, npt.NDArray[np.intp], npt.NDArray[np.intp]]]:
    """Components of equal shape together: edges, rows and columns of each, shape (components, edges of one)."""
    tracks, row = np.unique(track, return_inverse=True)
    plots, column = np.unique(plot, return_inverse=True)
    total = len(tracks) + len(plots)
    links = coo_array(
        (np.ones(len(track)), (row.astype(np.int32), (len(tracks) + column).astype(np.int32))),
        shape=(total, total),
    )
    component = connected_components(links, directed=False)[1]
    of_edge = component[row]
    rows, columns = _place(component[: len(tracks)]), _place(component[len(tracks) :])
    sizes = np.stack(
        [
            np.bincount(of_edge, minlength=component.max(initial=-1) + 1),
            np.bincount(component[: len(tracks)], minlength=component.max(initial=-1) + 1),
            np.bincount(component[len(tracks) :], minlength=component.max(initial=-1) + 1),
        ],
        axis=1,
    )
    order = np.argsort(of_edge, kind="stable")
    begin = np.cumsum(sizes[:, 0]) - sizes[:, 0]
    for shape in np.unique(sizes, axis=0):
        if shape[1:].min() > MOST_SETS or shape[1:].max() > MOST_ROWS:
            continue
        which = np.flatnonzero((sizes == shape).all(axis=1))
        edges = order[begin[which, None] + np.arange(shape[0])]
        yield edges, rows[row[edges]], columns[column[edges]]


def _place(component: npt.NDArray[np.integer]) -> IndexArray:
    """Number of each node within its component, shape (n,)."""
    order = np.argsort(component, kind="stable")
    size = np.bincount(component)
    begin = np.cumsum(size) - size
    place = np.empty(len(component), np.intp)
    place[order] = np.arange(len(component)) - begin[component[order]]
    return place
