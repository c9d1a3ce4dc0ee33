# SPDX-License-Identifier: Apache-2.0
"""The one-to-one assignment of plots to tracks with the greatest sum of gains."""

from __future__ import annotations

from radar_common.assignment import assign
from secondary_proc.association.interface import GateGraph, IndexArray

_FIRST = 1e4
"""More than any sum of gains that a track served first could cost the others."""


def global_nearest_neighbour(graph: GateGraph) -> IndexArray:
    """Assign plots to tracks so that the sum of gains is greatest.

    Args:
        graph: edges with positive gains.

    Returns:
        Indices of the chosen edges, ascending.
    """
    return assign(graph.track, graph.plot, graph.gain + _FIRST * graph.first)
