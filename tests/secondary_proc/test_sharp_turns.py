# SPDX-License-Identifier: Apache-2.0
"""Gates that open for sharp turns: whose, how far, and that nothing usual is taken from anybody by them."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from radar_common.tables import TrackStatus
from secondary_proc.gating import SharpTurns, usual_first
from secondary_proc.motion import noise_density
from secondary_proc.parameters import TrackerParameters
from secondary_proc.smoothing import SMOOTHERS
from secondary_proc.smoothing.interface import Measured
from secondary_proc.track_store import PREDICTED_ROWS, Columns
from secondary_proc.tracker import Tracker

PERIOD, SPEED = 4.0, 250.0


def test_gates_open_as_far_as_a_turn_at_that_speed_goes():
    tracks = Columns.zeros(5, np.dtype(float))
    tracks.state[:, 2] = [250.0, 10.0, 250.0, 250.0, 250.0]
    tracks.covariance[4, 2, 2] = tracks.covariance[4, 3, 3] = 60.0**2
    confirmed = np.array([True, True, False, True, True])
    misses = np.array([0, 0, 0, 1, 1])
    usual = noise_density(8.0)
    density = SharpTurns(0.2, usual, PERIOD).densities(
        tracks.numbers[:PREDICTED_ROWS], confirmed, misses
    )
    # Slow ones, candidates and what was missed in quiet flight keep their usual gates.
    sharp = noise_density(0.2 * 250.0)
    np.testing.assert_allclose(density, [sharp, usual, usual, usual, sharp])


@given(st.lists(st.tuples(st.integers(0, 5), st.integers(0, 5), st.booleans()), min_size=1))
def test_what_is_usual_comes_first(pairs):
    track, plot, usual = (np.array(column) for column in zip(*pairs, strict=True))
    kept = usual_first(track, plot, usual)
    for i in range(len(pairs)):
        rivals = usual & ((track == track[i]) | (plot == plot[i]))
        assert kept[i] == (usual[i] or not rivals.any())


@pytest.mark.parametrize(("rate", "kept"), [(0.2, True), (0.0, False)])
def test_targets_that_turn_sharply_keep_their_tracks(scene, run, rate, kept):
    # Four targets turn by a radian between two plots.
    world, moment = scene(seed=6), 40.0
    for bearing in np.arange(4) * np.pi / 2 + 0.6:
        position = 30e3 * np.array([np.sin(bearing), np.cos(bearing)])
        before, after = (
            SPEED * np.array([np.sin(course), np.cos(course)]) for course in (bearing, bearing + 1)
        )
        world.fly(position - moment * before, before, end=moment)
        world.fly(position - moment * after, after, begin=moment, end=100.0)
    world.clutter(20.0, end=100.0)
    rows, _ = run(Tracker(TrackerParameters(sharp_turn_rate=rate)), world.messages())
    rows = rows[rows["status"] == TrackStatus.CONFIRMED]
    assert (len(set(rows["id"].tolist())) == 4) == kept


def test_a_plot_that_no_model_explains_leaves_the_velocity_open():
    smoother = SMOOTHERS["imm"](TrackerParameters())
    state, covariance = np.array([[0.0, 0.0, SPEED, 0.0]]), np.diag([400.0, 400.0, 25.0, 25.0])

    def velocity_error(aside):
        smoothed = smoother.update(
            Measured(
                state=state.copy(),
                covariance=covariance[None].copy(),
                memory=np.zeros(1, smoother.memory),
                hits=np.array([10]),
                seconds=np.array([PERIOD]),
                position=np.array([[SPEED * PERIOD, aside]]),
                position_covariance=np.diag([400.0, 400.0])[None],
                azimuth=np.zeros(1),
            )
        )
        return np.sqrt(smoothed.covariance[0, 3, 3]), smoothed.state[0, 3]

    usual, _ = velocity_error(150.0)
    sharp, speed = velocity_error(500.0)
    assert sharp > 2.0 * usual
    # White acceleration makes the end velocity 3/2 of the mean one.
    assert speed == pytest.approx(1.5 * 500.0 / PERIOD, rel=0.1)
