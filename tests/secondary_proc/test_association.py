# SPDX-License-Identifier: Apache-2.0
"""Every association rule against its definition, tried out edge by edge."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from secondary_proc.association import ASSOCIATIONS, GateGraph

EDGE_BY_EDGE = {"nearest": lambda g: -g.distance_squared, "likelihood": lambda g: g.gain}


def graph_of(track, plot, gain, distance_squared=None, first=None):
    track, plot, gain = np.asarray(track), np.asarray(plot), np.asarray(gain, float)
    if distance_squared is None:
        distance_squared = 20.0 - gain
    if first is None:
        first = np.zeros(len(track), bool)
    return GateGraph(track, plot, gain, np.asarray(distance_squared, float), np.asarray(first))


def best_gain(graph, tracks):
    """Greatest sum of gains over all one-to-one assignments, by trying all."""
    choices = [[None, *np.flatnonzero(graph.track == track)] for track in range(tracks)]
    best = 0.0
    for edges in product(*choices):
        chosen = [edge for edge in edges if edge is not None]
        plots = graph.plot[chosen]
        if len(set(plots.tolist())) == len(chosen):
            best = max(best, float(graph.gain[chosen].sum() + 1e4 * graph.first[chosen].sum()))
    return best


def best_first(graph, merit):
    """Edges by merit, one after the other, those of preferred tracks before all others."""
    chosen, tracks, plots = [], set(), set()
    for edge in sorted(range(len(merit)), key=lambda e: (not graph.first[e], -merit[e])):
        track, plot = int(graph.track[edge]), int(graph.plot[edge])
        if track not in tracks and plot not in plots:
            chosen.append(edge)
            tracks.add(track)
            plots.add(plot)
    return sorted(chosen)


@st.composite
def graphs(draw):
    tracks, plots = draw(st.integers(1, 5)), draw(st.integers(1, 5))
    inside = draw(st.lists(st.booleans(), min_size=tracks * plots, max_size=tracks * plots))
    track, plot = np.nonzero(np.reshape(inside, (tracks, plots)))
    size = {"min_size": len(track), "max_size": len(track), "unique": True}
    gains = draw(st.lists(st.floats(1e-3, 20.0), **size))
    distances = draw(st.lists(st.floats(0.0, 12.0), **size))
    first = np.array(draw(st.lists(st.booleans(), min_size=tracks, max_size=tracks)))
    return graph_of(track, plot, gains, distances, first[track])


@pytest.mark.parametrize("name", ASSOCIATIONS)
@settings(max_examples=50)
@given(graph=graphs())
def test_each_rule_does_as_it_is_defined(name, graph):
    edges = ASSOCIATIONS[name](graph)
    tracks, plots = graph.track[edges].tolist(), graph.plot[edges].tolist()
    assert len(set(tracks)) == len(set(plots)) == len(edges)
    assert list(edges) == sorted(edges)
    for edge in range(len(graph.track)):
        assert graph.track[edge] in tracks or graph.plot[edge] in plots, "left alone for nothing"
    if name in EDGE_BY_EDGE:
        assert list(edges) == best_first(graph, EDGE_BY_EDGE[name](graph))
    else:
        gained = graph.gain[edges].sum() + 1e4 * graph.first[edges].sum()
        assert gained == pytest.approx(best_gain(graph, 5), rel=1e-9)


@pytest.mark.parametrize("name", ASSOCIATIONS)
def test_numbers_of_tracks_may_have_gaps(name):
    graph = graph_of([700, 9000, 9000], [5, 5, 100], [3.0, 2.9, 2.5])
    assert list(ASSOCIATIONS[name](graph)) == [0, 2]


@pytest.mark.parametrize("name", ASSOCIATIONS)
def test_preferred_tracks_are_served_first(name):
    graph = graph_of([0, 1], [0, 0], [9.0, 1.0], first=[False, True])
    assert list(ASSOCIATIONS[name](graph)) == [1]


@pytest.mark.parametrize("name", ASSOCIATIONS)
def test_no_gate_holds_a_plot(name):
    none = np.zeros(0, np.intp)
    assert len(ASSOCIATIONS[name](graph_of(none, none, none))) == 0


def test_the_rules_differ_where_they_should():
    # Two tracks and two plots: the first track's best plot is all that the second can have.
    graph = graph_of([0, 0, 1], [0, 1, 0], [5.0, 4.0, 4.5], [2.0, 1.0, 3.0])
    chosen = {name: list(ASSOCIATIONS[name](graph)) for name in ASSOCIATIONS}
    assert chosen["global_nearest_neighbour"] == chosen["nearest"] == [1, 2]
    assert chosen["likelihood"] == [0]
