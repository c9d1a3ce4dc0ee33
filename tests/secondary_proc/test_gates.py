# SPDX-License-Identifier: Apache-2.0
"""Gates hold exactly the plots that the predicted error says, however they are searched."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from secondary_proc import gates, neighbours
from secondary_proc.gates import gate
from secondary_proc.neighbours import neighbour_pairs
from secondary_proc.opening import opened_tracks
from secondary_proc.plots import POLAR_ROWS, Plots
from secondary_proc.track_store import PREDICTED_ROWS, Columns

SIGMAS = 3.5
DENSITY = 30.0


def plots_at(random, count, begin, end, spread):
    polar = np.zeros((POLAR_ROWS, count))
    polar[0] = np.sort(random.uniform(begin, end, count))
    polar[1] = random.uniform(40e3, 40e3 + spread, count)
    polar[2] = random.uniform(0.5, 0.5 + spread / 40e3, count)
    polar[3], polar[4] = 20.0, 0.002
    return Plots.from_polar(polar)


def tracks_of(random, count, spread):
    first = plots_at(random, count, 0.0, 1.0, spread)
    second = plots_at(random, count, 4.0, 5.0, spread)
    # Flights of up to 300 m/s rather than pairs of anything.
    velocity = random.uniform(-200.0, 200.0, (count, 2))
    step = velocity * (second.time - first.time)[:, None]
    second = Plots.at(second.time, first.position + step, second.covariance)
    return opened_tracks(first, second, 0.3, np.dtype(float))


def by_brute_force(tracks, plots, shortest):
    """One pair at a time, with matrices: Kuzmin 1967, (4.141)."""
    found = {}
    for i in range(len(tracks)):
        for j in range(len(plots)):
            dt = plots.time[j] - tracks.time[i]
            if dt < shortest:
                continue
            matrix = np.eye(4)
            matrix[0, 2] = matrix[1, 3] = dt
            covariance = (matrix @ tracks.covariance[i] @ matrix.T)[:2, :2]
            covariance = covariance + np.eye(2) * DENSITY * dt**3 / 3 + plots.covariance[j]
            difference = plots.position[j] - (matrix @ tracks.state[i])[:2]
            distance = difference @ np.linalg.solve(covariance, difference)
            if distance <= SIGMAS**2:
                found[i, j] = distance, np.linalg.det(covariance)
    return found


@pytest.mark.parametrize(
    ("dense", "few"), [(0, 0), (10**9, 0), (0, 10**9)], ids=["by cells", "by matrix", "all pairs"]
)
@given(
    seed=st.integers(0, 2**32 - 1),
    tracks=st.integers(1, 25),
    plots=st.integers(1, 25),
    spread=st.sampled_from([300.0, 3e3, 60e3]),
)
def test_gates_hold_what_brute_force_finds(dense, few, seed, tracks, plots, spread):
    random = np.random.default_rng(seed)
    old, new = tracks_of(random, tracks, spread), plots_at(random, plots, 7.5, 8.5, spread)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(neighbours, "_DENSE", dense)
        patch.setattr(gates, "_FEW_PAIRS", few)
        gated = gate(
            old.numbers[:PREDICTED_ROWS],
            new,
            sigmas=SIGMAS,
            noise_density=np.full(tracks, DENSITY),
            shortest=3.0,
        )
    expected = by_brute_force(old, new, 3.0)
    found = {
        (int(i), int(j)): (d, s)
        for i, j, d, s in zip(
            gated.track, gated.plot, gated.distance_squared, gated.determinant, strict=True
        )
    }
    assert found.keys() == expected.keys()
    for pair, values in expected.items():
        np.testing.assert_allclose(found[pair], values, rtol=1e-6)


def test_gate_of_no_track_is_empty():
    random = np.random.default_rng(0)
    plots = plots_at(random, 3, 0.0, 1.0, 1e3)
    empty = Columns.zeros(0, np.dtype(float)).numbers[:PREDICTED_ROWS]
    gated = gate(empty, plots, sigmas=SIGMAS, noise_density=np.zeros(0), shortest=3.0)
    assert len(gated.track) == 0


@pytest.mark.parametrize("dense", [0, 10**9], ids=["by cells", "by matrix"])
@given(
    seed=st.integers(0, 2**32 - 1),
    first=st.integers(1, 40),
    second=st.integers(1, 40),
    radius=st.floats(1e-3, 2e5),
)
def test_neighbours_are_all_that_are_near(dense, seed, first, second, radius):
    random = np.random.default_rng(seed)
    a, b = random.uniform(-1e5, 1e5, (first, 2)), random.uniform(-1e5, 1e5, (second, 2))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(neighbours, "_DENSE", dense)
        i, j, skipped = neighbour_pairs(a, b, radius, 10**6)
    assert skipped == 0
    near = np.abs(a[:, None] - b[None]).max(axis=2) <= radius
    assert sorted(zip(i.tolist(), j.tolist(), strict=True)) == [
        tuple(pair) for pair in np.argwhere(near).tolist()
    ]


def test_neighbours_beyond_the_limit_are_left_out_and_told():
    points = np.zeros((200, 2))
    i, _, skipped = neighbour_pairs(points, points, 1.0, 50 * 200)
    assert skipped == 150
    assert set(i.tolist()) == set(range(50))
