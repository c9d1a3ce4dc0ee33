# SPDX-License-Identifier: Apache-2.0
"""Direction finder and active channel measure the truth with the errors, gaps and violations asked for."""

from __future__ import annotations

import numpy as np
import pytest

from radar_common.frames import wrap_pi
from radar_common.tables import BEARINGS_TOPIC, CHANNEL_TRUTH_TOPIC, PLOTS_TOPIC, TRUTH_TOPIC
from radar_sim.bearings.direction_finder import DirectionFinder
from radar_sim.bearings.simulator import BearingSimulator
from radar_sim.bearings.sources import Sources
from radar_sim.bearings.violations import Violations
from radar_sim.scenario import parse_scenario
from radar_sim.targets import Targets

EMITTERS = """
emitters:
  - {x: 10000.0, y: 20000.0, z: 3000.0}
  - {x: -15000.0, y: -3000.0, speed: 30.0, course_deg: 45.0}
"""


def run(text, topic, duration, **options):
    """Rows of a topic, one array a message."""
    simulator = BearingSimulator(parse_scenario(text), duration=duration, **options)
    return [m.content.rows for m in simulator if m.topic == topic]


def errors(text, duration, **options):
    """Azimuth error of each bearing, shape (looks, sources); needs bearings with identity and no gaps."""
    measured = np.stack(run(text, BEARINGS_TOPIC, duration, **options))
    truth = np.stack(run(text, CHANNEL_TRUTH_TOPIC, duration, **options))
    return wrap_pi(
        np.take_along_axis(measured["azimuth"], np.argsort(measured["id"], axis=1), 1)
        - np.take_along_axis(truth["azimuth"], np.argsort(truth["id"], axis=1), 1)
    )


@pytest.mark.parametrize(
    ("x", "y", "azimuth_deg"),
    [
        (0, 1, 0),
        (1, 1, 45),
        (1, 0, 90),
        (1, -1, 135),
        (0, -1, 180),
        (-1, -1, 225),
        (-1, 0, 270),
        (-1, 1, 315),
    ],
)
def test_azimuth_is_right_in_every_quadrant_and_from_any_place(x, y, azimuth_deg):
    text = (
        "direction_finder: {x: 70000.0, y: -60000.0, azimuth_std_deg: 1.0e-9}\n"
        f"emitters: [{{x: {70_000.0 + x * 5e3}, y: {-60_000.0 + y * 5e3}}}]"
    )
    (rows,) = run(text, BEARINGS_TOPIC, 0.5)
    assert float(wrap_pi(rows["azimuth"][0] - np.radians(azimuth_deg))) == pytest.approx(
        0.0, abs=1e-9
    )
    assert 0.0 <= rows["azimuth"][0] < 2.0 * np.pi


def test_the_white_error_is_white_and_as_large_as_told():
    found = errors("direction_finder: {azimuth_std_deg: 0.5}" + EMITTERS, 600.0)
    size = found.size
    assert np.var(found) == pytest.approx(np.radians(0.5) ** 2, rel=4.0 * np.sqrt(2.0 / size))
    lagged = np.mean(found[1:] * found[:-1]) / np.var(found)
    assert abs(lagged) < 4.0 / np.sqrt(size)


def test_the_correlated_error_wanders_for_each_source_apart():
    text = "direction_finder: {azimuth_std_deg: 0.6, correlated_std_deg: 0.8, correlation_time: 10.0, period: 2.0}"
    sources = "\nemitters: [" + ", ".join(["{}"] * 40) + "]"
    found = np.degrees(errors(text + sources, 1000.0))
    # Independent values are two correlation times apart.
    bound = 4.0 * np.sqrt(2.0 / (found.size / 10.0))
    assert np.var(found) == pytest.approx(1.0, rel=bound)
    for lag in (1, 3):
        covariance = np.mean(found[lag:] * found[:-lag])
        assert covariance == pytest.approx(0.64 * np.exp(-2.0 * lag / 10.0), abs=0.64 * bound)
    assert abs(np.mean(found[:, ::2] * found[:, 1::2])) < bound
    rows = run(text + EMITTERS, BEARINGS_TOPIC, 1.0)[0]
    assert np.degrees(rows["azimuth_std"]) == pytest.approx(1.0)


def test_gaps_outliers_and_missing_identity_come_as_asked():
    text = (
        "direction_finder: {detection: 0.7, outliers: 0.1, identity: false, azimuth_std_deg: 0.01}"
    )
    looks = run(text + EMITTERS, BEARINGS_TOPIC, 799.0)
    rows = np.concatenate(looks)
    assert len(rows) / 1600 == pytest.approx(0.7, abs=4.0 * np.sqrt(0.21 / 1600))
    assert (rows["id"] == 0).all()
    truth = run(text + EMITTERS, CHANNEL_TRUTH_TOPIC, 799.0)
    far = [
        np.abs(wrap_pi(look["azimuth"][:, None] - true["azimuth"])).min(axis=1) > 0.01
        for look, true in zip(looks, truth, strict=True)
    ]
    far = np.concatenate(far)
    # One in a hundred and fifty of those that point anywhere points at an emitter.
    assert far.mean() == pytest.approx(0.1, abs=4.0 * np.sqrt(0.09 / len(far)) + 0.001)


def test_elevation_is_measured_where_asked():
    text = "direction_finder: {z: 500.0, elevation: true, elevation_std_deg: 0.2}" + EMITTERS
    rows = np.concatenate(run(text, BEARINGS_TOPIC, 999.0))
    first = rows[rows["id"] == 1]
    expected = np.arctan2(2500.0, np.hypot(1e4, 2e4))
    std = np.radians(0.2)
    assert first["elevation"].mean() == pytest.approx(expected, abs=4.0 * std / np.sqrt(1000))
    assert first["elevation"].std() == pytest.approx(std, rel=4.0 * np.sqrt(0.5 / 1000))
    plain = run("direction_finder: {}" + EMITTERS, BEARINGS_TOPIC, 1.0)[0]
    assert np.isnan(plain["elevation"]).all()


def test_bearings_of_a_look_have_times_of_their_own_and_the_truth_belongs_to_them():
    text = "direction_finder: {period: 4.0, spread: 3.0, speed: 100.0, odometry_period: 100.0, azimuth_std_deg: 1.0e-9}"
    looks = run(text + EMITTERS, BEARINGS_TOPIC, 400.0)
    truth = run(text + EMITTERS, CHANNEL_TRUTH_TOPIC, 400.0)
    offsets = np.concatenate([rows["time_offset"] for rows in looks])
    assert offsets.min() >= 0.0
    assert 2.5 < offsets.max() < 3.0
    for measured, true in zip(looks, truth, strict=True):
        np.testing.assert_array_equal(measured["time_offset"], true["time_offset"])
        assert (np.diff(measured["time_offset"]) >= 0.0).all()
        np.testing.assert_allclose(measured["azimuth"], true["azimuth"], atol=1e-9)


def test_the_true_rate_is_that_of_the_azimuth():
    text = "direction_finder: {period: 0.1, speed: 100.0, legs: [{turn_rate_deg: 2.0}]}" + EMITTERS
    truth = np.stack(run(text, CHANNEL_TRUTH_TOPIC, 30.0))
    rate = np.diff(truth["azimuth"], axis=0) / 0.1
    mean = (truth["rate"][1:] + truth["rate"][:-1]) / 2.0
    np.testing.assert_allclose(rate, mean, atol=1e-6)


def test_how_many_looks_are_taken_at_a_time_changes_nothing():
    scene = parse_scenario(
        "direction_finder: {spread: 0.3, correlated_std_deg: 0.5, detection: 0.6, outliers: 0.1}"
        + EMITTERS
        + "bearing_processes: [{}]"
    ).bearings

    def finder():
        rng = np.random.default_rng(3)
        sources = Sources(scene, Targets([]), rng)
        return DirectionFinder(scene.platform, scene.passive, sources, rng)

    calm = [Violations(scene.passive, [], 1.0, np.random.default_rng(0)) for _ in range(2)]
    whole, parts = finder(), finder()
    together = whole.looks(0, 40, *calm)
    apart = [look for first in range(0, 40, 8) for look in parts.looks(first, 8, *calm)]
    for one, other in zip(together, apart, strict=True):
        assert one.measured.tobytes() == other.measured.tobytes()
        assert one.channels.tobytes() == other.channels.tobytes()
        assert one.truth.tobytes() == other.truth.tobytes()


def test_an_emitter_is_heard_while_it_transmits():
    text = """
direction_finder: {}
targets: [{}, {}]
emitters:
  - {target: 2, begins: 10.0, ends: 50.0, on_time: 3.0, off_time: 5.0}
  - {x: 100.0, appears: 20.0, lifetime: 5.0}
"""
    heard = {1: [], 2: [], 3: []}
    for second, rows in enumerate(run(text, BEARINGS_TOPIC, 60.0)):
        for source in rows["id"]:
            heard[int(source)].append(second)
    assert heard[1] == []
    assert heard[2] == [t for t in range(10, 50) if (t - 10) % 8 < 3]
    assert heard[3] == [20, 21, 22, 23, 24]


SILENT = """
direction_finder: {azimuth_std_deg: 0.5}
bearing_processes: [{azimuth_deg: 200.0, deviation_deg: 10.0}]
channels:
  passive: {silence: %s, noise_azimuth_deg: 80.0, intervals: [{begins: 100.0, ends: 600.0}]}
"""


def test_a_silent_channel_says_nothing_as_in_the_field():
    looks = run(SILENT % "nothing" + EMITTERS, BEARINGS_TOPIC, 700.0)
    assert [len(rows) for rows in looks] == [3] * 100 + [0] * 500 + [3] * 101
    truth = run(SILENT % "nothing" + EMITTERS, CHANNEL_TRUTH_TOPIC, 700.0)
    assert all(len(rows) == 3 for rows in truth)
    assert (truth[100]["passive_health"][:, 1] == 1.0).all()
    assert (truth[99]["passive_health"][:, 0] == 1.0).all()
    assert (truth[100]["active_health"][:, 0] == 1.0).all()


def test_a_silent_channel_tells_noise_as_in_the_paper():
    looks = run(SILENT % "noise" + EMITTERS, BEARINGS_TOPIC, 700.0)
    rows = np.concatenate(looks[100:600])
    for source, mean in ((1, 80.0), (2, 80.0), (3, 200.0)):
        azimuth = np.degrees(rows["azimuth"][rows["id"] == source])
        assert azimuth.mean() == pytest.approx(mean, abs=4.0 * 0.5 / np.sqrt(500))
        assert azimuth.std() == pytest.approx(0.5, rel=4.0 * np.sqrt(0.5 / 500))


ACTIVE = """
radar: {x: 2000.0, y: 1000.0, cells: 64}
targets:
  - {x: 20000.0, y: 9000.0, speed: 0.0}
  - {x: -5000.0, y: 4000.0, speed: 50.0, appears: 300.0}
bearing_processes: [{azimuth_deg: 350.0, deviation_deg: 20.0}]
channels:
  active: {azimuth_std_deg: 0.2, noise_ratio: 64.0, range_std: 30.0, intervals: [{begins: 500.0, ends: 1500.0}]}
"""


def test_jamming_makes_the_angles_of_the_active_channel_worse():
    looks, truth = (run(ACTIVE, topic, 1999.0) for topic in (PLOTS_TOPIC, CHANNEL_TRUTH_TOPIC))
    for jammed, span in ((False, slice(0, 500)), (True, slice(500, 1500))):
        plots, true = np.concatenate(looks[span]), np.concatenate(truth[span])
        error = wrap_pi(plots["azimuth"] - true["azimuth"])
        std = np.radians(1.6 if jammed else 0.2)
        assert error.std() == pytest.approx(std, rel=4.0 * np.sqrt(0.5 / len(error)))
        np.testing.assert_allclose(true["azimuth_std"], std, rtol=1e-6)
        assert (true["active_health"][:, int(jammed)] == 1.0).all()
        np.testing.assert_allclose(plots["azimuth_std"], np.radians(0.2), rtol=1e-6)


def test_plots_have_ranges_where_there_is_a_place():
    looks = run(ACTIVE, PLOTS_TOPIC, 400.0)
    assert [len(rows) for rows in looks] == [2] * 300 + [3] * 101
    first = np.array([rows[0] for rows in looks], looks[0].dtype)
    assert first["range"].mean() == pytest.approx(
        np.hypot(18e3, 8e3), abs=4.0 * 30.0 / np.sqrt(len(looks))
    )
    assert first["range"].std() == pytest.approx(30.0, rel=4.0 * np.sqrt(0.5 / len(looks)))
    np.testing.assert_allclose(np.hypot(first["x"], first["y"]), first["range"], rtol=1e-6)
    nowhere = np.array([rows[-1] for rows in looks], looks[0].dtype)
    assert all(np.isnan(nowhere[name]).all() for name in ("range", "x", "y", "range_std"))
    # Without a direction finder the truth is the active channel's; a process has no place in it.
    truth = run(ACTIVE, TRUTH_TOPIC, 400.0)
    assert [len(rows) for rows in truth] == [1] * 300 + [2] * 101
    assert truth[0]["range"][0] == pytest.approx(np.hypot(18e3, 8e3))
