# SPDX-License-Identifier: Apache-2.0
"""The study of trackers and the trial of recordings, on small scenes; and the consistency of what tracks say."""

from __future__ import annotations

import json
import sys
from dataclasses import replace

import numpy as np
import pytest
from scipy import stats

from radar_common.bag import BagWriter
from radar_common.health import Health
from radar_common.tables import PLOTS_TOPIC, TRACKS_TOPIC, TRUTH_TOPIC, EndReason, TrackStatus
from radar_eval.asterix_import import ImportOptions, import_recording, messages
from radar_eval.asterix_records import NAUTICAL_MILE, decode_records
from radar_eval.bag_tables import lay_out
from radar_eval.errors import EvaluationError
from radar_eval.evaluation import ScoreOptions, evaluate
from radar_eval.figures.style import as_png
from radar_eval.figures.tracking import draw_tracking
from radar_eval.figures.tracking_consistency import draw_consistency
from radar_eval.metrics.consistency import PLOT_DEGREES, STATE_DEGREES, bounds_of_mean
from radar_eval.metrics.continuity import ends_of_tracks
from radar_eval.metrics.per_target import score_targets
from radar_eval.recording_file import data_blocks
from radar_eval.studies import tracking_stone_soup
from radar_eval.studies.recording import run_tracker, summarise
from radar_eval.studies.tracking import compare, markdown, summarise_run
from radar_eval.studies.tracking_consistency import mean_over_scans, run_matched
from radar_eval.studies.tracking_peers import PEERS, run_peer
from radar_eval.studies.tracking_scores import (
    OURS,
    Contestant,
    contestants,
    judge,
    score_row,
    simulate,
    track,
)
from radar_sim.plot_scenes import PLOT_SCENES, plot_scene
from secondary_proc.association import ASSOCIATIONS
from secondary_proc.parameters import TrackerParameters
from secondary_proc.smoothing import SMOOTHERS

FLIGHTS, SCANS = 80, 20


@pytest.fixture(scope="module")
def crossing():
    """A small scene with its plots and truth."""
    scene = replace(plot_scene("crossing", scans=14), false_plots=8.0)
    return scene, *simulate(scene, 3)


@pytest.fixture(scope="module")
def matched():
    """The default smoother on flights that move as it assumes."""
    return run_matched(flights=FLIGHTS, scans=SCANS, seed=11, smoother="kalman")


@pytest.mark.parametrize("peer", PEERS)
def test_stone_soup_s_trackers_work_on_the_same_plots(crossing, peer):
    pytest.importorskip("stonesoup")
    scene, plots, truth = crossing
    seconds, tracks = track(Contestant(peer), scene, plots)
    evaluation = judge(scene, plots, truth, tracks)
    scores = score_row(evaluation, seconds)
    assert scores["targets_tracked"] == scores["targets"] == 8
    assert scores["plots_in_tracks"] > 0.9
    assert scores["position_rms_m"] < 1.2 * scores["plot_rms_m"]
    # Each row of a plot is joined to it exactly, and lies where that plot is.
    rows = evaluation.tables.tracks.rows
    updated = np.isfinite(rows["plot_range"])
    assert (evaluation.history.plot_of_row[updated] >= 0).all()
    assert set(rows["status"]) >= {TrackStatus.TENTATIVE, TrackStatus.CONFIRMED}


def test_ours_and_theirs_follow_the_same_targets(crossing):
    scene, plots, truth = crossing
    seconds, tracks = track(Contestant(OURS, {}), scene, plots)
    scores = score_row(judge(scene, plots, truth, tracks), seconds)
    assert scores["targets_tracked"] == scores["targets"] == 8
    assert scores["false_tracks"] == 0
    assert scores["gospa_m"] ** 2 >= scores["gospa_localisation_m"] ** 2
    assert scores["position_rms_m"] < scores["plot_rms_m"]


def test_every_strategy_takes_part_once():
    default = TrackerParameters()
    changes = [c.changes for c in contestants() if c.changes is not None]
    assert changes[0] == {}
    assert len(changes) == len(SMOOTHERS) + len(ASSOCIATIONS) - 1
    assert {"smoother": default.smoother} not in changes
    assert [c.name for c in contestants() if c.changes is None] == list(PEERS)


def test_without_stone_soup_there_is_one_clear_error(monkeypatch, command, tmp_path):
    for name in [n for n in sys.modules if n.split(".")[0] == "stonesoup"]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setattr(tracking_stone_soup.importlib.util, "find_spec", lambda name: None)
    result = command("study", "tracking", "--out", tmp_path)
    assert (result.code, result.err.count("\n")) == (1, 1)
    assert "pip install stonesoup" in result.err
    with pytest.raises(EvaluationError, match="no tracker"):
        run_peer("nobody", [], period=4.0, false_plots=1.0, reach=1e5)


def test_rows_of_the_table_and_the_figure_are_those_of_the_trackers():
    who = [Contestant(OURS, {}), Contestant("other", {"smoother": "alpha_beta"})]
    rows = compare("crossing", scans=12, seed=1, who=who)
    assert [(row["scene"], row["tracker"]) for row in rows] == [
        ("crossing", OURS),
        ("crossing", "other"),
    ]
    lines = markdown(rows).splitlines()
    assert len(lines) == 2 + len(rows)
    assert len({line.count("|") for line in lines}) == 1
    figure = draw_tracking(rows, 1000.0)
    assert len(figure.axes[0].patches) == 3 * len(rows)
    assert all(len(axes.lines) >= len(rows) for axes in figure.axes)
    assert as_png(figure, dpi=30).startswith(b"\x89PNG")


def test_errors_are_as_large_as_the_tracks_say(matched):
    # All flights are independent, and the scans of each nearly so: each mean has its own bounds.
    for scan, value, degrees in (
        (matched.scan, matched.nees, STATE_DEGREES),
        (matched.nis_scan, matched.nis, PLOT_DEGREES),
    ):
        mean, number = mean_over_scans(scan, value, SCANS)
        settled = np.arange(SCANS) >= 4
        assert (number[settled] > 0.95 * FLIGHTS).all()
        low, high = bounds_of_mean(degrees, FLIGHTS, 0.9999)
        assert (mean[settled] > low).all()
        assert (mean[settled] < high).all()
        assert np.mean(mean[settled]) == pytest.approx(degrees, rel=0.1)
    summary = summarise_run(matched, SCANS)
    assert summary["nees_within_bounds"] > 0.7


def test_the_innovation_is_found_from_the_updated_state(matched):
    settled = matched.nis[matched.nis_scan >= 6]
    above = np.mean(settled > stats.chi2.ppf(0.9, PLOT_DEGREES))
    assert above == pytest.approx(0.1, abs=4.0 * np.sqrt(0.09 / len(settled)))


def test_a_filter_that_believes_too_much_is_seen(matched):
    class Doubter:
        flights, smoother = matched.flights, matched.smoother
        scan, nis_scan = matched.scan, matched.nis_scan
        nees, nis = 2.0 * matched.nees, 2.0 * matched.nis

    assert summarise_run(Doubter, SCANS)["nees_within_bounds"] < 0.2
    assert summarise_run(Doubter, SCANS)["nis_within_bounds"] < 0.2


def test_the_bounds_of_a_mean_hold_their_share():
    rng = np.random.default_rng(5)
    means = rng.chisquare(4, (20_000, 30)).mean(axis=1)
    low, high = bounds_of_mean(4, 30)
    inside = np.mean((means > low) & (means < high))
    assert inside == pytest.approx(0.95, abs=4.0 * np.sqrt(0.95 * 0.05 / 20_000))


def test_the_consistency_is_drawn(matched):
    figure = draw_consistency([matched], SCANS)
    assert [axes.get_title(loc="left")[:4] for axes in figure.axes[::2]] == ["NEES", "NIS,"]
    assert as_png(figure, dpi=30).startswith(b"\x89PNG")


def test_each_target_s_tracks_switches_and_losses_are_counted(world):
    plots = world.plots()
    owner = world.owner(plots)
    # The second half of target 0 goes to another track; the first five plots of target 1 to none.
    late = (owner == 0) & (plots.time > np.median(plots.time))
    early = np.flatnonzero(owner == 1)[:5]
    follower = owner.copy()
    follower[late] = 50
    follower[early] = -1
    evaluation = evaluate(
        world.tables(plots, world.tracks(plots, follower)), ScoreOptions(scan_period=4.0)
    )
    scores = score_targets(evaluation)
    assert scores.tracks.tolist() == [2, 1, 1, 1, 1, 1]
    assert scores.switches.tolist() == [1, 0, 0, 0, 0, 0]
    assert scores.lost.tolist() == [0, 5, 0, 0, 0, 0]
    assert scores.trouble.tolist() == [10, 5, 0, 0, 0, 0]
    assert scores.worst(10).tolist() == [0, 1]
    assert scores.worst(1).tolist() == [0]


def test_the_ends_of_confirmed_tracks_are_counted_by_reason(world):
    plots = world.plots()
    tracks = world.tracks(plots, world.owner(plots))
    last = {int(n): np.flatnonzero(tracks.rows["id"] == n)[-1] for n in (100, 101, 102)}
    for number, reason in ((100, EndReason.SCORE), (101, EndReason.MISSES), (102, EndReason.SCORE)):
        tracks.rows["status"][last[number]] = TrackStatus.ENDED
        tracks.rows["end_reason"][last[number]] = reason
    evaluation = evaluate(world.tables(plots, tracks), ScoreOptions(scan_period=4.0))
    assert ends_of_tracks(evaluation) == {"score": 2, "misses": 1}


def test_levels_are_summed_up_with_the_bound_of_their_false_tracks():
    runs = [
        {"false_plots_added": 50.0, "seed": seed, "false_tracks": false, "duration_s": 1800.0}
        for seed, false in ((1, 0), (2, 3))
    ]
    (level,) = summarise(runs)
    assert (level["runs"], level["hours"], level["false_tracks_per_hour"]) == (2, 1.0, 3.0)
    # Garwood's bound: three or fewer have a probability of 5 % at that rate.
    assert stats.poisson.cdf(3, level["false_tracks_per_hour_below"]) == pytest.approx(0.05)


def test_a_bag_is_tried_and_its_worst_cases_are_drawn(command, crossing, tmp_path):
    _, plots, truth = crossing
    with BagWriter(tmp_path / "bag") as writer:
        for some, true in zip(plots, truth, strict=True):
            writer.write(PLOTS_TOPIC, some)
            writer.write(TRUTH_TOPIC, true)
    result = command(
        "trial", tmp_path / "bag", "--false-plots", "0", "--half", "all", "--out",
        tmp_path / "out", "--worst", "2", "--json",
    )  # fmt: skip
    assert result.code == 0, result.err
    (level,) = result.json()["levels"]
    assert (level["false_plots_added"], level["runs"], level["targets_tracked"]) == (0.0, 1, 8)
    assert json.loads((tmp_path / "out" / "trial.json").read_text("utf-8")) == result.json()
    pictures = sorted(path.name for path in (tmp_path / "out").glob("*.png"))
    assert pictures == [case["picture"] for case in result.json()["worst"]]
    for name in pictures:
        assert (tmp_path / "out" / name).read_bytes().startswith(b"\x89PNG")


def test_what_cannot_be_tried_is_one_clear_error(command, crossing, tmp_path):
    _, plots, _ = crossing
    with BagWriter(tmp_path / "bag") as writer:
        for some in plots:
            writer.write(PLOTS_TOPIC, some)
    result = command("trial", tmp_path / "bag")
    assert (result.code, result.err.count("\n")) == (1, 1)
    assert "needs truth" in result.err
    with pytest.raises(SystemExit):
        command("trial", tmp_path / "bag", "--runs", "0")


@pytest.mark.realdata
@pytest.mark.study
@pytest.mark.parametrize(("level", "seed"), [(0.0, 1), (200.0, 1), (200.0, 2)])
def test_the_second_half_of_the_recording_meets_its_targets(realdata, level, seed):
    from radar_eval.studies.recording import Recording, TrialOptions, run_once

    recording = decode_records(
        data_blocks(realdata / "bcn_psr_modes_0800_0820.ast", Health()), Health()
    )
    options = ImportOptions(primary=True, nearest=5 * NAUTICAL_MILE)
    tables: dict[str, list] = {PLOTS_TOPIC: [], TRUTH_TOPIC: [], TRACKS_TOPIC: []}
    for topic, table in messages(import_recording(recording, options)):
        tables[topic].append(table)
    half = Recording.part(lay_out(tables), "second")
    wanted = TrialOptions(
        half="second",
        nearest=5 * NAUTICAL_MILE,
        farthest=60 * NAUTICAL_MILE,
        parameters=TrackerParameters(),
    )
    evaluation, seconds = run_once(half, wanted, level, seed)
    scores = score_row(evaluation, seconds)
    assert scores["false_tracks"] == 0
    assert scores["tracks_per_target"] <= 1.2
    assert scores["plots_in_tracks"] >= 0.97
    assert scores["position_rms_m"] <= 130.0


@pytest.mark.study
@pytest.mark.parametrize("scene", list(PLOT_SCENES))
def test_no_scene_loses_a_target_for_good(scene):
    world = plot_scene(scene, scans=30)
    plots, truth = simulate(world, 4)
    seconds, tracks = run_tracker(plots, TrackerParameters())
    scores = score_row(judge(world, plots, truth, tracks), seconds)
    assert scores["targets_tracked"] >= 0.9 * scores["targets"]
    assert scores["false_tracks"] <= 1
