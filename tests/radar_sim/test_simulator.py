# SPDX-License-Identifier: Apache-2.0
"""The simulator's tables: their contract, their truth, and the same data from the same seed."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from radar_common.frames import polar_from_enu
from radar_common.parameters import ParameterError
from radar_common.tables import NANOSECONDS, RADAR_FRAME, SITE_FRAME, TRUTH, sweep_dtype
from radar_sim.motion import Path
from radar_sim.parameters import SimulatorParameters
from radar_sim.radar import Radar
from radar_sim.scenario import Scenario, load_scenario
from radar_sim.simulator import Simulator
from radar_sim.targets import Target

START = 1_700_000_000 * NANOSECONDS
TINY = load_scenario("tiny")


def run(scenario=TINY, **settings):
    return list(Simulator(scenario, **{"scans": 3, "start": START} | settings))


def joined(sectors):
    """All sweeps and all truth with times since the start."""
    sweeps, truth = (np.concatenate([s[k].rows for s in sectors]) for k in (0, 1))
    for rows, part in ((sweeps, 0), (truth, 1)):
        rows["time_offset"] = np.concatenate(
            [(s[part].stamp - START) / NANOSECONDS + s[part].rows["time_offset"] for s in sectors]
        )
    return sweeps, truth


def test_sectors_are_tables_of_the_contract():
    sectors = run()
    assert len(sectors) == 3 * 32
    for sweeps, truth in sectors:
        assert sweeps.rows.dtype == sweep_dtype(32)
        assert truth.rows.dtype == TRUTH
        assert (sweeps.frame_id, truth.frame_id) == (RADAR_FRAME, SITE_FRAME)
        assert sweeps.stamp == truth.stamp
        assert abs(sweeps.rows["time_offset"][0]) < 1e-9
    assert sectors[0].sweeps.stamp == START


def test_pulses_follow_each_other_without_gap():
    sweeps, _ = joined(run())
    assert len(sweeps) == 3 * 300
    np.testing.assert_allclose(np.diff(sweeps["time_offset"]), 1.0 / 150.0, atol=2e-9)
    np.testing.assert_allclose(
        np.unwrap(sweeps["azimuth"]), 2.0 * np.pi * np.arange(900) / 300.0, atol=1e-9
    )


def test_a_turn_need_not_be_a_whole_number_of_pulses():
    scenario = Scenario(Radar(scan_period=1.0, pulse_rate=100.3, beamwidth_deg=10.0, cells=4))
    sweeps, _ = joined(run(scenario, scans=10, sectors=7))
    assert len(sweeps) == 1003
    np.testing.assert_allclose(
        np.unwrap(sweeps["azimuth"]), 2.0 * np.pi * np.arange(1003) / 100.3, atol=1e-9
    )


@settings(max_examples=15, deadline=None)
@given(sectors=st.integers(1, 300), seed=st.integers(0, 2**32))
def test_the_division_into_sectors_changes_no_bit(sectors, seed):
    whole = joined(run(sectors=1, seed=seed))
    pieces = joined(run(sectors=sectors, seed=seed))
    assert whole[0]["video"].tobytes() == pieces[0]["video"].tobytes()
    assert whole[0]["azimuth"].tobytes() == pieces[0]["azimuth"].tobytes()
    for name in ("id", "x", "y", "range", "azimuth", "snr_db"):
        assert whole[1][name].tobytes() == pieces[1][name].tobytes()
    np.testing.assert_allclose(whole[1]["time_offset"], pieces[1]["time_offset"], atol=1e-9)


def test_a_seed_gives_the_same_data_and_another_seed_other_data():
    one, same, other = (joined(run(seed=seed))[0]["video"] for seed in (1, 1, 2))
    assert one.tobytes() == same.tobytes()
    assert not np.any(one == other)


def test_truth_is_the_motion_at_the_time_of_the_crossing():
    _, truth = joined(run(scans=10))
    assert np.all(np.diff(truth["time_offset"]) >= 0)
    first = truth[truth["id"] == 1]
    assert len(first) == 10
    # From (-2000, 3000) eastwards at 60 m/s.
    np.testing.assert_allclose(first["x"], -2000.0 + 60.0 * first["time_offset"], atol=1e-3)
    np.testing.assert_allclose(first["y"], 3000.0, atol=1e-3)
    np.testing.assert_allclose(first["vx"], 60.0, rtol=1e-6)
    distance, azimuth = polar_from_enu(first["x"], first["y"])
    np.testing.assert_allclose(first["range"], distance, rtol=1e-6)
    np.testing.assert_allclose(first["azimuth"], azimuth, rtol=1e-6)
    np.testing.assert_allclose(
        first["azimuth"], 2.0 * np.pi * np.mod(first["time_offset"] / 2.0, 1.0), atol=1e-6
    )
    np.testing.assert_allclose(
        first["snr_db"], 22.0 + 40.0 * np.log10(4000.0 / first["range"]), rtol=1e-5
    )


def test_truth_stands_in_the_sector_that_it_was_crossed_in():
    for sweeps, truth in run(sectors=16):
        begin, end = sweeps.rows["time_offset"][0], sweeps.rows["time_offset"][-1] + 1.0 / 150.0
        assert np.all(
            (truth.rows["time_offset"] >= begin - 1e-9) & (truth.rows["time_offset"] < end + 1e-9)
        )


def test_a_burst_peaks_where_the_truth_is():
    sweeps, truth = joined(run(scans=8, seed=3))
    strong = truth[(truth["id"] <= 2) & (truth["time_offset"] > 0.3)]
    assert len(strong) >= 14
    for row in strong:
        cells = np.arange(32)
        near = np.abs(sweeps["time_offset"] - row["time_offset"]) < 3.0 / 150.0
        profile = sweeps["video"][near].mean(axis=0)
        assert abs((cells[profile.argmax()] + 0.5) * 150.0 - row["range"]) <= 150.0


def test_range_and_azimuth_are_seen_from_the_antenna_and_positions_from_the_map():
    radar = Radar(x=1000.0, y=-500.0, reference_range=10_000.0, cells=256)
    scenario = Scenario(radar, (Target(Path(1000.0, 9500.0, 0.0, 0.0), 20.0, "none"),))
    _, truth = joined(run(scenario, scans=1))
    assert truth["range"][0] == pytest.approx(10_000.0)
    assert truth["azimuth"][0] == pytest.approx(0.0, abs=1e-9)
    assert (truth["x"][0], truth["y"][0]) == pytest.approx((1000.0, 9500.0))


def test_targets_outside_the_instrumented_range_are_not_in_the_truth():
    radar = Radar(range_start=2000.0, cells=64, reference_range=5000.0)
    targets = [Target(Path(0.0, -d, 0.0, 0.0), 20.0, "none") for d in (1000.0, 5000.0, 20_000.0)]
    _, truth = joined(run(Scenario(radar, tuple(targets)), scans=2))
    assert truth["id"].tolist() == [2, 2]


def test_a_target_appears_and_disappears():
    path = Path(0.0, -3000.0, 0.0, 0.0, appears=3.5, disappears=7.5)
    sweeps, truth = joined(run(Scenario(TINY.radar, (Target(path, 25.0, "none"),)), scans=5))
    np.testing.assert_allclose(truth["time_offset"], [5.0, 7.0])
    bright = sweeps["time_offset"][(sweeps["video"] > 8 * TINY.radar.noise_level).any(axis=1)]
    assert np.all((bright >= 3.5) & (bright < 7.5))
    assert len(bright) >= 10


def test_elapsed_time_is_that_of_the_pulses_received():
    simulator = Simulator(TINY, sectors=4)
    assert simulator.elapsed == 0.0
    next(simulator)
    assert simulator.elapsed == pytest.approx(0.5)


def test_without_a_number_of_scans_the_antenna_turns_for_ever():
    simulator = Simulator(TINY, sectors=2)
    for _ in range(40):
        next(simulator)
    assert simulator.elapsed == pytest.approx(40.0)


def test_more_sectors_than_pulses_are_refused():
    with pytest.raises(ParameterError, match="sectors 301 exceed the 300 pulses"):
        Simulator(TINY, sectors=301)


def test_parameters_build_the_same_simulator():
    digital = {"sample": "uint8", "video_law": "logarithmic"}
    parameters = SimulatorParameters(scenario="tiny", seed=9, scans=2, sectors=8, **digital)
    by_name = list(Simulator.from_parameters(parameters))
    by_hand = run(seed=9, scans=2, sectors=8, **digital)
    assert [s.sweeps.stamp for s in by_name] == [s.sweeps.stamp for s in by_hand]
    for one, other in zip(by_name, by_hand, strict=True):
        assert one.sweeps.rows.tobytes() == other.sweeps.rows.tobytes()
