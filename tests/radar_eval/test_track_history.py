# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np

from radar_common.tables import TrackStatus
from radar_eval.bag_tables import TimedRows
from radar_eval.labelling import FALSE
from radar_eval.track_history import join_plots, trace_tracks


def test_rows_find_the_plots_that_they_were_updated_with(world):
    plots = world.plots()
    tracks = world.tracks(plots, world.owner(plots))
    # A time that was added to another stamp differs in its last bits.
    tracks = TimedRows(tracks.rows, tracks.time + 1e-9, 1)
    assert np.array_equal(join_plots(tracks, plots), np.arange(len(plots)))


def test_predictions_and_strange_plots_find_none(world):
    plots = world.plots()
    tracks = world.tracks(plots, world.owner(plots))
    tracks.rows["plot_range"][0] = np.nan
    tracks.rows["plot_range"][1] += 1e-9
    tracks.time[2] += 0.01
    joined = join_plots(tracks, plots)
    assert list(joined[:3]) == [FALSE] * 3
    assert np.array_equal(joined[3:], np.arange(3, len(plots)))


def test_a_track_belongs_to_the_target_of_most_of_its_plots(world):
    plots = world.plots()
    owner = world.owner(plots)
    mixed = owner.copy()
    swapped = np.flatnonzero(owner == 3)[:10]
    mixed[swapped] = 4
    history = trace_tracks(world.tracks(plots, mixed), plots, owner)
    assert list(history.label) == [0, 1, 2, 3, 4, 5]
    assert history.purity[4] == 30 / 40
    assert history.purity[3] == 1.0
    assert not history.false.any()


def test_a_track_without_a_majority_is_false(world):
    plots = world.plots()
    owner = world.owner(plots)
    labels = owner.copy()
    labels[np.flatnonzero(owner == 1)[:16]] = FALSE
    history = trace_tracks(world.tracks(plots, owner), plots, labels)
    assert list(history.false) == [False, True, False, False, False, False]
    assert list(history.true) == [True, False, True, True, True, True]


def test_a_track_is_confirmed_when_it_says_so(world):
    plots = world.plots()
    owner = world.owner(plots)
    tracks = world.tracks(plots, owner, confirm_after=3)
    tracks.rows["status"][tracks.rows["id"] == 105] = TrackStatus.TENTATIVE
    history = trace_tracks(tracks, plots, owner)
    assert list(history.confirmed) == [True] * 5 + [False]
    third = np.flatnonzero(tracks.rows["id"] == 100)[2]
    assert history.confirmed_at[0] == tracks.time[third]
    assert np.isinf(history.confirmed_at[5])


def test_no_tracks_give_an_empty_history(world):
    history = trace_tracks(world.tables().tracks, world.plots(), world.owner(world.plots()))
    assert len(history.ids) == 0
    assert len(history.of_plots) == 0
