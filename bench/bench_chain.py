# SPDX-License-Identifier: Apache-2.0
"""The whole chain, sweeps to tracks, against real time: 4096 pulses of 1024 cells in 4 s, 60 aircraft, one core."""

from __future__ import annotations

import itertools

import pytest

from primary_proc.parameters import ExtractorParameters
from primary_proc.plot_extractor import PlotExtractor
from radar_sim.parameters import SimulatorParameters
from radar_sim.simulator import Simulator
from secondary_proc.parameters import TrackerParameters
from secondary_proc.tracker import Tracker

SECTORS = 32
SCANS = 10
PERIOD = 4.0


@pytest.mark.benchmark(group="sweeps to tracks, one scan")
def test_sweeps_to_tracks(benchmark, ratio):
    simulator = Simulator.from_parameters(SimulatorParameters(scenario="airport"))
    sweeps = [sector.sweeps for sector in itertools.islice(simulator, SCANS * SECTORS)]
    extractor, tracker = PlotExtractor(ExtractorParameters()), Tracker(TrackerParameters())
    sectors = iter(sweeps)

    def one_scan():
        for table in itertools.islice(sectors, SECTORS):
            tracker.process(extractor.process(table))

    benchmark.pedantic(one_scan, rounds=SCANS)
    spare = PERIOD / benchmark.stats.stats.median
    ratio("sweeps to tracks, 60 aircraft", spare, "times real time, goal 5")
