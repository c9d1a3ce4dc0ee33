# SPDX-License-Identifier: Apache-2.0
"""Bags with bearings run offline give what the pipelines of the nodes give, the same bits every time."""

from __future__ import annotations

import numpy as np
import pytest

from bearing_tracker.bearing_fusion import BearingFusion
from bearing_tracker.emitter_locator import EmitterLocator
from bearing_tracker.fusion_parameters import FusionParameters
from bearing_tracker.locator_parameters import LocatorParameters
from radar_common.bag import ODOMETRY, BagWriter, read_messages, read_tables, topics
from radar_common.tables import (
    BEARING,
    BEARINGS_TOPIC,
    CHANNEL_TRUTH_TOPIC,
    EMITTER,
    EMITTERS_TOPIC,
    FUSED_BEARINGS_TOPIC,
    NANOSECONDS,
    PLATFORM_TOPIC,
    PLOT,
    PLOTS_TOPIC,
    TRACK,
    TRACKS_TOPIC,
    TRUTH_TOPIC,
    BearingChannel,
    Table,
    TrackStatus,
)
from radar_eval.errors import EvaluationError
from radar_eval.offline import run_offline
from radar_eval.run_record import RunRecord
from radar_sim.bearings.parameters import BearingSimulatorParameters
from radar_sim.bearings.recording import record_bearings

WHAT_COMES_OUT = {FUSED_BEARINGS_TOPIC: BEARING, EMITTERS_TOPIC: EMITTER, BEARINGS_TOPIC: BEARING}
PLOTS = "bearing_fusion:\n  ros__parameters:\n    active_input: plots\n"


def plain(messages, total):
    return messages


def content(bag):
    return [
        (topic, table.stamp, table.frame_id, table.rows.tobytes())
        for topic, table in read_tables(bag, WHAT_COMES_OUT)
    ]


@pytest.fixture(scope="module")
def recorded(tmp_path_factory):
    """A radar and a direction finder at one place, 12 s."""
    bag = tmp_path_factory.mktemp("recorded") / "bag"
    record_bearings(BearingSimulatorParameters(scenario="countermeasures", duration=12.0), bag)
    return bag


@pytest.fixture(scope="module")
def from_plots(tmp_path_factory):
    """Parameters for a fusion without a tracker."""
    path = tmp_path_factory.mktemp("parameters") / "plots.yaml"
    path.write_text(PLOTS, encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def processed(recorded, from_plots, tmp_path_factory):
    """What the fusion and the locator make of it."""
    out = tmp_path_factory.mktemp("processed") / "bag"
    run_offline(recorded, out, parameters=from_plots, progress=plain)
    return out


def test_the_same_bag_gives_the_same_bits(recorded, processed, from_plots, tmp_path):
    run_offline(recorded, tmp_path / "again", parameters=from_plots, progress=plain)
    assert content(tmp_path / "again") == content(processed)
    assert len(content(processed)) > 60


def test_both_pipelines_are_those_of_the_nodes(recorded, processed):
    fusion = BearingFusion(FusionParameters(active_input="plots"))
    locator = EmitterLocator(LocatorParameters())
    fused, found = [], []
    tables = {PLOTS_TOPIC: PLOT, BEARINGS_TOPIC: BEARING}
    for topic, message in read_messages(recorded, tables, odometry=PLATFORM_TOPIC):
        if topic == PLATFORM_TOPIC:
            found.append(locator.process_platform(message))
            continue
        fused.append(fusion.process(message))
        if topic == BEARINGS_TOPIC:
            found.append(locator.process(message))
    fused.append(fusion.flush())
    found.append(locator.flush())
    for topic, wanted in ((FUSED_BEARINGS_TOPIC, fused), (EMITTERS_TOPIC, found)):
        written = [t for _, t in read_tables(processed, {topic: WHAT_COMES_OUT[topic]})]
        rows = b"".join(t.rows.tobytes() for t in written)
        assert rows == b"".join(t.rows.tobytes() for t in wanted)
        assert rows


def test_inputs_and_truth_come_along(recorded, processed):
    before, after = topics(recorded), topics(processed)
    for topic in (PLOTS_TOPIC, BEARINGS_TOPIC, TRUTH_TOPIC, CHANNEL_TRUTH_TOPIC):
        assert after[topic] == before[topic]
    assert topics(processed, ODOMETRY) == topics(recorded, ODOMETRY)
    stages = RunRecord.read(processed).stages
    assert set(stages) == {"bag", "bearing_fusion", "emitter_locator"}
    assert stages["bearing_fusion"].counts["fused bearings out"] > 50


def test_what_came_out_can_go_in_again(processed, from_plots, tmp_path):
    run_offline(processed, tmp_path / "again", parameters=from_plots, progress=plain)
    assert set(topics(tmp_path / "again")) == set(topics(processed))


def test_tracks_of_a_bag_without_plots_are_fused(make_tracks_bag, tmp_path):
    out = tmp_path / "out"
    run_offline(make_tracks_bag(tmp_path / "bag"), out, progress=plain)
    fused = [t.rows for _, t in read_tables(out, {FUSED_BEARINGS_TOPIC: BEARING})]
    assert set(np.concatenate(fused)["id"].tolist()) == {7}
    assert TRACKS_TOPIC in topics(out)
    assert set(RunRecord.read(out).stages) == {"bag", "bearing_fusion"}


@pytest.fixture
def make_tracks_bag():
    def write(path):
        with BagWriter(path) as writer:
            for second in range(8):
                stamp = second * NANOSECONDS
                tracks, heard = np.zeros(1, TRACK), np.zeros(1, BEARING)
                tracks["y"], tracks["plot_azimuth"], tracks["id"] = 2e4, 0.0, 7
                tracks["covariance"] = (np.eye(4) * 100.0).ravel()
                tracks["status"] = TrackStatus.CONFIRMED
                heard["azimuth_std"], heard["channel"] = 0.01, BearingChannel.PASSIVE
                writer.write(TRACKS_TOPIC, Table(stamp, tracks))
                writer.write(BEARINGS_TOPIC, Table(stamp, heard))
        return path

    return write


def test_a_moving_finder_without_a_radar_locates_only(tmp_path):
    bag, out = tmp_path / "bag", tmp_path / "out"
    record_bearings(BearingSimulatorParameters(scenario="direction_finder", duration=6.0), bag)
    run_offline(bag, out, progress=plain)
    assert set(topics(out)) >= {EMITTERS_TOPIC, BEARINGS_TOPIC}
    assert FUSED_BEARINGS_TOPIC not in topics(out)


def test_bearings_of_another_layout_are_one_clear_error(tmp_path):
    with BagWriter(tmp_path / "bag") as writer:
        writer.write(BEARINGS_TOPIC, Table(0, np.zeros(3, PLOT)))
    with pytest.raises(EvaluationError, match="passive/bearings"):
        run_offline(tmp_path / "bag", tmp_path / "out", progress=plain)
    assert not (tmp_path / "out").exists()
