# SPDX-License-Identifier: Apache-2.0
"""Bearings as separate processes over DDS: beside a whole radar, recorded, replayed, killed and restarted."""

from __future__ import annotations

import os
import signal

import numpy as np
import pytest
import rclpy
from rclpy.qos import QoSProfile

from radar_common.bag import read_tables, topics
from radar_common.frames import wrap_pi
from radar_common.health import Health
from radar_common.ros.messages import TableSubscription
from radar_common.tables import (
    BEARING,
    BEARINGS_TOPIC,
    CHANNEL_TRUTH_TOPIC,
    FUSED_BEARINGS_TOPIC,
    NANOSECONDS,
    TRACK,
    TRACKS_TOPIC,
    BearingChannel,
)

DURATION, RATE = 44.0, 4.0
FUSION = ["run", "bearing_tracker", "bearing_fusion", "--ros-args"]
# A busy machine is late by seconds, of which each is four on the clock of the data.
PATIENT = ["-p", "buffer:=20.0"]
for topic in (TRACKS_TOPIC, BEARINGS_TOPIC):
    PATIENT += ["-p", f"qos_overrides./{topic}.subscription.depth:=2000"]


def simulator(package_node, *parameters):
    given = [part for parameter in parameters for part in ("-p", parameter)]
    return [
        "run",
        "radar_sim",
        package_node,
        "--ros-args",
        "-p",
        "scenario:=countermeasures",
        *given,
    ]


class Fused:
    """Keeps every table of fused bearings that is published."""

    def __init__(self, node):
        self.node = node
        self.tables = []
        self.health = Health()
        TableSubscription(
            node,
            FUSED_BEARINGS_TOPIC,
            self.tables.append,
            self.health,
            expected=BEARING,
            profile=QoSProfile(depth=2000),
        )


@pytest.fixture
def fused(context, executor):
    """A node that hears fused bearings."""
    node = rclpy.create_node("observer", context=context)
    executor.add_node(node)
    return Fused(node)


def rows_of(tables):
    return sum(len(table.rows) for table in tables)


def test_a_killed_fusion_comes_back(ros2, fused, spin_until):
    command = [*FUSION, "-p", "active_input:=plots", "-p", "buffer:=5.0"]
    with ros2(*simulator("bearing_simulator", "rate:=10.0")) as source:
        with ros2(*command) as victim:
            spin_until(lambda: rows_of(fused.tables), "the first fused bearing")
            os.killpg(victim.pid, signal.SIGKILL)
            victim.wait()
        gone = f"/{FUSED_BEARINGS_TOPIC}"
        spin_until(lambda: not fused.node.count_publishers(gone), "the node to be gone")
        before = len(fused.tables)
        with ros2(*command):
            spin_until(lambda: rows_of(fused.tables[before:]), "fused bearings after the restart")
            assert source.poll() is None
    assert not fused.health.dropped


@pytest.mark.study
def test_radar_and_direction_finder_share_targets_and_a_replay_gives_the_same(
    ros2, fused, spin_until, lossless_arguments, tmp_path
):
    bag = tmp_path / "bag"
    recorded = [f"/{t}" for t in (TRACKS_TOPIC, BEARINGS_TOPIC, CHANNEL_TRUTH_TOPIC)]
    begin = fused.node.get_clock().now().nanoseconds // NANOSECONDS + 12
    common = (f"begin_at:={begin}", f"rate:={RATE}")
    extractor = ["run", "primary_proc", "plot_extractor", "--ros-args"]
    extractor += [*lossless_arguments["plot_extractor"], "-p", "beamwidth_deg:=3.0"]
    scans = f"scans:={int(DURATION / 2)}"
    bearings = simulator("bearing_simulator", *common, f"duration:={DURATION}", "active:=false")
    with (
        ros2("bag", "record", "-o", str(bag), *recorded),
        ros2("run", "secondary_proc", "tracker", "--ros-args", *lossless_arguments["tracker"]),
        ros2(*extractor),
        ros2(*FUSION, *PATIENT),
        ros2(*simulator("radar_simulator", *common, scans)) as radar,
        ros2(*bearings, "-r", "truth:=truth/emitters") as finder,
    ):
        spin_until(lambda: radar.poll() is not None and finder.poll() is not None, "the end")
        live = list(fused.tables)
    assert (radar.returncode, finder.returncode) == (0, 0)
    assert {t.removeprefix("/") for t in recorded} == set(topics(bag))
    check_against_truth(bag, live)

    counted = topics(bag)
    messages, replays = counted[TRACKS_TOPIC] + counted[BEARINGS_TOPIC], []
    for _ in range(2):
        fused.tables.clear()
        with ros2(*FUSION, *PATIENT):
            spin_until(
                lambda: fused.node.count_publishers(f"/{FUSED_BEARINGS_TOPIC}") == 1, "the fusion"
            )
            with ros2("bag", "play", str(bag), "--delay", "2", "--rate", str(RATE)):
                # Each message in brings one out.
                spin_until(lambda: len(fused.tables) == messages, "all fused bearings")
        replays.append(in_order(fused.tables))
    (times, rows), (again, same) = replays
    # What waits in the buffer when the bag ends depends on which message came last.
    settled = int((times < times[0] + DURATION - 30.0).sum())
    assert settled > 30
    np.testing.assert_allclose(times[:settled] - again[:settled], 0.0, atol=1e-6)
    for name in ("azimuth", "azimuth_std", "active_health", "passive_health"):
        np.testing.assert_array_equal(rows[name][:settled], same[name][:settled], err_msg=name)


def in_order(tables):
    rows = np.concatenate([table.rows for table in tables])
    times = np.concatenate([table.times for table in tables])
    order = np.lexsort((rows["azimuth"], np.round(times, 6)))
    return times[order], rows[order]


def check_against_truth(bag, live):
    truth = [table for _, table in read_tables(bag, {CHANNEL_TRUTH_TOPIC: BEARING})]
    at = np.concatenate([table.times for table in truth])
    true = np.concatenate([table.rows for table in truth])
    tracks = [table for _, table in read_tables(bag, {TRACKS_TOPIC: TRACK})]
    times, rows = in_order(live)
    assert (rows["channel"] == BearingChannel.FUSED).all()
    assert rows_of(tracks) > 0
    settled = times > at[0] + 10.0
    errors = np.array(
        [
            np.abs(wrap_pi(row["azimuth"] - true["azimuth"][np.abs(at - t) < 0.4])).min()
            for t, row in zip(times[settled], rows[settled], strict=True)
        ]
    )
    # The direction finder alone has 0.6 degrees; the radar sees the very targets that it hears.
    assert np.degrees(np.median(errors)) < 0.3
