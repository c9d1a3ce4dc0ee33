# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from radar_common.tables import PLOT
from radar_eval.bag_tables import TimedRows
from radar_eval.errors import RotationError, ScoreError
from radar_eval.evaluation import ScoreOptions, evaluate
from radar_eval.metrics.continuity import looks_covered
from radar_eval.metrics.detection import detection_over_range
from radar_eval.run_record import RunRecord
from radar_eval.score_names import MEANINGS, describe_scores
from radar_eval.scores import compute_scores


def scored(world, plots=None, tracks=None, run=None, **options):
    return compute_scores(evaluate(world.tables(plots, tracks), ScoreOptions(**options)), run)


def test_perfect_tracks_score_perfectly(world):
    plots = world.plots()
    scores = scored(world, plots, world.tracks(plots, world.owner(plots)))
    assert scores["targets"] == scores["targets_tracked"] == scores["confirmed_tracks"] == 6
    assert scores["targets_missed"] == scores["false_tracks"] == 0
    assert scores["tracks_per_target"] == 1.0
    assert scores["plots_in_tracks"] == 1.0
    assert scores["probability_of_detection"] == 1.0
    assert scores["false_plots_per_scan"] == 0.0
    # Confirmed with the third plot, so two of thirty passes have no confirmed track.
    assert scores["completeness"] == pytest.approx(28 / 30)
    assert scores["scans_to_confirmation_median"] == pytest.approx(2.0, abs=0.02)
    assert scores["rms_raw_m"] < 0.01
    assert scores["rms_tracked_m"] < 0.01
    assert scores["scans"] == 30
    assert scores["scan_period_s"] == pytest.approx(4.0, rel=1e-3)
    # Two scans of thirty with six missed targets; the first and the last turn are not looked at.
    assert scores["gospa_missed"] == pytest.approx(6 * 2 / 28, abs=6 / 28)
    # The target that went back across north is gone one turn before its track can be.
    assert scores["gospa_false"] <= 1 / 28


def test_position_errors_are_root_mean_squares(world):
    plots = world.plots(range_error=40.0)
    scores = scored(world, plots, world.tracks(plots, world.owner(plots), lag=-15.0))
    assert scores["rms_raw_m"] == pytest.approx(40.0, abs=0.1)
    assert scores["rms_tracked_m"] == pytest.approx(25.0, abs=0.1)
    assert scores["rms_raw_of_tracked_m"] == pytest.approx(40.0, abs=0.1)


def test_a_false_plot_in_a_track_shows_in_the_error_over_any_plot(world):
    plots = world.plots()
    owner = world.owner(plots)
    tracks = world.tracks(plots, owner)
    misled = np.flatnonzero(tracks.rows["hits"] == 20)
    tracks.rows["x"][misled] += 600.0
    plots.rows["range"][misled] += 1300.0
    tracks.rows["plot_range"][misled] += 1300.0
    scores = scored(world, plots, tracks)
    assert scores["rms_tracked_m"] < 0.01
    # One row in twenty of each track is off.
    assert scores["rms_tracked_any_plot_m"] == pytest.approx(600.0 / np.sqrt(20), rel=0.01)


def test_a_broken_track_counts_twice(world):
    plots = world.plots()
    owner = world.owner(plots)
    broken = np.where((owner == 2) & (plots.time > 60.0), 17, owner)
    scores = scored(world, plots, world.tracks(plots, broken))
    assert scores["confirmed_tracks"] == 7
    assert scores["tracks_per_target"] == pytest.approx(7 / 6)
    assert scores["plots_in_tracks"] == 1.0


def test_a_target_without_a_track_is_missed(world):
    plots = world.plots()
    owner = world.owner(plots)
    scores = scored(world, plots, world.tracks(plots, np.where(owner == 1, -1, owner)))
    assert scores["targets"] == 6
    assert scores["targets_tracked"] == 5
    assert scores["targets_missed"] == 1
    assert scores["plots_in_tracks"] == pytest.approx(5 / 6)
    assert scores["gospa_missed"] >= 1.0


def test_a_track_of_false_plots_is_false(world):
    clutter = np.zeros(8, PLOT)
    time = 4.0 * np.arange(8) + 40.0
    clutter["range"], clutter["azimuth"] = 35e3 + 500.0 * np.arange(8), 0.0
    plots = world.plots()
    rows, times = np.concatenate([plots.rows, clutter]), np.concatenate([plots.time, time])
    order = np.argsort(times, kind="stable")
    plots = TimedRows(rows[order], times[order], 1)
    true = np.isin(plots.time, world.plots().time)
    owner = np.full(len(plots), 50)
    owner[true] = world.owner(world.plots())
    scores = scored(world, plots, world.tracks(plots, owner))
    assert scores["false_tracks"] == 1
    assert scores["confirmed_tracks"] == 7
    assert scores["tracks_per_target"] == 1.0
    assert scores["false_plots_per_scan"] == pytest.approx(8 / 30)


def test_detection_is_counted_over_all_passes_and_over_range(world):
    plots = world.plots(keep=lambda target, time: ~((target == 0) & (time > 80.0)))
    evaluation = evaluate(world.tables(plots), ScoreOptions())
    scores = compute_scores(evaluation, None)
    missed = len(world.plots()) - len(plots)
    assert scores["probability_of_detection"] == pytest.approx(1.0 - missed / scores["looks"])
    rings = detection_over_range(evaluation)
    assert rings.looks.sum() == scores["looks"]
    assert rings.looks.sum() - rings.detected.sum() == missed
    assert rings.false_plots.sum() == 0.0


def test_few_plots_make_no_target(world):
    plots = world.plots(keep=lambda target, time: (target != 0) | (time < 32.0))
    assert scored(world, plots)["targets"] == 5
    assert scored(world, plots, plots_of_target=8)["targets"] == 6


def test_coverage_is_that_of_each_track_of_its_own_target(world):
    plots = world.plots()
    owner = world.owner(plots)
    late = np.where((owner == 3) & (plots.time < 60.0), -1, owner)
    evaluation = evaluate(world.tables(plots, world.tracks(plots, late)), ScoreOptions())
    covered = looks_covered(evaluation)
    looks = evaluation.looks
    assert not covered[(looks.target == 3) & (looks.time < 60.0)].any()
    assert covered[(looks.target == 4) & (looks.time > 12.0)].all()


def test_scores_without_tracks_are_not_numbers(world):
    scores = scored(world)
    assert scores["targets"] == 6
    assert scores["plots_in_tracks"] == 0.0
    for name in ("tracks_per_target", "rms_tracked_m", "scans_to_confirmation_mean"):
        assert np.isnan(scores[name])


def test_throughput_comes_from_the_run(world):
    assert scored(world, run=RunRecord(1234.0))["plots_per_second"] == 1234.0
    assert np.isnan(scored(world)["plots_per_second"])


def test_every_score_has_a_meaning(world):
    scores = scored(world)
    assert set(scores) <= set(MEANINGS)
    assert [row[0] for row in describe_scores(scores)] == list(scores)


def test_a_bag_without_truth_is_refused(world):
    tables = world.tables()
    nothing = TimedRows(tables.truth.rows[:0], tables.truth.time[:0], 0)
    with pytest.raises(ScoreError, match="no truth"):
        evaluate(dataclasses.replace(tables, truth=nothing), ScoreOptions())


def test_a_bag_with_hardly_a_plot_is_refused(world):
    with pytest.raises(RotationError, match="too few"):
        evaluate(world.tables(world.plots(keep=lambda _, time: time < 3.0)), ScoreOptions())


@pytest.mark.parametrize("name", ["gate_range", "gate_azimuth", "scan_period", "gospa_cutoff"])
@pytest.mark.parametrize("value", [0.0, -1.0, float("nan"), float("inf")])
def test_impossible_options_are_refused(name, value):
    with pytest.raises(ScoreError):
        ScoreOptions(**{name: value})
