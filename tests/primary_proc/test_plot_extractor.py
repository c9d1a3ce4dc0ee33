# SPDX-License-Identifier: Apache-2.0
"""The whole extractor: right plots, at the promised rate and accuracy, however the sweeps come in messages."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from scipy.stats import binom, poisson

from primary_proc.automata.program import Program
from primary_proc.calculators.bursts.detection_probability import detection_probability
from primary_proc.calculators.bursts.false_alarms import false_start_probability
from primary_proc.calculators.pulse.burst_shape import burst_shape, pulses_in_burst
from primary_proc.calculators.pulse.single_pulse import steady_probability, threshold_for
from primary_proc.design import design
from primary_proc.parameters import ExtractorParameters
from primary_proc.plot_extractor import PlotExtractor
from radar_common.frames import wrap_pi
from radar_common.health import Health
from radar_common.tables import PLOT, Table

CONFIDENCE = 0.999
SCAN = 1024
STEP = 2 * np.pi / SCAN
NOISE_LEVEL = 0.02 * math.sqrt(2.0)
RATE = "plots per scan (expected: noise alone)"
ONES = "share of cells over the threshold (expected: noise alone)"


@pytest.fixture(scope="module")
def target_places():
    """Targets far apart, anywhere between pulses and cells: (pulse, cell)."""
    rng = np.random.default_rng(11)
    pulses, cells = np.meshgrid(np.arange(40, 980, 60), np.arange(30, 480, 50))
    return np.stack(
        [pulses.ravel() + rng.uniform(-5, 5, pulses.size), cells.ravel() + rng.random(pulses.size)],
        1,
    )


def matched(plots, scene, places):
    """For each place the index of the plot there, -1 for none; in pulses and cells."""
    pulse = (
        wrap_pi(plots["azimuth"] - scene.first_azimuth - np.pi) / scene.step + np.pi / scene.step
    )
    cell = (plots["range"] - scene.range_start) / scene.range_step
    distance = np.hypot((pulse - places[:, :1]) / 12.0, (cell - places[:, 1:]) / 1.6)
    nearest = distance.argmin(axis=1)
    return np.where(distance.min(axis=1) < 1.0, nearest, -1), pulse, cell


def test_targets_become_one_plot_each_with_honest_errors(scene, extract, cut, target_places):
    made = scene(1, 1024, 512, [(p, c, 12.0) for p, c in target_places])
    plots, health = extract(made.sectors(*cut(32, made)))
    which, pulse, cell = matched(plots, made, target_places)
    assert (which >= 0).mean() > 0.99
    strong = plots["snr_db"] > 12.5
    assert strong.sum() == len(target_places), "each target once, and no false plot is that strong"
    seen = which[which >= 0]
    rows, truth = plots[seen], target_places[which >= 0]

    azimuth_error = (pulse[seen] - truth[:, 0]) * STEP
    range_error = (cell[seen] - truth[:, 1]) * made.range_step
    count = len(seen)
    assert abs(azimuth_error.mean()) < 3.3 * azimuth_error.std() / np.sqrt(count), (
        "the bias is removed"
    )
    assert abs(range_error.mean()) < 3.3 * range_error.std() / np.sqrt(count)
    # 3.3 sigma of a chi-square of as many degrees of freedom; range errors are stated with caution.
    spread = 3.3 * np.sqrt(2.0 / count)
    assert abs(np.mean((azimuth_error / rows["azimuth_std"]) ** 2) - 1.0) < spread
    assert 0.25 < np.mean((range_error / rows["range_std"]) ** 2) < 1.0 + spread

    assert rows["time_offset"] == pytest.approx(truth[:, 0] * 1e-3, abs=5e-3)
    assert rows["x"] == pytest.approx(rows["range"] * np.sin(rows["azimuth"]), rel=1e-5)
    assert rows["y"] == pytest.approx(rows["range"] * np.cos(rows["azimuth"]), rel=1e-5)
    assert rows["snr_db"] == pytest.approx(20 * np.log10(rows["amplitude"]), abs=1e-3)
    assert np.median(rows["snr_db"]) == pytest.approx(20 * np.log10(12.0) - 3.0, abs=2.0)
    assert rows["quality"].min() > 0.999
    assert np.isnan(plots["radial_speed"]).all()
    assert not rows["z"].any()
    assert health.counts["plots out"] == len(plots)
    assert not health.dropped


def test_errors_of_fast_fluctuating_targets_are_stated_with_caution(scene, extract, target_places):
    """Steady-target errors would be too small by half; echoes in two rings fluctuate each for itself, hence caution."""
    made = scene(13, 1024, 512, [(p, c, 10.0) for p, c in target_places], fast=True)
    squares = {}
    for fluctuation in ("steady", "fast"):
        plots, _ = extract(made.sectors(), fluctuation=fluctuation, false_plots_per_scan=0.1)
        which, pulse, _ = matched(plots, made, target_places)
        assert (which >= 0).mean() > 0.95
        seen = which[which >= 0]
        error = (pulse[seen] - target_places[which >= 0, 0]) * STEP
        squares[fluctuation] = np.mean((error / plots["azimuth_std"][seen]) ** 2)
    assert squares["steady"] > 1.3
    assert 0.3 < squares["fast"] < 1.0 + 3.3 * np.sqrt(2.0 / len(target_places))


def test_false_plots_are_as_many_as_wanted(scene, extract, cut):
    """Four scans of noise: the number of plots within the Poisson bound of the design."""
    scans, wanted = 4, 60.0
    made = scene(2, scans * SCAN, 512)
    plots, health = extract(made.sectors(*cut(64, made)), false_plots_per_scan=wanted)
    low, high = poisson.interval(CONFIDENCE, scans * wanted)
    assert low <= len(plots) <= high
    watch = health.watches[RATE]
    assert (watch.expected, watch.observed) == pytest.approx((wanted, len(plots) / scans), rel=0.05)
    ones = health.watches[ONES]
    cells = made.video.size
    assert abs(ones.observed - ones.expected) < 4.0 * np.sqrt(ones.expected / cells)
    edge = (plots["range"] < 500.0 + 1800.0) | (plots["range"] > 500.0 + 51200.0 - 1800.0)
    low, high = poisson.interval(CONFIDENCE, scans * wanted * 36 / 512)
    assert low <= edge.sum() <= high, "also where the window of the noise level is cut"
    assert 0.35 < plots["quality"].mean() < 0.65, "quality is a share of noise, hence uniform in it"


@pytest.mark.parametrize("kind", [np.uint8, np.uint16])
def test_false_plots_of_digitised_video(scene, extract, cut, kind):
    """Noise of six counts and more keeps the rate within a quarter and the sampling error."""
    scans, wanted = 3, 60.0
    made = scene(3, scans * SCAN, 512, sigma=6.0 if kind == np.uint8 else 200.0)
    digitised = type(made)(np.minimum(np.rint(made.video), np.iinfo(kind).max), SCAN)
    plots, _ = extract(digitised.sectors(*cut(64, made), kind=kind), false_plots_per_scan=wanted)
    low, _ = poisson.interval(CONFIDENCE, 0.75 * scans * wanted)
    _, high = poisson.interval(CONFIDENCE, 1.25 * scans * wanted)
    assert low <= len(plots) <= high


@pytest.mark.parametrize("amplitude", [3.0, 4.0])
@pytest.mark.parametrize("detector", ["3/4-2", "3/3-2"])
def test_detection_probability_is_the_calculators(
    scene, extract, target_places, detector, amplitude
):
    """With a known noise level and echoes in the middle of a cell the whole chain is the model."""
    places = np.round(target_places) + np.array([0.0, 0.5])
    made = scene(4, 1024, 512, [(p, c, amplitude) for p, c in places], pattern="sinc2")
    settings = ExtractorParameters(
        beamwidth_deg=3.0,
        pattern="sinc2",
        detector=detector,
        normaliser="fixed-level",
        noise_level=NOISE_LEVEL,
    )
    plan = design(settings, 512, STEP)
    pulses = pulses_in_burst("sinc2", np.radians(3.0), STEP)
    shape = burst_shape("sinc2", pulses, book=False)
    noise = plan.method.noise_probability
    expected = detection_probability(
        Program.parse(detector), noise, steady_probability(threshold_for(noise), amplitude * shape)
    )
    plots, _ = extract(
        made.sectors(),
        pattern="sinc2",
        detector=detector,
        normaliser="fixed-level",
        noise_level=NOISE_LEVEL,
    )
    which, _, _ = matched(plots, made, places)
    low, high = binom.interval(CONFIDENCE, len(places), expected)
    assert low <= (which >= 0).sum() <= high
    assert 0.1 < expected < 0.999


@settings(
    deadline=None, max_examples=25, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(data=st.data())
def test_sectors_of_any_size_give_the_same_plots(scene, extract, data):
    made = _few_targets(scene)
    reference, _ = extract(made.sectors())
    cuts = data.draw(st.lists(st.integers(1, len(made.video) - 1), unique=True, max_size=12))
    plots, health = extract(made.sectors(*sorted(cuts)))
    assert not health.dropped
    _assert_same(plots, reference)


def test_single_pulses_as_sectors_give_the_same_plots(scene, extract, cut):
    made = _few_targets(scene)
    _assert_same(extract(made.sectors(*cut(1, made)))[0], extract(made.sectors())[0])


@settings(
    deadline=None, max_examples=25, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(angle=st.floats(0.0, 7.0))
def test_a_turned_scene_gives_turned_plots(scene, extract, cut, angle):
    """North may fall anywhere, also into a burst."""
    made = _few_targets(scene)
    reference, _ = extract(made.sectors(*cut(64, made)))
    plots, health = extract(made.rotated(angle).sectors(*cut(64, made)))
    assert not health.dropped
    assert wrap_pi(plots["azimuth"] - reference["azimuth"] - angle) == pytest.approx(
        np.zeros(len(plots)), abs=1e-9
    )
    assert ((plots["azimuth"] >= 0.0) & (plots["azimuth"] < 2 * np.pi)).all()
    _assert_same(plots, reference, but=("azimuth", "x", "y"))


def test_a_target_across_north_and_messages_is_one_plot(scene, extract):
    """The burst begins in one sector before north and ends in the next."""
    made = scene(5, 2 * SCAN, 200, [(SCAN - 3.3, 100.4, 15.0)])
    plots, _ = extract(made.sectors(SCAN), false_plots_per_scan=0.01)
    assert len(plots) == 1
    assert wrap_pi(plots["azimuth"][0]) == pytest.approx(-3.3 * STEP, abs=2.5 * STEP)
    health = Health()
    extractor = PlotExtractor(
        ExtractorParameters(beamwidth_deg=3.0, false_plots_per_scan=0.01), health
    )
    first, second = (extractor.process(table) for table in made.sectors(SCAN))
    assert (len(first.rows), len(second.rows)) == (0, 1)
    assert second.rows["time_offset"][0] < 0.0, "its middle lies in the sector before"


def test_every_sector_gives_a_table_with_its_stamp_and_frame(scene):
    made = scene(6, 256, 128)
    extractor = PlotExtractor(ExtractorParameters(beamwidth_deg=3.0), Health())
    for table in made.sectors(8, 100, 101, 200):
        plots = extractor.process(Table(table.stamp, table.rows, "antenna"))
        assert (plots.stamp, plots.frame_id, plots.rows.dtype) == (table.stamp, "antenna", PLOT)


def test_two_targets_apart_stay_two(scene, extract):
    """In azimuth by two beamwidths, in range by three cells."""
    pulses = pulses_in_burst("gaussian", np.radians(3.0), STEP)
    places = [
        (300, 100.5, 12.0),
        (300 + 2 * pulses, 100.5, 12.0),
        (700, 200.5, 12.0),
        (700, 203.5, 12.0),
    ]
    made = scene(7, 1024, 300, places)
    plots, _ = extract(made.sectors(512), false_plots_per_scan=0.01)
    assert len(plots) == 4


def test_a_long_clutter_edge_is_one_plot_without_quality(scene, extract, cut):
    """Half a turn in one cell, and a wall of 40 cells: each one extended plot, not hundreds."""
    made = scene(8, 1024, 256)
    made.video[100:600, 80] += 1.0
    made.video[800:815, 100:140] += 1.0
    plots, health = extract(
        made.sectors(*cut(32, made)),
        false_plots_per_scan=0.01,
        normaliser="fixed-level",
        noise_level=NOISE_LEVEL,
    )
    assert len(plots) == 2
    assert plots["quality"].tolist() == [0.0, 0.0]
    assert health.counts["bursts cut at their longest"] == 1
    along, across = plots
    assert along["azimuth_std"] > 10 * STEP
    assert across["range_std"] == pytest.approx(40 * made.range_step / np.sqrt(12.0))


def test_the_rate_holds_for_each_detector(scene, extract, cut):
    scans = 2
    made = scene(10, scans * SCAN, 256)
    for detector in ("3/3-2", "4/4-2", "4/4-3"):
        plots, _ = extract(
            made.sectors(*cut(64, made)), false_plots_per_scan=50.0, detector=detector
        )
        low, high = poisson.interval(CONFIDENCE, scans * 50.0)
        assert low <= len(plots) <= high, detector


def test_design_inverts_the_false_start_probability():
    plan = design(ExtractorParameters(false_plots_per_scan=10.0), 1024, 2 * np.pi / 4096)
    start = false_start_probability(Program(3, 4, 2), plan.method.noise_probability)
    assert start * 1024 * 4096 == pytest.approx(10.0, rel=1e-3)
    assert plan.requirements.pulses_per_scan == 4096.0
    assert plan.requirements.pulses == pytest.approx(19.13, abs=0.01)


def _few_targets(scene):
    return scene(
        12, 400, 96, [(60.2, 20.3, 6.0), (170.0, 70.9, 4.0), (280.7, 0.6, 9.0), (330.0, 95.2, 5.0)]
    )


def _assert_same(plots, reference, but=()):
    assert len(plots) == len(reference) > 2
    for name in set(PLOT.names) - {"radial_speed", "radial_speed_std", *but}:
        assert plots[name] == pytest.approx(reference[name], rel=1e-6, abs=1e-6), name
