# SPDX-License-Identifier: Apache-2.0
"""The chain as separate processes over DDS: recorded, replayed, killed and restarted."""

from __future__ import annotations

import os
import signal

import numpy as np
import pytest

from radar_common.bag import read_tables, topics
from radar_common.tables import (
    PLOT,
    PLOTS_TOPIC,
    SWEEPS_TOPIC,
    TRACK,
    TRACKS_TOPIC,
    TRUTH,
    TRUTH_TOPIC,
    TrackStatus,
)
from radar_eval.live_chain import record_live_chain
from radar_eval.offline import run_offline
from radar_sim.parameters import SimulatorParameters
from radar_sim.recording import record

SCANS = 8
SECTORS = 32
TINY_BEAMWIDTH_DEG = 10.0
EXTRACTOR = ["--ros-args", "-p", f"beamwidth_deg:={TINY_BEAMWIDTH_DEG}"]


def test_three_processes_track_every_target_of_the_recording(tmp_path):
    bag = tmp_path / "live"
    record_live_chain(
        bag,
        tmp_path / "logs",
        scenario="tiny",
        scans=SCANS,
        rate=8.0,
        seed=3,
        extractor={"beamwidth_deg": TINY_BEAMWIDTH_DEG},
    )
    assert set(topics(bag)) == {PLOTS_TOPIC, TRACKS_TOPIC, TRUTH_TOPIC}
    expected = {TRACKS_TOPIC: TRACK, TRUTH_TOPIC: TRUTH}
    tables = {topic: [] for topic in expected}
    for topic, table in read_tables(bag, expected):
        tables[topic].append(table.rows)
    tracks = np.concatenate(tables[TRACKS_TOPIC])
    confirmed = np.unique(tracks["id"][tracks["status"] == TrackStatus.CONFIRMED])
    targets = np.unique(np.concatenate(tables[TRUTH_TOPIC])["id"])
    assert len(confirmed) == len(targets) == 4


@pytest.fixture(scope="module")
def recording(tmp_path_factory):
    path = tmp_path_factory.mktemp("recording") / "sweeps"
    record(SimulatorParameters(scenario="tiny", scans=SCANS), path)
    return path


def quietly(messages, total):
    return messages


def test_a_played_bag_gives_the_tracks_of_the_offline_run(
    recording, listener, ros2, lossless_arguments, spin_until, tmp_path
):
    extractor = ["run", "primary_proc", "plot_extractor", *EXTRACTOR]
    extractor += lossless_arguments["plot_extractor"]
    with (
        ros2("run", "secondary_proc", "tracker", "--ros-args", *lossless_arguments["tracker"]),
        ros2(*extractor),
    ):
        spin_until(listener.ready, "extractor and tracker")
        # The delay is the player's own: it lets subscriptions be discovered, as `ros2 bag play` offers it.
        with ros2("bag", "play", str(recording), "--delay", "2", "--rate", "4"):
            spin_until(lambda: len(listener.tables[TRACKS_TOPIC]) == SCANS * SECTORS, "all tracks")
    parameters = tmp_path / "tiny.yaml"
    parameters.write_text(
        f"plot_extractor: {{ros__parameters: {{beamwidth_deg: {TINY_BEAMWIDTH_DEG}}}}}\n"
    )
    run_offline(recording, tmp_path / "offline", parameters=parameters, progress=quietly)
    for topic, dtype in ((PLOTS_TOPIC, PLOT), (TRACKS_TOPIC, TRACK)):
        expected = [t for _, t in read_tables(tmp_path / "offline", {topic: dtype})]
        heard = listener.tables[topic]
        assert [t.stamp for t in heard] == [t.stamp for t in expected[: len(heard)]]
        for live, offline in zip(heard, expected, strict=False):
            for name in dtype.names:
                np.testing.assert_array_equal(live.rows[name], offline.rows[name], err_msg=name)


@pytest.mark.parametrize(
    ("node", "topic"), [("plot_extractor", PLOTS_TOPIC), ("tracker", TRACKS_TOPIC)]
)
def test_a_killed_node_comes_back(node, topic, listener, ros2, spin_until):
    simulator = ["-p", "scenario:=tiny", "-p", "rate:=4.0", "-p", "wait_for_subscribers:=1"]
    extractor = ["run", "primary_proc", "plot_extractor", *EXTRACTOR]
    tracker = ["run", "secondary_proc", "tracker"]
    killed, other = (extractor, tracker) if node == "plot_extractor" else (tracker, extractor)

    def confirmed_since(number):
        rows = [t.rows for t in listener.tables[TRACKS_TOPIC][number:]]
        return any((r["status"] == TrackStatus.CONFIRMED).any() for r in rows)

    with (
        ros2(*other),
        ros2("run", "radar_sim", "radar_simulator", "--ros-args", *simulator) as source,
    ):
        with ros2(*killed) as victim:
            spin_until(lambda: confirmed_since(0), "the first confirmed track")
            os.killpg(victim.pid, signal.SIGKILL)
            victim.wait()
        spin_until(lambda: not listener.node.count_publishers(f"/{topic}"), "the node to be gone")
        before = len(listener.tables[TRACKS_TOPIC])
        with ros2(*killed):
            spin_until(lambda: confirmed_since(before), "confirmed tracks after the restart")
            assert source.poll() is None
    assert listener.node.count_publishers(f"/{SWEEPS_TOPIC}") <= 1
