# SPDX-License-Identifier: Apache-2.0
"""Each track takes the plot that suits it best; of two tracks that want the same plot the one that it suits better.

The book selects for one track at a time and does not say what happens when two tracks select the same plot. Here the
best pair of all is settled first, then the best of those that are left, so that the loser takes the next plot of its
gate that is free. Source of the two measures: Kuzmin 1967, § 4.7.3, (4.141) and (4.142).
"""

from __future__ import annotations

import numpy as np

from secondary_proc.association.interface import FloatArray, GateGraph, IndexArray


def nearest(graph: GateGraph) -> IndexArray:
    """Give each track the plot of the least normalised distance.

    Args:
        graph: edges.

    Returns:
        Indices of the chosen edges, ascending.
    """
    return _best_first(graph, -graph.distance_squared)


def likelihood(graph: GateGraph) -> IndexArray:
    """Give each track the plot of the greatest likelihood against a false one.

    It differs from `nearest` where plots are not equally accurate, false plots not equally dense, or strength counts.

    Args:
        graph: edges.

    Returns:
        Indices of the chosen edges, ascending.
    """
    return _best_first(graph, graph.gain)


def _best_first(graph: GateGraph, merit: FloatArray) -> IndexArray:
    order = np.lexsort((-merit, ~graph.first))
    chosen = []
    while len(order):
        track, plot = graph.track[order], graph.plot[order]
        best_of_track, best_of_plot = np.zeros((2, len(order)), bool)
        best_of_track[np.unique(track, return_index=True)[1]] = True
        best_of_plot[np.unique(plot, return_index=True)[1]] = True
        # What is best for both is what settling one pair after the other would choose, many at once.
        settled = best_of_track & best_of_plot
        chosen.append(order[settled])
        free = ~np.isin(track, track[settled]) & ~np.isin(plot, plot[settled])
        order = order[free]
    return np.sort(np.concatenate(chosen)) if chosen else np.zeros(0, np.intp)
