# SPDX-License-Identifier: Apache-2.0
"""How fast a scan of 4096 x 1024 cells is made, against real time and against its noise alone."""

from __future__ import annotations

from collections import deque

import numpy as np
import pytest

from radar_sim.clutter.patch import PatchSection
from radar_sim.clutter.points import PointsSection
from radar_sim.clutter.rain import RainSection
from radar_sim.interference.jammer import JammerSection
from radar_sim.interference.other_radar import OtherRadarSection
from radar_sim.radar import Radar
from radar_sim.scenario import Scenario, load_scenario
from radar_sim.simulator import Simulator
from radar_sim.traffic import TrafficGroup, TrafficSection

AIRPORT = load_scenario("airport")
CROWD = Scenario(
    AIRPORT.radar,
    traffic=(
        TrafficGroup(
            TrafficSection(
                number=2000, range_min=15_000.0, range_max=1e5, duration=600.0, snr_db=20.0
            )
        ),
    ),
)
# Every cell holds land or sea; over it rain, masts, another radar and a jammer.
LAND = PatchSection(range_from=0.0, range_to=111e3, azimuth_to_deg=180.0)
SEA = LAND.changed(
    {
        "law": "k",
        "azimuth_from_deg": 180.0,
        "azimuth_to_deg": 360.0,
        "speed_spread": 1.0,
        "lifetime": 5.0,
    }
)
DISTURBED = Scenario(
    AIRPORT.radar,
    AIRPORT.targets,
    AIRPORT.traffic,
    (
        LAND,
        SEA,
        RainSection(x=-40e3, y=30e3, radius=10e3),
        RainSection(x=30e3, y=-40e3, radius=8e3),
        PointsSection(number=300),
        OtherRadarSection(azimuth_deg=60.0),
        JammerSection(azimuth_deg=110.0),
    ),
)


def scan(simulator: Simulator, sectors: int = 32) -> None:
    for _ in range(sectors):
        next(simulator)


def bare_noise(radar: Radar, rng: np.random.Generator) -> None:
    deque((rng.rayleigh(size=(128, radar.cells)) for _ in range(32)), maxlen=0)


@pytest.mark.parametrize(
    ("scenario", "sample", "law"),
    [
        (AIRPORT, "float32", "linear"),
        (AIRPORT, "uint8", "linear"),
        (AIRPORT, "uint8", "logarithmic"),
        (CROWD, "float32", "linear"),
        (DISTURBED, "float32", "linear"),
    ],
    ids=[
        "60 aircraft",
        "60 aircraft, 8 bit",
        "60 aircraft, 8 bit logarithmic",
        "2000 aircraft",
        "60 aircraft, clutter in every cell",
    ],
)
@pytest.mark.benchmark(group="simulator")
def test_scan(benchmark, ratio, request, scenario, sample, law):
    simulator = Simulator(scenario, sample=sample, video_law=law)
    benchmark.pedantic(scan, args=(simulator,), rounds=8, warmup_rounds=1)
    times = scenario.radar.scan_period / benchmark.stats.stats.median
    name = request.node.callspec.id
    ratio(f"simulator, {name}", times, "times real time, goal 10")


@pytest.mark.benchmark(group="simulator")
def test_noise_alone(benchmark, ratio):
    radar = AIRPORT.radar
    benchmark.pedantic(
        bare_noise, args=(radar, np.random.default_rng(0)), rounds=4, warmup_rounds=1
    )
    times = radar.scan_period / benchmark.stats.stats.median
    ratio("numpy's rayleigh() for the same cells, no targets", times, "times real time")
