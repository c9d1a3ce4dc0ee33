# SPDX-License-Identifier: Apache-2.0
"""Gates find what a look at every pair finds, and the assignment is the best there is."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import linear_sum_assignment

from bearing_tracker.bearing_association import Directions, assign, gate
from radar_common.frames import wrap_pi

SIZES = st.integers(0, 12)


def some(random, count, spread):
    return Directions(random.uniform(0.0, 2 * np.pi, count), random.uniform(0.01, spread, count))


@given(SIZES, SIZES, st.integers(0, 2**31), st.sampled_from([0.05, 0.5, 3.0]))
def test_the_gate_finds_what_a_look_at_every_pair_finds(targets, bearings, seed, spread):
    random = np.random.default_rng(seed)
    expected, reported = some(random, targets, spread), some(random, bearings, 0.1)
    edges = gate(expected, reported, 3.0)
    difference = wrap_pi(reported.azimuth[None] - expected.azimuth[:, None])
    variance = expected.std[:, None] ** 2 + reported.std[None] ** 2
    wanted = set(zip(*np.nonzero(difference**2 <= 9.0 * variance), strict=True))
    pairs = list(zip(edges.target.tolist(), edges.bearing.tolist(), strict=True))
    assert len(pairs) == len(set(pairs))
    assert set(pairs) == wanted
    costs = 0.5 * (difference**2 / variance + np.log(variance))
    assert edges.cost == pytest.approx(costs[edges.target, edges.bearing])


@given(SIZES, SIZES, st.integers(0, 2**31))
def test_no_other_assignment_is_likelier(targets, bearings, seed):
    random = np.random.default_rng(seed)
    edges = gate(some(random, targets, 0.5), some(random, bearings, 0.1), 3.0)
    chosen = assign(edges)
    assert len(set(edges.target[chosen])) == len(set(edges.bearing[chosen])) == len(chosen)
    if not len(edges.cost):
        return
    gain = edges.cost.max() + 1.0 - edges.cost
    table = np.zeros((targets, bearings))
    table[edges.target, edges.bearing] = gain
    best = table[linear_sum_assignment(table, maximize=True)].sum()
    assert gain[chosen].sum() == pytest.approx(best)


def test_the_preferred_come_first():
    edges = gate(
        Directions(np.array([1.0, 1.02]), np.array([0.01, 0.01])),
        Directions(np.array([1.0]), np.array([0.01])),
        4.0,
    )
    assert edges.target[assign(edges)].tolist() == [0]
    assert edges.target[assign(edges, (edges.target == 1).astype(int))].tolist() == [1]


def test_north_is_no_border():
    edges = gate(
        Directions(np.array([0.01]), np.array([0.02])),
        Directions(np.array([2 * np.pi - 0.01]), np.array([0.01])),
        3.0,
    )
    assert len(edges.target) == 1
