# SPDX-License-Identifier: Apache-2.0
"""How fast a scan of 4096 x 1024 cells is made, against real time and against its noise alone."""

from __future__ import annotations

from collections import deque

import numpy as np
import pytest

from radar_sim.radar import Radar
from radar_sim.scenario import Scenario, load_scenario
from radar_sim.simulator import Simulator
from radar_sim.traffic import TrafficSection

AIRPORT = load_scenario("airport")
CROWD = Scenario(
    AIRPORT.radar,
    traffic=(
        TrafficSection(number=2000, range_min=15_000.0, range_max=1e5, duration=600.0, snr_db=20.0),
    ),
)


def scan(simulator: Simulator, sectors: int = 32) -> None:
    for _ in range(sectors):
        next(simulator)


def bare_noise(radar: Radar, rng: np.random.Generator) -> None:
    deque((rng.rayleigh(size=(128, radar.cells)) for _ in range(32)), maxlen=0)


@pytest.mark.parametrize(
    ("scenario", "sample"),
    [(AIRPORT, "float32"), (AIRPORT, "uint8"), (CROWD, "float32")],
    ids=["60 aircraft", "60 aircraft, 8 bit", "2000 aircraft"],
)
@pytest.mark.benchmark(group="simulator")
def test_scan(benchmark, ratio, request, scenario, sample):
    simulator = Simulator(scenario, sample=sample)
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
