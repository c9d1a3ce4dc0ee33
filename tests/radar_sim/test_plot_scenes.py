# SPDX-License-Identifier: Apache-2.0
"""Scenes of plots: their laws hold, their truth is exact, and one seed makes one scene."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

from radar_common.frames import TWO_PI, wrap_pi
from radar_common.tables import NANOSECONDS
from radar_sim.motion import Path
from radar_sim.plot_scenes import PLOT_SCENES, ClutterPatch, PlotScene, PlotSimulator, plot_scene
from radar_sim.plot_scenes.detection import (
    detection_probability,
    power_over_threshold,
    snr_for_detection,
)
from radar_sim.plot_scenes.errors import PlotErrors
from radar_sim.plot_scenes.resolution import merge
from radar_sim.radar import Radar
from radar_sim.scenario import Scenario
from radar_sim.targets import Target

SURE = 4.5
RADAR = Radar()


def still(*places, snr_db=20.0):
    """A scenario of targets that stay where they are."""
    targets = [Target(Path(x, y, 0.0, 0.0), snr_db, "slow") for x, y in places]
    return Scenario(radar=RADAR, targets=tuple(targets))


def ring(number, distance):
    angles = TWO_PI * (np.arange(number) + 0.5) / number
    return [(distance * math.sin(a), distance * math.cos(a)) for a in angles]


def everything(scene, seed=1, *, sectors=4):
    """All plots and all truth of a scene with their times."""
    sectors = list(PlotSimulator(scene, np.random.default_rng(seed), sectors=sectors))
    tables = [[sector[kind] for sector in sectors] for kind in (0, 1)]
    first = sectors[0].plots.stamp
    return [
        (
            np.concatenate([table.rows for table in some]),
            np.concatenate([(t.stamp - first) / NANOSECONDS + t.rows["time_offset"] for t in some]),
        )
        for some in tables
    ]


def quiet(scenario, **changes):
    return PlotScene(title="test", scenario=scenario, **({"scans": 40} | changes))


@pytest.mark.parametrize("name", list(PLOT_SCENES))
def test_named_scenes_come_sector_by_sector(name):
    scene = plot_scene(name, scans=3)
    period = scene.scenario.radar.scan_period
    sectors = list(PlotSimulator(scene, np.random.default_rng(2), start=10**18))
    assert len(sectors) == 3 * 32
    for number, (plots, truth) in enumerate(sectors):
        assert plots.stamp == truth.stamp == 10**18 + round(number * period / 32 * NANOSECONDS)
        for rows in (plots.rows, truth.rows):
            assert (rows["time_offset"] > -1e-6).all()
            assert (rows["time_offset"] < period / 32 + 1e-6).all()
            assert (np.diff(rows["time_offset"]) >= 0.0).all()
    truth = np.concatenate([sector.truth.rows for sector in sectors])
    plots = np.concatenate([sector.plots.rows for sector in sectors])
    assert len(np.unique(truth["id"])) >= 4
    assert len(plots) > 3 * scene.false_plots / 2
    assert (truth["range"] >= scene.nearest).all()


def test_one_seed_makes_one_scene():
    scene = plot_scene("airport", scans=4)
    same, again, other = (everything(scene, seed)[0][0] for seed in (5, 5, 6))
    assert same.tobytes() == again.tobytes()
    assert same.tobytes() != other.tobytes()


def test_sectors_change_nothing_but_the_messages():
    scene = plot_scene("clutter", scans=3)
    (fine, when), _ = everything(scene)
    (coarse, at), _ = everything(scene, sectors=1)
    assert when == pytest.approx(at, abs=1e-9)
    assert fine["range"].tolist() == coarse["range"].tolist()


def test_plots_bear_the_time_of_their_target_s_pass():
    scene = quiet(still(*ring(30, 40e3)), detection=1.0)
    (_, when), (truth, passed) = everything(scene)
    assert when == pytest.approx(passed, abs=1e-9)
    beam = TWO_PI * np.mod(passed / RADAR.scan_period, 1.0)
    assert wrap_pi(beam - truth["azimuth"]) == pytest.approx(0.0, abs=1e-8)


def test_errors_follow_their_law():
    errors = PlotErrors(range_std=30.0, azimuth_std=0.003, range_bias=100.0, azimuth_bias=-0.01)
    scene = quiet(still(*ring(50, 40e3)), detection=1.0, errors=errors)
    (plots, _), (truth, _) = everything(scene)
    for name, bias, std in (("range", 100.0, 30.0), ("azimuth", -0.01, 0.003)):
        error = plots[name] - truth[name]
        error = wrap_pi(error) if name == "azimuth" else error
        assert stats.kstest((error - bias) / std, "norm").pvalue > 1e-3
        by_scan = error.reshape(40, 50)
        correlation = np.corrcoef(by_scan[1:].ravel(), by_scan[:-1].ravel())[0, 1]
        assert abs(correlation) < SURE / np.sqrt(by_scan[1:].size)
    assert (plots["range_std"] == 30.0).all()
    assert plots["azimuth_std"] == pytest.approx(0.003)


def test_outliers_are_as_many_and_as_large_as_wanted():
    errors = PlotErrors(range_std=10.0, azimuth_std=0.001, outliers=0.1, outlier_factor=50.0)
    ranges, _ = errors.draw(20_000, np.random.default_rng(3))
    expected = 0.9 * stats.norm.sf(4.0) * 2.0 + 0.1 * stats.norm.sf(4.0 / 50.0) * 2.0
    found = np.sum(np.abs(ranges) > 40.0)
    assert found == pytest.approx(20_000 * expected, abs=SURE * np.sqrt(20_000 * expected))


@pytest.mark.parametrize("wanted", [0.5, 0.9])
def test_plots_are_missed_as_often_as_wanted(wanted):
    (plots, _), (truth, _) = everything(quiet(still(*ring(50, 40e3)), detection=wanted))
    spread = SURE * np.sqrt(len(truth) * wanted * (1.0 - wanted))
    assert len(plots) == pytest.approx(wanted * len(truth), abs=spread)


def test_plots_are_missed_more_often_farther_away():
    places = ring(40, 40e3) + ring(40, 90e3)
    scene = quiet(still(*places, snr_db=12.0))
    (plots, _), (truth, _) = everything(scene)
    for far in (False, True):
        expected = detection_probability(
            truth["snr_db"][(truth["range"] > 60e3) == far], scene.false_alarm_probability
        )
        found = np.sum((plots["range"] > 60e3) == far)
        assert found == pytest.approx(expected.sum(), abs=SURE * np.sqrt(len(expected)) / 2.0)
        assert far == (expected.mean() < 0.5)


@given(st.floats(1e-4, 0.9999), st.floats(1e-9, 5e-5))
def test_the_ratio_for_a_probability_gives_that_probability(wanted, false_alarms):
    ratio = snr_for_detection(wanted, false_alarms)
    assert detection_probability(ratio, false_alarms) == pytest.approx(wanted, rel=1e-9)


def test_powers_of_plots_are_above_the_threshold_and_tell_targets_from_noise():
    rng = np.random.default_rng(4)
    noise = power_over_threshold(np.full(4000, -np.inf), 1e-6, rng)
    target = power_over_threshold(np.full(4000, 15.0), 1e-6, rng)
    assert min(noise.min(), target.min()) > -math.log(1e-6)
    assert stats.kstest(noise + math.log(1e-6), "expon").pvalue > 1e-3
    assert target.mean() > 2.0 * noise.mean()


def test_false_plots_are_poisson_and_uniform_in_range_and_azimuth():
    scene = quiet(still(), false_plots=60.0, scans=100, nearest=4e3)
    (plots, when), (truth, _) = everything(scene)
    assert len(truth) == 0
    assert len(plots) == pytest.approx(6000, abs=SURE * math.sqrt(6000))
    numbers = np.bincount((when / RADAR.scan_period).astype(int), minlength=100)
    dispersion = np.var(numbers) / np.mean(numbers) * 100
    assert stats.chi2.ppf(1e-4, 99) < dispersion < stats.chi2.ppf(1.0 - 1e-4, 99)
    span = RADAR.range_end - 4e3
    assert stats.kstest((plots["range"] - 4e3) / span, "uniform").pvalue > 1e-3
    assert stats.kstest(plots["azimuth"] / TWO_PI, "uniform").pvalue > 1e-3
    assert when == pytest.approx(
        RADAR.scan_period * (np.floor(when / RADAR.scan_period) + plots["azimuth"] / TWO_PI)
    )


def test_patches_hold_their_plots_uniform_over_their_area():
    patch = ClutterPatch(
        range_min=10e3, range_max=30e3, azimuth_min=6.0, azimuth_max=6.8, per_scan=50.0
    )
    (plots, _), _ = everything(quiet(still(), patches=(patch,)))
    assert len(plots) == pytest.approx(2000, abs=SURE * math.sqrt(2000))
    share = (plots["range"] ** 2 - 10e3**2) / (30e3**2 - 10e3**2)
    assert stats.kstest(share, "uniform").pvalue > 1e-3
    across = np.mod(plots["azimuth"] - 6.0, TWO_PI) / 0.8
    assert stats.kstest(across, "uniform").pvalue > 1e-3


def test_neighbours_within_a_resolution_cell_give_one_plot():
    # Across north: two within the cell, one beside it in range, one beside it in azimuth.
    azimuth = np.array([0.005, TWO_PI - 0.005, 0.0, 0.1])
    distance = np.array([20e3, 20.05e3, 21e3, 20e3])
    power = np.array([30.0, 10.0, 20.0, 20.0])
    left, ranges, azimuths = merge(
        distance, azimuth, power, range_resolution=100.0, azimuth_resolution=0.02
    )
    assert sorted(left.tolist()) == [0, 2, 3]
    merged = left.tolist().index(0)
    assert ranges[merged] == pytest.approx(20e3 + 0.25 * 50.0)
    assert azimuths[merged] == pytest.approx(0.0025, abs=1e-6)


@given(st.integers(0, 30), st.integers(0, 10**6))
def test_merging_without_resolution_limits_changes_nothing(number, seed):
    rng = np.random.default_rng(seed)
    plots = rng.uniform(1.0, 6.0, (3, number))
    left, ranges, azimuths = merge(*plots, range_resolution=0.0, azimuth_resolution=1.0)
    assert left.tolist() == list(range(number))
    assert ranges.tolist() == plots[0].tolist()
    assert azimuths.tolist() == plots[1].tolist()


def test_a_share_of_the_targets_keeps_their_names():
    scene = quiet(still(*ring(10, 40e3)), detection=1.0, share=0.5, scans=1)
    _, (truth, _) = everything(scene)
    assert len(truth) == 5
    assert set(truth["id"]) < set(range(1, 11))


@pytest.mark.parametrize(
    "changes",
    [
        {"scans": 0},
        {"false_plots": -1.0},
        {"false_plots": math.nan},
        {"share": 0.0},
        {"detection": 0.0},
        {"detection": 1.1},
        {"false_alarm_probability": 1.0},
    ],
)
def test_scenes_that_cannot_be_are_refused(changes):
    with pytest.raises(ValueError, match=r"scans|probability|detection"):
        replace(plot_scene("half"), **changes)


def test_other_impossible_wishes_are_refused():
    with pytest.raises(ValueError, match="no scene 'moon'"):
        plot_scene("moon")
    with pytest.raises(ValueError, match="one sector or more"):
        PlotSimulator(plot_scene("half"), np.random.default_rng(1), sectors=0)
    with pytest.raises(ValueError, match="patch"):
        ClutterPatch(range_min=2.0, range_max=1.0, azimuth_min=0.0, azimuth_max=1.0, per_scan=1.0)
    with pytest.raises(ValueError, match="law of errors"):
        PlotErrors(outliers=1.5)
    with pytest.raises(ValueError, match="detection probability"):
        snr_for_detection(1e-9, 1e-6)
