# SPDX-License-Identifier: Apache-2.0
"""Every association rule finds the assignment with the greatest gain."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from secondary_proc.association import ASSOCIATIONS, GateGraph


def best_gain(graph, tracks):
    """Greatest sum of gains over all one-to-one assignments, by trying all."""
    choices = [[None, *np.flatnonzero(graph.track == track)] for track in range(tracks)]
    best = 0.0
    for edges in product(*choices):
        chosen = [edge for edge in edges if edge is not None]
        plots = graph.plot[chosen]
        if len(set(plots.tolist())) == len(chosen):
            best = max(best, float(graph.gain[chosen].sum()))
    return best


@pytest.mark.parametrize("name", ASSOCIATIONS)
@given(data=st.data())
def test_the_sum_of_gains_is_the_greatest_possible(name, data):
    tracks, plots = data.draw(st.integers(1, 5)), data.draw(st.integers(1, 5))
    inside = data.draw(st.lists(st.booleans(), min_size=tracks * plots, max_size=tracks * plots))
    track, plot = np.nonzero(np.reshape(inside, (tracks, plots)))
    gains = data.draw(st.lists(st.floats(1e-3, 20.0), min_size=len(track), max_size=len(track)))
    graph = GateGraph(track, plot, np.array(gains, float))
    edges = ASSOCIATIONS[name](graph)
    assert len(set(track[edges].tolist())) == len(edges)
    assert len(set(plot[edges].tolist())) == len(edges)
    assert list(edges) == sorted(edges)
    assert graph.gain[edges].sum() == pytest.approx(best_gain(graph, tracks), rel=1e-9)


@pytest.mark.parametrize("name", ASSOCIATIONS)
def test_numbers_of_tracks_may_have_gaps(name):
    graph = GateGraph(np.array([700, 9000, 9000]), np.array([5, 5, 100]), np.array([3.0, 4.0, 2.5]))
    assert list(ASSOCIATIONS[name](graph)) == [0, 2]


@pytest.mark.parametrize("name", ASSOCIATIONS)
def test_no_gate_holds_a_plot(name):
    none = np.zeros(0, np.intp)
    assert len(ASSOCIATIONS[name](GateGraph(none, none, np.zeros(0)))) == 0
