# SPDX-License-Identifier: Apache-2.0
"""What sensors report is taken over as it is, and what cannot be used is dropped and counted by its reason."""

from __future__ import annotations

import numpy as np
import pytest

from bearing_tracker.sightings import (
    LONGEST_OFFSET,
    Deviations,
    from_bearings,
    from_plots,
    from_tracks,
)
from radar_common.health import Health
from radar_common.tables import PLOT, TRACK, BearingChannel, TrackStatus

DEVIATIONS = Deviations(0.01, 0.001)


@pytest.mark.parametrize(
    ("field", "value", "reason"),
    [
        ("azimuth", -1e-9, "bearings outside [0, 2 pi)"),
        ("azimuth", 2 * np.pi, "bearings outside [0, 2 pi)"),
        ("azimuth", 359.0, "bearings outside [0, 2 pi)"),
        ("azimuth", np.nan, "bearings that are not finite"),
        ("azimuth", np.inf, "bearings that are not finite"),
        ("time_offset", np.nan, "bearings that are not finite"),
        ("time_offset", 2 * LONGEST_OFFSET, "bearings far from their message's time"),
        ("azimuth_std", 1.0, "bearings with huge errors"),
        ("azimuth_std", np.inf, "bearings with huge errors"),
        ("channel", 9, "bearings of unknown channels"),
        ("channel", BearingChannel.FUSED, "bearings of other than the passive channel"),
    ],
)
def test_a_bad_bearing_is_dropped_with_one_reason(make_bearings, field, value, reason):
    source = make_bearings(np.array([1.0, 2.0, 3.0]))
    source[field][1] = value
    health = Health()
    rows = from_bearings(source, 5.0, DEVIATIONS, 100, health)
    assert rows["azimuth"].tolist() == [1.0, 3.0]
    assert health.dropped == {reason: 1}


@pytest.mark.parametrize(
    ("told", "believed"), [(np.nan, 0.01), (0.0, 0.01), (-1.0, 0.01), (1e-9, 0.001), (0.02, 0.02)]
)
def test_an_error_that_cannot_be_is_replaced(make_bearings, told, believed):
    rows = from_bearings(make_bearings([1.0], std=told), 0.0, DEVIATIONS, 9, Health())
    assert rows["azimuth_std"] == pytest.approx([believed])


def test_elevation_counts_only_with_its_error(make_bearings):
    source = make_bearings(np.ones(3))
    source["elevation"] = 0.1
    source["elevation_std"] = [0.01, np.nan, 0.0]
    rows = from_bearings(source, 0.0, DEVIATIONS, 9, Health())
    assert np.isfinite(rows["elevation"]).tolist() == [True, False, False]


def test_a_message_is_cut_at_its_limit(make_bearings):
    health = Health()
    rows = from_bearings(make_bearings(np.linspace(0, 6, 50)), 0.0, DEVIATIONS, 20, health)
    assert len(rows) == 20
    assert health.dropped == {"bearings over the limit of a message": 30}


def test_a_track_is_seen_from_the_radar(make_tracks):
    source = make_tracks([(1100.0, 200.0), (100.0, 4200.0)], [7, 8], across=40.0)
    rows = from_tracks(source, 3.0, DEVIATIONS, 9, Health(), place=(100.0, 200.0), as_plots=False)
    assert rows["azimuth"] == pytest.approx([np.pi / 2, 0.0])
    assert rows["range"] == pytest.approx([1000.0, 4000.0])
    assert rows["azimuth_std"] == pytest.approx([0.04, 0.01])
    assert rows["id"].tolist() == [7, 8]
    assert (rows["time"] == 3.0).all()


def test_the_error_of_a_track_is_that_across_the_line_of_sight(make_tracks):
    source = make_tracks([(0.0, 1000.0), (1000.0, 0.0)], [1, 2])
    covariance = np.diag([25.0, 900.0, 1.0, 1.0])
    source["covariance"] = covariance.ravel()
    rows = from_tracks(source, 0.0, DEVIATIONS, 9, Health(), place=(0.0, 0.0), as_plots=False)
    assert rows["azimuth_std"] == pytest.approx([0.005, 0.03])


@pytest.mark.parametrize("entry", [np.nan, -100.0])
def test_a_covariance_that_is_not_positive_definite_tells_nothing(make_tracks, entry):
    source = make_tracks([(0.0, 1000.0)], 1)
    source["covariance"][0, 0] = entry
    rows = from_tracks(source, 0.0, DEVIATIONS, 9, Health(), place=(0.0, 0.0), as_plots=False)
    assert rows["azimuth_std"] == pytest.approx([0.01])


def test_only_rows_of_tracks_with_a_plot_measure(make_tracks):
    source = np.concatenate([make_tracks([(0.0, 1000.0)], number) for number in range(1, 6)])
    source["status"] = [
        TrackStatus.TENTATIVE,
        TrackStatus.CONFIRMED,
        TrackStatus.COASTING,
        TrackStatus.ENDED,
        TrackStatus.CONFIRMED,
    ]
    source["plot_azimuth"][[2, 3]] = np.nan
    source["plot_azimuth"][4] = 1.5
    rows = from_tracks(source, 0.0, DEVIATIONS, 9, Health(), place=(0.0, 0.0), as_plots=True)
    assert rows["id"].tolist() == [2, 4, 5]
    assert rows["ended"].tolist() == [False, True, False]
    assert rows["azimuth"][2] == 1.5


def test_bad_plots_and_tracks_are_dropped_too():
    health = Health()
    plots = np.zeros(3, PLOT)
    plots["azimuth"] = [1.0, 7.0, np.nan]
    plots["range"] = [1000.0, 1000.0, 1000.0]
    assert len(from_plots(plots, 0.0, DEVIATIONS, 9, health)) == 1
    tracks = np.zeros(2, TRACK)
    tracks["status"] = TrackStatus.CONFIRMED
    tracks["x"] = [0.0, np.nan]
    assert not len(
        from_tracks(tracks, 0.0, DEVIATIONS, 9, health, place=(0.0, 0.0), as_plots=False)
    )
    assert health.dropped == {
        "plots outside [0, 2 pi)": 1,
        "plots that are not finite": 1,
        "tracks at no range": 2,
    }
