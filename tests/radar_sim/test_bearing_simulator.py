# SPDX-License-Identifier: Apache-2.0
"""The bearing simulator's messages: their order, their repeatability, and the targets it shares with the radar."""

from __future__ import annotations

import numpy as np
import pytest

from radar_common.bag import read_odometry, read_tables, topics
from radar_common.frames import wrap_pi
from radar_common.odometry import PlatformState
from radar_common.parameters import ParameterError
from radar_common.tables import (
    BEARING,
    BEARINGS_TOPIC,
    CHANNEL_TRUTH_TOPIC,
    NANOSECONDS,
    PLATFORM_TOPIC,
    PLOT,
    PLOTS_TOPIC,
    TRUTH,
    TRUTH_TOPIC,
    BearingChannel,
)
from radar_sim.bearings.parameters import BearingSimulatorParameters
from radar_sim.bearings.recording import record_bearings
from radar_sim.bearings.simulator import BearingSimulator
from radar_sim.motion import State
from radar_sim.recording import RecordingError
from radar_sim.scenario import load_scenario, parse_scenario
from radar_sim.simulator import Simulator

NAMES = ["countermeasures", "detkov", "direction_finder", "ship"]
DTYPES = {
    BEARINGS_TOPIC: BEARING,
    PLOTS_TOPIC: PLOT,
    TRUTH_TOPIC: TRUTH,
    CHANNEL_TRUTH_TOPIC: BEARING,
}


def as_bytes(message):
    content = message.content
    body = content if isinstance(content, PlatformState) else content.rows.tobytes()
    return (message.due, message.topic, content.stamp, body)


@pytest.mark.parametrize("name", NAMES)
def test_the_same_seed_gives_the_same_messages_in_order(name):
    scenario = load_scenario(name)
    assert scenario.title
    one, same, other = (
        [as_bytes(m) for m in BearingSimulator(scenario, seed=seed, duration=120.0)]
        for seed in (1, 1, 2)
    )
    assert one == same
    assert one != other
    due = [message[0] for message in one]
    assert due == sorted(due)
    assert {message[1] for message in one} >= {PLATFORM_TOPIC, BEARINGS_TOPIC}


@pytest.mark.parametrize("name", NAMES)
def test_a_longer_run_begins_as_a_shorter_one_does(name):
    scenario = load_scenario(name)
    longer = list(map(as_bytes, BearingSimulator(scenario, duration=150.0)))
    shorter = list(map(as_bytes, BearingSimulator(scenario, duration=90.0)))
    assert 0 < len(shorter) < len(longer)
    for topic in {message[1] for message in longer}:
        of_topic = [m for m in longer if m[1] == topic]
        begun = [m for m in shorter if m[1] == topic]
        # Where two sensors write one topic, a late look of one stands behind the last of the other.
        assert begun[:-2] == of_topic[: len(begun)][:-2]


def test_tables_have_their_dtypes_frames_and_stamps():
    start = 7 * NANOSECONDS
    for message in BearingSimulator(load_scenario("countermeasures"), duration=10.0, start=start):
        content = message.content
        assert start <= content.stamp <= start + round(message.due * NANOSECONDS)
        if message.topic in DTYPES:
            assert content.rows.dtype == DTYPES[message.topic]
            assert content.frame_id == ("radar" if message.topic == PLOTS_TOPIC else "map")


def test_the_radar_and_the_direction_finder_see_the_same_targets():
    scenario = load_scenario("countermeasures")
    radar = Simulator(scenario, seed=5, scans=12)
    tables = [sector.truth for sector in radar]
    truth = np.concatenate([table.rows for table in tables])
    times = np.concatenate([table.times for table in tables])
    sources = BearingSimulator(scenario, seed=5).sources
    still = np.zeros((len(times), len(sources)))
    here = State(still, still, still, still)
    sight = sources.seen(np.repeat(times[:, None], len(sources), axis=1), here, 0.0)
    column = truth["id"].astype(int) - 1
    row = np.arange(len(times))
    np.testing.assert_allclose(sight.x[row, column], truth["x"], atol=0.01)
    np.testing.assert_allclose(sight.azimuth[row, column], truth["azimuth"], atol=1e-6)
    assert set(truth["id"]) == {1, 2, 3, 4}


def test_bearings_start_from_the_platform_that_odometry_tells():
    text = """
direction_finder:
  speed: 120.0
  course_deg: 30.0
  legs: [{duration: 20.0, turn_rate_deg: 2.0}, {duration: 20.0, turn_rate_deg: -2.0}]
  cycles: 3
  azimuth_std_deg: 1.0e-9
  odometry_period: 1.0
emitters: [{x: 9000.0, y: 14000.0}]
"""
    poses, bearings = {}, {}
    for message in BearingSimulator(parse_scenario(text), duration=150.0):
        if message.topic == PLATFORM_TOPIC:
            poses[message.content.stamp] = message.content
        elif message.topic == BEARINGS_TOPIC:
            bearings[message.content.stamp] = message.content.rows["azimuth"][0]
    assert len(poses) == 151
    for stamp, azimuth in bearings.items():
        pose = poses[stamp]
        expected = np.arctan2(9000.0 - pose.x, 14_000.0 - pose.y)
        assert float(wrap_pi(azimuth - expected)) == pytest.approx(0.0, abs=1e-9)
    # Three cycles of legs, then straight on; the nose points along the velocity and turns as told.
    rates = np.degrees([pose.turn_rate for pose in poses.values()])
    assert rates[[5, 25, 45, 65, 105]] == pytest.approx([2.0, -2.0, 2.0, -2.0, -2.0], abs=1e-3)
    assert rates[130] == pytest.approx(0.0, abs=1e-6)
    for pose in poses.values():
        assert (np.sin(pose.course), np.cos(pose.course)) == pytest.approx(
            (pose.vx / 120.0, pose.vy / 120.0)
        )


def test_detkov_is_the_realisation_of_the_paper():
    simulator = BearingSimulator(load_scenario("detkov"), duration=350.0)
    rows = np.concatenate([m.content.rows for m in simulator if m.topic == CHANNEL_TRUTH_TOPIC])
    for channel in (BearingChannel.ACTIVE, BearingChannel.PASSIVE):
        steps = rows[rows["channel"] == channel]
        assert len(steps) == 351
        jammed = np.flatnonzero(steps["active_health"][:, 1] == 1.0)
        silent = np.flatnonzero(steps["passive_health"][:, 1] == 1.0)
        assert (jammed[0], jammed[-1], len(jammed)) == (51, 100, 50)
        assert (silent[0], silent[-1], len(silent)) == (201, 250, 50)


def test_the_ship_is_five_kilometres_away_on_eighty_degrees():
    simulator = BearingSimulator(load_scenario("ship"), duration=1800.0)
    truth = [m.content.rows[0] for m in simulator if m.topic == TRUTH_TOPIC]
    assert len(truth) == 31
    assert truth[0]["range"] == pytest.approx(5000.0, rel=1e-3)
    assert np.degrees(truth[0]["azimuth"]) == pytest.approx(80.0, abs=0.01)


def test_without_the_active_channel_there_are_no_plots_but_its_truth_stays():
    scenario = load_scenario("countermeasures")
    messages = list(BearingSimulator(scenario, duration=70.0, active=False))
    assert PLOTS_TOPIC not in {m.topic for m in messages}
    rows = np.concatenate([m.content.rows for m in messages if m.topic == CHANNEL_TRUTH_TOPIC])
    assert (rows["active_health"][:, 1] == 1.0).any()


@pytest.mark.parametrize(
    ("text", "active", "reason"),
    [("targets: [{}]", True, "neither"), ("channels: {active: {}}", False, "nothing to simulate")],
)
def test_a_scenario_without_bearings_is_refused(text, active, reason):
    with pytest.raises(ParameterError, match=reason):
        BearingSimulator(parse_scenario(text), active=active)


PARAMETERS = BearingSimulatorParameters(scenario="countermeasures", duration=12.0, seed=4)


def test_the_bag_holds_the_simulation(tmp_path):
    lines = []
    record_bearings(PARAMETERS, tmp_path / "bag", report=lines.append)
    made = list(BearingSimulator.from_parameters(PARAMETERS))
    assert lines == [f"{len(made)} messages of 12 s in {tmp_path / 'bag'}"]
    written = {topic: [] for topic in DTYPES}
    for topic, table in read_tables(tmp_path / "bag", DTYPES):
        written[topic].append((table.stamp, table.rows.tobytes()))
    assert set(topics(tmp_path / "bag")) == set(DTYPES)
    for topic, tables in written.items():
        expected = [m.content for m in made if m.topic == topic]
        assert tables == [(c.stamp, c.rows.tobytes()) for c in expected]
    states = list(read_odometry(tmp_path / "bag", PLATFORM_TOPIC))
    assert [s.stamp for s in states] == [m.content.stamp for m in made if m.topic == PLATFORM_TOPIC]


def test_the_same_parameters_give_the_same_bag(tmp_path):
    for name in ("one", "two"):
        (tmp_path / name).mkdir()
        record_bearings(PARAMETERS, tmp_path / name / "bag")
    first, second = ((tmp_path / name / "bag" / "bag.mcap").read_bytes() for name in ("one", "two"))
    assert first == second


def test_an_endless_simulation_is_not_written(tmp_path):
    with pytest.raises(ParameterError, match="duration"):
        record_bearings(PARAMETERS.changed({"duration": 0.0}), tmp_path / "bag")


def test_an_existing_folder_is_not_touched(tmp_path):
    with pytest.raises(RecordingError, match="exists"):
        record_bearings(PARAMETERS, tmp_path)
    assert not any(tmp_path.iterdir())
