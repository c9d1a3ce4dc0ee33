# SPDX-License-Identifier: Apache-2.0
"""Scenarios: those of the package are sound, and a faulty one is refused with file, key and reason."""

from __future__ import annotations

import numpy as np
import pytest

from radar_sim.scenario import ScenarioError, load_scenario, parse_scenario, scenario_names
from radar_sim.simulator import Simulator

RADAR = "radar: {cells: 64}\n"
BEARINGS = ["countermeasures", "detkov", "direction_finder", "ship"]
STUDIES = ["interference", "jamming", "land", "noise", "point_clutter", "rain", "sea"]


def test_the_scenarios_of_the_package_are_listed():
    assert scenario_names() == sorted(["airport", "coast", "tiny", *STUDIES, *BEARINGS])


@pytest.mark.parametrize("name", ["airport", "coast", "tiny"])
def test_a_scenario_of_the_package_shows_most_of_its_targets(name):
    scenario = load_scenario(name)
    assert scenario.title
    simulator = Simulator(scenario, scans=1, sectors=4)
    ids = np.concatenate([sector.truth.rows["id"] for sector in simulator])
    assert len(np.unique(ids)) >= 0.8 * len(simulator.targets)


def test_the_airport_is_the_radar_of_the_description():
    scenario = load_scenario("airport")
    radar = scenario.radar
    assert len(scenario.draw(np.random.default_rng(0))) == 60
    assert (radar.scan_period, radar.pulses_per_scan, radar.cells) == (4.0, 4096.0, 1024)
    assert radar.range_end / 1852.0 == pytest.approx(60.0, rel=0.01)
    assert radar.noise_level != 1.0


def test_the_coast_turns_24_times_a_minute():
    scenario = load_scenario("coast")
    assert 60.0 / scenario.radar.scan_period == 24.0
    targets = scenario.draw(np.random.default_rng(0))
    state = targets.fleet.state(np.arange(len(targets)), np.zeros(len(targets)))
    assert np.hypot(state.vx, state.vy).max() < 25.0


def test_a_scenario_is_read_from_a_path(tmp_path):
    path = tmp_path / "mine.yaml"
    path.write_text(f"title: mine\n{RADAR}targets:\n  - {{x: 0, y: 5000, speed: 10}}\n", "utf-8")
    scenario = load_scenario(path)
    assert scenario.title == "mine"
    assert scenario.radar.cells == 64
    assert scenario.targets[0].path.speed == 10


@pytest.mark.parametrize(
    ("text", "key", "reason"),
    [
        ("direction_finder: {period: 0.0}", "direction_finder: period", "must be in"),
        ("direction_finder: {spread: 2.0}", "direction_finder: spread 2", "longer than period"),
        ("direction_finder: {azimuth_std_deg: 0.0}", "direction_finder", "must not both be 0"),
        ("direction_finder: {legs: [{}], cycles: 0}", "direction_finder: cycles", "must be in"),
        ("emitters: [{}]", "", "need a direction_finder or channels.active"),
        ("channels: {both: {}}", "channels: unknown key both", ""),
        ("channels: {active: 3}", "channels.active", "keys and values"),
        ("channels: {active: {intervals: 3}}", "channels.active.intervals", "list"),
        (
            "channels: {active: {intervals: [{begins: 9.0, ends: 8.0}]}}",
            "channels.active.intervals[0]: ends 8",
            "not after begins",
        ),
        (
            "channels: {active: {}, passive: {silence: loud}}",
            "channels.passive: silence",
            "nothing, noise",
        ),
        (
            "{direction_finder: {}, emitters: [{target: 1}]}",
            "emitters[0]",
            "no target 1 among 0",
        ),
        (
            "{direction_finder: {}, targets: [{}], emitters: [{target: 1, legs: [{}]}]}",
            "emitters[0]",
            "those of its target",
        ),
        (
            "{direction_finder: {}, emitters: [{off_time: 3.0}]}",
            "emitters[0]: off_time 3",
            "needs an on_time",
        ),
        ("{channels: {active: {}}, bearing_processes: 1}", "bearing_processes", "list"),
        ("", "", "top level"),
        ("- 1", "", "top level"),
        ("radar: [", "", "expected"),
        ("radar: 7", "radar", "keys and values"),
        ("radars: {}", "radars", "unknown key"),
        ("radar: {prf: 1000.0}", "radar: unknown parameter prf", ""),
        ("radar: {cells: 2}", "radar: cells", "[4, 65536]"),
        ("radar: {cells: many}", "radar: cells", "int"),
        ("radar: {pattern: cosine}", "radar: pattern", "gaussian"),
        ("radar: {noise_level: 0.0}", "radar: noise_level", "[1e-09"),
        ("radar: {noise_level: .nan}", "radar: noise_level", "finite"),
        ("radar: {pulse_rate: 20000.0}", "radar: pulse_rate", "ambiguous"),
        ("targets: 3", "targets", "list"),
        ("targets: [3]", "targets[0]", "keys and values"),
        ("targets: [{}, {fluctuation: medium}]", "targets[1]: fluctuation", "slow"),
        ("targets: [{legs: 4}]", "targets[0].legs", "list"),
        ("targets: [{legs: [{}, {duration: -1.0}]}]", "targets[0].legs[1]: duration", "must be in"),
        (
            "targets: [{speed: 50.0, legs: [{duration: 10.0, acceleration: -6.0}]}]",
            "targets[0]: legs[0]",
            "speed -10 m/s",
        ),
        (
            "targets: [{speed: 0.0, legs: [{centripetal: 5.0}]}]",
            "targets[0]: legs[0]",
            "centripetal acceleration at the speed 0",
        ),
        (
            "targets: [{legs: [{jump_speed: -200.0}]}]",
            "targets[0]: legs[0]",
            "must not be negative",
        ),
        (
            "targets: [{legs: [{centripetal: 5.0, turn_rate_deg: 1.0}]}]",
            "targets[0].legs[0]",
            "exclude each other",
        ),
        ("targets: [{motion: {}}]", "targets[0].motion", "one of polynomial"),
        ("targets: [{motion: {model: game}}]", "targets[0].motion", "one of polynomial"),
        ("targets: [{motion: 3}]", "targets[0].motion", "keys and values"),
        (
            "targets: [{motion: {model: arcs, step: 1.0}}]",
            "targets[0].motion: unknown parameter step",
            "",
        ),
        (
            "targets: [{legs: [{}], motion: {model: arcs}}]",
            "targets[0]",
            "legs and motion exclude each other",
        ),
        ("traffic: [{wander: {std: -1.0}}]", "traffic[0].wander: std", "[0, 100000]"),
        ("traffic: [{speed_min: 300.0}]", "traffic[0]: speed_min 300", "greater than speed_max"),
        ("traffic: [{range_min: 90000.0}]", "traffic[0]: range_min", "greater than range_max"),
        ("traffic: [{steady: 0.6, fast: 0.6}]", "traffic[0]: steady", "above 1"),
    ],
)
def test_a_faulty_scenario_is_refused_with_file_key_and_reason(text, key, reason):
    with pytest.raises(ScenarioError) as caught:
        parse_scenario(text, source="faulty.yaml")
    message = str(caught.value)
    assert message.startswith("scenario faulty.yaml: ")
    assert key in message
    assert reason in message


def test_an_unknown_name_is_refused_with_the_names_known():
    with pytest.raises(
        ScenarioError, match=r"nowhere: neither one of airport, coast, .*, tiny nor"
    ):
        load_scenario("nowhere")


def test_a_file_that_is_no_text_is_refused(tmp_path):
    path = tmp_path / "noise.yaml"
    path.write_bytes(b"\xff\xfe\x00\x81")
    with pytest.raises(ScenarioError, match="readable"):
        load_scenario(path)


MOVING = """
targets:
  - {x: 1000.0, motion: {model: correlated, acceleration_std: 3.0}}
  - {x: 2000.0, legs: [{duration: 20.0, centripetal: 9.0, jump_course_deg: 30.0}]}
  - {x: 3000.0, wander: {std: 50.0}}
traffic:
  - {number: 3, motion: {model: arcs}, wander: {}}
  - {number: 2}
"""


def test_targets_and_groups_move_at_random_as_asked():
    scenario = parse_scenario(MOVING)

    def draw(seed):
        targets = scenario.draw(np.random.default_rng(seed))
        everyone = np.arange(len(targets))
        return targets.fleet.state(everyone, np.full(len(targets), 60.0))

    one, same, other = draw(1), draw(1), draw(2)
    assert one.x.tobytes() == same.x.tobytes()
    assert (one.x != other.x).tolist() == [True, False, *[True] * 6]


def test_a_target_moves_as_it_did_whatever_comes_after_it():
    scenario = parse_scenario(MOVING)
    more = parse_scenario(MOVING.replace("traffic:", "  - {motion: {model: arcs}}\ntraffic:"))
    first, second = (s.draw(np.random.default_rng(3)) for s in (scenario, more))
    index, time = np.arange(3), np.full(3, 100.0)
    assert first.fleet.state(index, time).x.tobytes() == second.fleet.state(index, time).x.tobytes()
