# SPDX-License-Identifier: Apache-2.0
"""The node passes plots to the tracker, publishes its tracks, draws them, and can be retuned."""

from __future__ import annotations

import numpy as np
import pytest
import rclpy
from diagnostic_msgs.msg import DiagnosticArray
from rclpy.clock import Clock, ClockType
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter
from visualization_msgs.msg import Marker, MarkerArray

from radar_common.health import Health
from radar_common.parameters import to_yaml
from radar_common.ros.messages import TablePublisher, TableSubscription
from radar_common.tables import PLOTS_TOPIC, TRACK, TRACKS_TOPIC, Table, TrackStatus
from secondary_proc.parameters import TrackerParameters
from secondary_proc.tracker import Tracker
from secondary_proc.tracker_node import MARKERS_TOPIC, NODE_NAME, TrackerNode, markers

TIMEOUT = 30.0


@pytest.fixture
def context():
    context = Context()
    rclpy.init(context=context)
    yield context
    rclpy.shutdown(context=context)


@pytest.fixture
def executor(context):
    executor = SingleThreadedExecutor(context=context)
    yield executor
    for node in executor.get_nodes():
        node.destroy_node()
    executor.shutdown()


@pytest.fixture
def node(context, executor):
    node = TrackerNode(context=context)
    executor.add_node(node)
    return node


@pytest.fixture
def observer(context, executor):
    node = rclpy.create_node("observer", context=context)
    executor.add_node(node)
    return node


@pytest.fixture
def messages(scene):
    world = scene(seed=1)
    world.fly((20e3, 10e3), (-150.0, 60.0), end=30.0)
    world.fly((-30e3, 25e3), (120.0, -90.0), end=30.0)
    return list(world.messages(sectors=8))


def spin_until(executor, condition):
    clock = Clock(clock_type=ClockType.STEADY_TIME)
    deadline = clock.now().nanoseconds + TIMEOUT * 1e9
    while not condition():
        executor.spin_once(timeout_sec=0.1)
        assert clock.now().nanoseconds < deadline, "condition not met in time"


def test_the_node_publishes_what_the_tracker_finds(executor, node, observer, messages):
    tracks, drawn, reports, health = [], [], [], Health()
    plots = TablePublisher(observer, PLOTS_TOPIC)
    TableSubscription(observer, TRACKS_TOPIC, tracks.append, health, expected=TRACK)
    observer.create_subscription(MarkerArray, MARKERS_TOPIC, drawn.append, 10)
    observer.create_subscription(DiagnosticArray, "/diagnostics", reports.append, 10)
    spin_until(
        executor,
        lambda: (
            node.count_subscribers(TRACKS_TOPIC)
            and node.count_subscribers(MARKERS_TOPIC)
            and observer.count_subscribers(PLOTS_TOPIC)
        ),
    )
    for number, message in enumerate(messages, start=1):
        plots.publish(message)
        spin_until(executor, lambda number=number: len(tracks) == number)
    alone = Tracker(TrackerParameters())
    for message, table in zip(messages, tracks, strict=True):
        expected = alone.process(message)
        assert (table.stamp, table.frame_id) == (message.stamp, "map")
        assert table.rows.tobytes() == expected.rows.tobytes()
    spin_until(executor, lambda: drawn and reports)
    kinds = {marker.type for message in drawn for marker in message.markers}
    assert kinds == {Marker.ARROW, Marker.TEXT_VIEW_FACING}
    assert reports[0].status[0].name == f"/{NODE_NAME}"


def test_tracks_survive_a_change_of_parameters(executor, node, observer, messages):
    tracks = []
    plots = TablePublisher(observer, PLOTS_TOPIC)
    TableSubscription(observer, TRACKS_TOPIC, tracks.append, Health(), expected=TRACK)
    spin_until(
        executor,
        lambda: node.count_subscribers(TRACKS_TOPIC) and observer.count_subscribers(PLOTS_TOPIC),
    )
    for number, message in enumerate(messages, start=1):
        if number == len(messages) // 2:
            results = node.set_parameters([Parameter("smoother", value="alpha_beta")])
            assert results[0].successful
        plots.publish(message)
        spin_until(executor, lambda number=number: len(tracks) == number)
    rows = np.concatenate([table.rows for table in tracks])
    assert len(set(rows["id"][rows["status"] == TrackStatus.CONFIRMED].tolist())) == 2


def test_impossible_parameters_are_refused_with_the_reason(node):
    result = node.set_parameters([Parameter("confirm_window", value=2)])[0]
    assert not result.successful
    assert "confirm_hits" in result.reason
    assert node.get_parameter("confirm_window").value == 4


def test_markers_show_confirmed_tracks_and_delete_ended_ones():
    rows = np.zeros(5, TRACK)
    rows["id"] = [1, 2, 3, 4, 2]
    rows["status"] = [
        TrackStatus.TENTATIVE,
        TrackStatus.CONFIRMED,
        TrackStatus.COASTING,
        TrackStatus.ENDED,
        TrackStatus.CONFIRMED,
    ]
    rows["x"], rows["vx"] = np.arange(5) * 1000.0, 100.0
    rows["time_offset"] = 0.5
    message = markers(Table(7_000_000_000, rows, "map"), 4.0)
    arrows = {m.id: m for m in message.markers if m.ns == "velocity"}
    assert arrows.keys() == {2, 3, 4}
    assert len(message.markers) == 6
    assert arrows[4].action == Marker.DELETE
    assert (arrows[2].points[0].x, arrows[2].points[1].x) == (4000.0, 7000.0)
    assert (arrows[2].header.frame_id, arrows[2].header.stamp.sec) == ("map", 7)
    assert (arrows[2].lifetime.sec, arrows[2].lifetime.nanosec) == (10, 0)
    assert arrows[2].color != arrows[3].color


def test_the_parameter_file_holds_the_defaults(repository):
    text = (repository / "src" / "secondary_proc" / "config" / "tracker.yaml").read_text()
    assert text == to_yaml(TrackerParameters, NODE_NAME)
