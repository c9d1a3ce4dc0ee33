# SPDX-License-Identifier: Apache-2.0
"""What holds for every kind of clutter and interference: seeds, cutting, independence, truth, refusal."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from radar_sim.clutter.sections import CLUTTER
from radar_sim.interference.sections import INTERFERENCE
from radar_sim.reception import Reception
from radar_sim.scenario import Scenario, ScenarioError, load_scenario, parse_scenario
from radar_sim.simulator import Simulator

# 97.5 pulses a turn: turns, sectors and texture fit nowhere.
RADAR = """
radar: {scan_period: 0.5, pulse_rate: 195.0, beamwidth_deg: 12.0, cells: 21, range_step: 500.0, wavelength: 0.1}
targets: [{x: 3000.0, y: 4000.0, fluctuation: slow-dominant, snr_db: 30.0}]
"""
KINDS = {
    "land": "clutter: {patches: [{range_to: 8000.0, azimuth_from_deg: 250.0, azimuth_to_deg: 400.0}]}",
    "sea": "clutter: {patches: [{law: k, lifetime: 1.0, speed_spread: 0.2}]}",
    "autoregressive": "clutter: {patches: [{spectrum: exponential, grain_azimuth_deg: 0.5}]}",
    "white": "clutter: {patches: [{spectrum: white, law: k}]}",
    "rain": "clutter: {rain: [{y: 5000.0, radius: 2000.0, wind_speed: 90.0}, {y: 500.0, radius: 3000.0}]}",
    "points": "clutter: {points: [{range_to: 9000.0, number: 20}]}",
    "radars": "interference: {radars: [{pulse_rate: 5000.0, stagger: 0.7, pulse_length: 8.0e-6}]}",
    "jammers": "interference: {jammers: [{on_time: 0.3, off_time: 0.4, azimuth_deg: 300.0}]}",
}
ALL = parse_scenario(RADAR)
EACH = {name: parse_scenario(RADAR + text) for name, text in KINDS.items()}
EVERYTHING = Scenario(
    ALL.radar,
    ALL.targets,
    disturbances=tuple(section for one in EACH.values() for section in one.disturbances),
)


def video_of(scenario, sectors=1, scans=3, **settings):
    simulator = Simulator(scenario, sectors=sectors, scans=scans, **settings)
    return np.concatenate([sector.sweeps.rows["video"] for sector in simulator])


@pytest.mark.parametrize("name", KINDS)
def test_each_kind_changes_the_video_and_not_the_truth(name):
    with_it, without = (list(Simulator(s, sectors=1, scans=2)) for s in (EACH[name], ALL))
    for one, other in zip(with_it, without, strict=True):
        assert one.truth.rows.tobytes() == other.truth.rows.tobytes()
    power, bare = (
        sum(np.square(s.sweeps.rows["video"].astype(float)).sum() for s in sectors)
        for sectors in (with_it, without)
    )
    assert power > 1.5 * bare


@pytest.mark.parametrize("name", KINDS)
@settings(max_examples=4, deadline=None)
@given(sectors=st.integers(2, 40), seed=st.integers(0, 2**32))
def test_the_division_into_sectors_changes_no_bit(name, sectors, seed):
    whole = video_of(EACH[name], seed=seed)
    assert video_of(EACH[name], sectors=sectors, seed=seed).tobytes() == whole.tobytes()


@settings(max_examples=4, deadline=None)
@given(sectors=st.integers(2, 97), seed=st.integers(0, 2**32))
def test_nor_does_it_with_all_of_them(sectors, seed):
    whole = video_of(EVERYTHING, seed=seed)
    assert video_of(EVERYTHING, sectors=sectors, seed=seed).tobytes() == whole.tobytes()


@pytest.mark.parametrize("name", sorted(set(KINDS) - {"jammers"}))
def test_another_seed_gives_another_of_its_kind(name):
    quiet = Scenario(ALL.radar.changed({"noise_level": 1e-9}), disturbances=EACH[name].disturbances)
    one, same, other = (video_of(quiet, seed=seed, scans=1) for seed in (1, 1, 2))
    assert one.tobytes() == same.tobytes()
    assert one.tobytes() != other.tobytes()


def test_a_source_more_leaves_the_sources_before_it_as_they_are():
    def first_of(scenario):
        source, *_ = scenario.disturb(np.random.SeedSequence(3))
        reception = Reception(0, 97, ALL.radar.cells)
        source.add_to(reception)
        return reception.signals()[1]

    alone = Scenario(ALL.radar, disturbances=EVERYTHING.disturbances[:1])
    np.testing.assert_array_equal(first_of(alone), first_of(EVERYTHING))


@pytest.mark.parametrize("sample", ["float32", "uint8", "uint16"])
@pytest.mark.parametrize("law", ["linear", "logarithmic"])
def test_all_of_it_makes_video_of_every_format(sample, law):
    video = video_of(EVERYTHING, sample=sample, video_law=law, scans=1)
    assert video.dtype == sample
    assert np.isfinite(video).all()
    assert len(np.unique(video)) > 50


@pytest.mark.parametrize(
    "name", ["land", "sea", "rain", "interference", "jamming", "point_clutter", "noise"]
)
def test_the_studies_share_their_radar(name):
    scenario = load_scenario(name)
    assert scenario.radar == load_scenario("noise").radar
    assert bool(scenario.disturbances) == (name != "noise")
    assert not scenario.targets
    assert len(scenario.title) > 20


@pytest.mark.parametrize(
    ("text", "key", "reason"),
    [
        ("clutter: 3", "clutter", "keys and values"),
        ("clutter: {patch: []}", "clutter: unknown key patch", ""),
        ("clutter: {patches: 7}", "clutter.patches", "list"),
        ("clutter: {patches: [4]}", "clutter.patches[0]", "keys and values"),
        ("clutter: {patches: [{}, {cnr: 3.0}]}", "clutter.patches[1]: unknown parameter cnr", ""),
        ("clutter: {patches: [{law: gauss}]}", "clutter.patches[0]: law", "weibull"),
        ("clutter: {patches: [{shape: 2.5}]}", "clutter.patches[0]: shape", "[0.3, 2]"),
        ("clutter: {patches: [{shape: 0.1}]}", "clutter.patches[0]: shape", "[0.3, 2]"),
        ("clutter: {patches: [{law: k, shape: 0.0}]}", "clutter.patches[0]: shape", "0.05"),
        ("clutter: {patches: [{cnr_db: .inf}]}", "clutter.patches[0]: cnr_db", "finite"),
        ("clutter: {patches: [{spectrum: pink}]}", "clutter.patches[0]: spectrum", "exponential"),
        ("clutter: {patches: [{range_to: 500.0}]}", "clutter.patches[0]: range_to", "not beyond"),
        (
            "clutter: {patches: [{azimuth_from_deg: 90.0, azimuth_to_deg: 10.0}]}",
            "clutter.patches[0]: azimuth_to_deg",
            "add 360",
        ),
        (
            "clutter: {points: [{azimuth_from_deg: 0.0, azimuth_to_deg: 400.0}]}",
            "clutter.points[0]: azimuth_to_deg",
            "by 360 at most",
        ),
        (
            "clutter: {patches: [{range_from: 300000.0, range_to: 400000.0}]}",
            "clutter.patches[0]",
            "no range cell",
        ),
        ("clutter: {points: [{number: 0}]}", "clutter.points[0]: number", "[1, 100000]"),
        ("clutter: {rain: [{radius: 0.0}]}", "clutter.rain[0]: radius", "must be in"),
        ("interference: []", "interference", "keys and values"),
        ("interference: {noise: []}", "interference: unknown key noise", ""),
        ("interference: {jammers: [{jnr_db: loud}]}", "interference.jammers[0]: jnr_db", "float"),
        (
            "interference: {jammers: [{begins: 5.0, ends: 5.0}]}",
            "interference.jammers[0]: ends",
            "not after begins",
        ),
        ("interference: {jammers: [{off_time: 1.0}]}", "interference.jammers[0]", "on_time"),
        (
            "interference: {radars: [{pulse_rate: 9000.0, pulse_length: 0.0002}]}",
            "interference.radars[0]: pulse_length",
            "not below the interval",
        ),
        ("radar: {side_lobe_db: 3.0}", "radar: side_lobe_db", "[-80, 0]"),
        ("radar: {db_per_count: 0.0}", "radar: db_per_count", "must be in"),
    ],
)
def test_what_is_impossible_is_refused_with_file_key_and_reason(text, key, reason):
    with pytest.raises(ScenarioError) as caught:
        parse_scenario(text, source="faulty.yaml")
    message = str(caught.value)
    assert message.startswith("scenario faulty.yaml: ")
    assert key in message
    assert reason in message


@pytest.mark.parametrize(("key", "kinds"), [("clutter", CLUTTER), ("interference", INTERFERENCE)])
def test_every_kind_works_with_its_defaults(key, kinds):
    for kind in kinds:
        scenario = parse_scenario(f"{key}: {{{kind}: [{{}}]}}")
        assert np.isfinite(video_of(scenario, sectors=32, scans=1)).all()
