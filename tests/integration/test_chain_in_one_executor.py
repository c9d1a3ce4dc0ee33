# SPDX-License-Identifier: Apache-2.0
"""Simulator, extractor and tracker in one executor give what the offline pipelines give, bit for bit."""

from __future__ import annotations

import numpy as np
import pytest
from rclpy.parameter import Parameter

from primary_proc.parameters import ExtractorParameters
from primary_proc.plot_extractor import PlotExtractor
from primary_proc.plot_extractor_node import PlotExtractorNode
from radar_common.health import Health
from radar_common.tables import PLOTS_TOPIC, TRACKS_TOPIC, TRUTH_TOPIC, TrackStatus
from radar_sim.parameters import SimulatorParameters
from radar_sim.radar_simulator_node import RadarSimulatorNode
from radar_sim.simulator import Simulator
from secondary_proc.parameters import TrackerParameters
from secondary_proc.tracker import Tracker
from secondary_proc.tracker_node import TrackerNode

SCANS = 12
SECTORS = 32
TINY_BEAMWIDTH_DEG = 10.0


@pytest.fixture
def live(context, executor, listener, spin_until, lossless):
    """Run the chain for some scans and return what was heard."""
    finished = []
    extractor = PlotExtractorNode(
        context=context,
        parameter_overrides=[
            Parameter("beamwidth_deg", value=TINY_BEAMWIDTH_DEG),
            *(Parameter(k, value=v) for k, v in lossless["plot_extractor"].items()),
        ],
    )
    settings = {
        "scenario": "tiny",
        "scans": SCANS,
        "rate": 4.0,
        "wait_for_subscribers": 1,
        "wait_for_truth_subscribers": 1,
    }
    executor.add_node(extractor)
    tracker = [Parameter(k, value=v) for k, v in lossless["tracker"].items()]
    executor.add_node(TrackerNode(context=context, parameter_overrides=tracker))
    spin_until(listener.ready, "plots and tracks to be offered")
    executor.add_node(
        RadarSimulatorNode(
            context=context,
            on_finished=lambda: finished.append(True),
            parameter_overrides=[Parameter(k, value=v) for k, v in settings.items()],
        )
    )
    tables = listener.tables
    spin_until(lambda: len(tables[PLOTS_TOPIC]) == SCANS * SECTORS, "all sectors of plots")
    spin_until(lambda: len(tables[TRACKS_TOPIC]) == SCANS * SECTORS, "all sectors of tracks")
    assert finished
    return listener


def offline(start):
    health = Health()
    simulator = Simulator.from_parameters(SimulatorParameters(scenario="tiny", scans=SCANS))
    simulator.start = start
    extractor = PlotExtractor(ExtractorParameters(beamwidth_deg=TINY_BEAMWIDTH_DEG), health)
    tracker = Tracker(TrackerParameters(), health)
    for sector in simulator:
        plots = extractor.process(sector.sweeps)
        yield sector.truth, plots, tracker.process(plots)


def test_live_equals_offline(live):
    start = live.tables[TRUTH_TOPIC][0].stamp
    expected = list(offline(start))
    for position, topic in enumerate((TRUTH_TOPIC, PLOTS_TOPIC, TRACKS_TOPIC)):
        heard = live.tables[topic]
        assert len(heard) == len(expected)
        for table, tables in zip(heard, expected, strict=True):
            assert table.stamp == tables[position].stamp
            assert table.rows.tobytes() == tables[position].rows.tobytes()


def test_every_target_of_the_scene_has_one_confirmed_track_where_it_is(live):
    tracks, truth = live.rows(TRACKS_TOPIC), live.rows(TRUTH_TOPIC)
    confirmed = tracks[tracks["status"] == TrackStatus.CONFIRMED]
    final = {i: confirmed[confirmed["id"] == i][-1] for i in np.unique(confirmed["id"])}
    for target in np.unique(truth["id"]):
        last = truth[truth["id"] == target][-1]
        near = [
            row
            for row in final.values()
            if np.hypot(row["x"] - last["x"], row["y"] - last["y"]) < 500.0
        ]
        assert len(near) == 1
    assert not live.health.dropped
