# SPDX-License-Identifier: Apache-2.0
"""Biases of a radar: found against the truth however wrong some plots are, and subtracted by the tracker."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from radar_common.bag import BagWriter
from radar_common.tables import PLOTS_TOPIC, TRUTH_TOPIC
from radar_eval.bag_tables import lay_out
from radar_eval.errors import ScoreError
from radar_eval.registration import register, robust_offset
from radar_eval.studies.recording import run_tracker
from radar_eval.studies.tracking_scores import judge
from radar_sim.motion import Path
from radar_sim.plot_scenes import PlotScene, PlotSimulator
from radar_sim.plot_scenes.errors import PlotErrors
from radar_sim.radar import Radar
from radar_sim.scenario import Scenario
from radar_sim.targets import Target
from secondary_proc.parameters import TrackerParameters

START = 1_700_000_000_000_000_000


def biased(range_bias, azimuth_bias, *, targets=20, scans=20, outliers=0.05):
    """Plots and truth of flights all round, as lists of messages, and the scene."""
    azimuth = 2.0 * np.pi * (np.arange(targets) + 0.5) / max(targets, 1)
    paths = [Path(40e3 * np.sin(a), 40e3 * np.cos(a), 150.0, a + 1.0) for a in azimuth.tolist()]
    scene = PlotScene(
        title="biased",
        scenario=Scenario(radar=Radar(), targets=tuple(Target(p, 30.0, "slow") for p in paths)),
        scans=scans,
        detection=0.9,
        false_plots=20.0,
        errors=PlotErrors(
            range_std=20.0,
            azimuth_std=0.001,
            outliers=outliers,
            outlier_factor=10.0,
            range_bias=range_bias,
            azimuth_bias=azimuth_bias,
        ),
    )
    sectors = list(PlotSimulator(scene, np.random.default_rng(7), start=START))
    return [s.plots for s in sectors], [s.truth for s in sectors], scene


@pytest.fixture(scope="module")
def shifted():
    """A radar that measures 250 m too far and half a degree too far round."""
    return biased(250.0, np.radians(0.5))


def test_a_bias_is_found_and_its_error_told(shifted):
    plots, truth, _ = shifted
    found = register(lay_out({PLOTS_TOPIC: plots, TRUTH_TOPIC: truth}))
    assert found.targets == 20
    assert found.plots > 300
    for offset, expected, std in (
        (found.range, 250.0, 20.0),
        (found.azimuth, np.radians(0.5), 0.001),
    ):
        assert offset.standard_error < 2.0 * std / np.sqrt(found.plots)
        assert offset.value == pytest.approx(expected, abs=4.0 * offset.standard_error)
        assert offset.scatter == pytest.approx(std, rel=0.2)


def test_the_tracker_subtracts_what_was_found(shifted):
    plots, truth, scene = shifted
    found = register(lay_out({PLOTS_TOPIC: plots, TRUTH_TOPIC: truth}))
    told = TrackerParameters(range_bias=found.range.value, azimuth_bias=found.azimuth.value)
    mean = {}
    for name, parameters in (("untold", TrackerParameters()), ("told", told)):
        _, tracks = run_tracker(plots, parameters)
        evaluation = judge(scene, plots, truth, tracks)
        rows, time = evaluation.tables.tracks.rows, evaluation.tables.tracks.time
        history = evaluation.history
        settled = (rows["hits"] > 10) & (history.label[history.track_of_row] >= 0)
        label = history.label[history.track_of_row[settled]]
        _, true = evaluation.paths.columns_at(label, time[settled], "x", "y")
        distance = np.hypot(true["x"], true["y"])
        out = np.stack([true["x"], true["y"]]) / distance
        error = np.stack([rows["x"][settled] - true["x"], rows["y"][settled] - true["y"]])
        along = np.median(np.sum(error * out, axis=0))
        across = np.median((error[0] * out[1] - error[1] * out[0]) / distance)
        mean[name] = (along, across)
        # The plots of the tracks are told as they were received, whatever was subtracted.
        assert (history.plot_of_row[settled & np.isfinite(rows["plot_range"])] >= 0).all()
    assert mean["untold"][0] == pytest.approx(250.0, abs=15.0)
    assert mean["untold"][1] == pytest.approx(np.radians(0.5), abs=3e-4)
    assert mean["told"][0] == pytest.approx(0.0, abs=15.0)
    assert mean["told"][1] == pytest.approx(0.0, abs=3e-4)


def test_the_standard_error_is_that_of_the_targets_not_of_the_plots():
    # 20 targets with an error of their own each, 100 plots a target with next to none.
    rng = np.random.default_rng(8)
    errors = []
    for _ in range(200):
        own = rng.normal(0.0, 50.0, 20)
        target = np.repeat(np.arange(20), 100)
        found = robust_offset(own[target] + rng.normal(0.0, 1.0, 2000), target)
        errors.append(found.value / found.standard_error)
    # Student's law of 19 degrees of freedom, widened by the median's part in it.
    assert 0.85 < np.std(errors) < 1.5


@given(st.floats(-1e4, 1e4), st.floats(1e-3, 100.0), st.integers(0, 10**6))
def test_outliers_move_the_estimate_by_little_and_shifts_move_it_exactly(shift, scale, seed):
    rng = np.random.default_rng(seed)
    clean = scale * rng.standard_normal(300)
    dirty = clean.copy()
    dirty[:15] += 1e3 * scale
    target = np.arange(300) % 30
    offset = robust_offset(clean, target)
    assert robust_offset(clean + shift, target).value == pytest.approx(
        offset.value + shift, abs=1e-6 * scale + 1e-9
    )
    assert robust_offset(dirty, target).value == pytest.approx(offset.value, abs=0.25 * scale)


def test_the_command_prints_parameters(command, shifted, tmp_path):
    plots, truth, _ = shifted
    with BagWriter(tmp_path / "bag") as writer:
        for some, true in zip(plots, truth, strict=True):
            writer.write(PLOTS_TOPIC, some)
            writer.write(TRUTH_TOPIC, true)
    result = command("register", tmp_path / "bag", "--json").json()
    assert result["parameters"]["range_bias"] == pytest.approx(250.0, abs=10.0)
    assert TrackerParameters(**result["parameters"]).bias == tuple(result["parameters"].values())
    text = command("register", tmp_path / "bag").out
    assert "range_bias: 2" in text
    assert "20 targets" in text


def test_what_cannot_be_registered_is_one_clear_error(command, tmp_path):
    plots, truth, _ = biased(0.0, 0.0, targets=2, scans=8)
    with pytest.raises(ScoreError, match="2 targets"):
        register(lay_out({PLOTS_TOPIC: plots, TRUTH_TOPIC: truth}))
    with pytest.raises(ScoreError, match="no"):
        register(lay_out({PLOTS_TOPIC: plots}))
    result = command("register", tmp_path / "nowhere")
    assert result.code == 1
    assert len(result.err.splitlines()) == 1
