# SPDX-License-Identifier: Apache-2.0
"""The one-to-one assignment with the greatest sum of gains."""

from __future__ import annotations

import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import min_weight_full_bipartite_matching

from secondary_proc.association.interface import FloatArray, GateGraph, IndexArray

_FIRST = 1e4
"""More than any sum of gains that a track served first could cost the others."""


def global_nearest_neighbour(graph: GateGraph) -> IndexArray:
    """Assign plots to tracks so that the sum of gains is greatest.

    Edges whose track and plot have no other edge are taken as they are. The rest goes to one sparse assignment, in
    which connected components of the graph do not meet; a private dummy plot for each track lets it stay alone.
    Source: Jonker and Volgenant 1987, as scipy implements it for sparse graphs.

    Args:
        graph: edges with positive gains.

    Returns:
        Indices of the chosen edges, ascending.
    """
    if not len(graph.track):
        return np.zeros(0, np.intp)
    on_track, on_plot = np.bincount(graph.track), np.bincount(graph.plot)
    if on_track.max() == on_plot.max() == 1:
        return np.arange(len(graph.track))
    alone = (on_track[graph.track] == 1) & (on_plot[graph.plot] == 1)
    contested = np.flatnonzero(~alone)
    chosen = contested[
        _assign(
            graph.track[contested],
            graph.plot[contested],
            graph.gain[contested] + _FIRST * graph.first[contested],
        )
    ]
    return np.sort(np.concatenate([np.flatnonzero(alone), chosen]))


def _assign(track: IndexArray, plot: IndexArray, gain: FloatArray) -> IndexArray:
    tracks, row = np.unique(track, return_inverse=True)
    plots, column = np.unique(plot, return_inverse=True)
    count = len(tracks)
    # The solver takes stored weights only, and none of them may be zero.
    alone = float(gain.max()) + 1.0
    weights = csr_array(
        (
            np.concatenate([alone - gain, np.full(count, alone)]),
            # The solver of SciPy 1.11 takes 32-bit indices only.
            (
                np.concatenate([row, np.arange(count)]).astype(np.int32),
                np.concatenate([column, len(plots) + np.arange(count)]).astype(np.int32),
            ),
        ),
        shape=(count, len(plots) + count),
    )
    rows, columns = min_weight_full_bipartite_matching(weights)
    real = columns < len(plots)
    key = row * len(plots) + column
    order = np.argsort(key)
    wanted = rows[real] * len(plots) + columns[real]
    return order[np.searchsorted(key[order], wanted)]
