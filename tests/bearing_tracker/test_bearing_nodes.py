# SPDX-License-Identifier: Apache-2.0
"""Both nodes pass messages to their pipelines, publish what these find, draw it, and say what they dropped."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
import rclpy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseWithCovarianceStamped
from nav_msgs.msg import Odometry
from rclpy.clock import Clock, ClockType
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter
from visualization_msgs.msg import Marker, MarkerArray

from bearing_tracker import bearing_fusion_node, emitter_locator_node
from bearing_tracker.bearing_fusion import BearingFusion
from bearing_tracker.bearing_fusion_node import BearingFusionNode
from bearing_tracker.emitter_locator import EmitterLocator
from bearing_tracker.emitter_locator_node import EmitterLocatorNode
from bearing_tracker.fusion_parameters import FusionParameters
from bearing_tracker.locator_parameters import LocatorParameters
from bearing_tracker.ros.bearing_markers import bearing_markers
from bearing_tracker.ros.emitter_markers import emitter_markers, pose
from radar_common.health import Health
from radar_common.odometry import PlatformState, encode_odometry
from radar_common.ros.messages import TablePublisher, TableSubscription
from radar_common.ros.odometry import ODOMETRY_TYPES
from radar_common.tables import (
    BEARING,
    BEARINGS_TOPIC,
    EMITTER,
    EMITTERS_TOPIC,
    FUSED_BEARINGS_TOPIC,
    NANOSECONDS,
    PLATFORM_TOPIC,
    TRACKS_TOPIC,
    Table,
    TrackStatus,
)

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
def observer(context, executor):
    node = rclpy.create_node("observer", context=context)
    executor.add_node(node)
    return node


def spin_until(executor, condition):
    clock = Clock(clock_type=ClockType.STEADY_TIME)
    deadline = clock.now().nanoseconds + TIMEOUT * 1e9
    while not condition():
        executor.spin_once(timeout_sec=0.1)
        assert clock.now().nanoseconds < deadline, "condition not met in time"


def spin_until_met(executor, node, observer, heard, said):
    spin_until(
        executor,
        lambda: (
            all(node.count_subscribers(topic) for topic in said)
            and all(observer.count_subscribers(topic) for topic in heard)
        ),
    )


def test_the_fusion_node_publishes_what_the_fusion_finds(
    context, executor, observer, channels, flight
):
    node = BearingFusionNode(context=context)
    executor.add_node(node)
    fused, drawn, reports = [], [], []
    publishers = [TablePublisher(observer, topic) for topic in (TRACKS_TOPIC, BEARINGS_TOPIC)]
    TableSubscription(observer, FUSED_BEARINGS_TOPIC, fused.append, Health(), expected=BEARING)
    markers = bearing_fusion_node.MARKERS_TOPIC
    observer.create_subscription(MarkerArray, markers, drawn.append, 10)
    observer.create_subscription(DiagnosticArray, "/diagnostics", reports.append, 10)
    spin_until_met(
        executor,
        node,
        observer,
        (TRACKS_TOPIC, BEARINGS_TOPIC),
        (FUSED_BEARINGS_TOPIC, markers),
    )
    target = flight((20e3, 30e3), (-150.0, -50.0), track=7)
    messages = channels([target], end=8.0).messages
    for number, message in enumerate(messages, start=1):
        publishers[message.rows.dtype == BEARING].publish(message)
        spin_until(executor, lambda number=number: len(fused) == number)
    alone = BearingFusion(FusionParameters())
    for message, table in zip(messages, fused, strict=True):
        expected = alone.process(message)
        assert (table.stamp, table.frame_id) == (message.stamp, "map")
        assert table.rows.tobytes() == expected.rows.tobytes()
    spin_until(executor, lambda: drawn and reports)
    assert {m.id for message in drawn for m in message.markers} == {7}
    assert reports[0].status[0].name == "/bearing_fusion"
    result = node.set_parameters([Parameter("tentative_end_after", value=100.0)])[0]
    assert not result.successful
    assert "end_after" in result.reason


def test_the_locator_node_publishes_emitters_and_their_poses(
    context, executor, observer, make_bearings, start
):
    options = [Parameter("publish_poses", value=True), Parameter("known_range_error", value=1.0)]
    node = EmitterLocatorNode(context=context, parameter_overrides=options)
    executor.add_node(node)
    found, drawn, poses, reports = [], [], [], []
    bearings = TablePublisher(observer, BEARINGS_TOPIC)
    odometry = observer.create_publisher(Odometry, PLATFORM_TOPIC, 10)
    TableSubscription(observer, EMITTERS_TOPIC, found.append, Health(), expected=EMITTER)
    markers = emitter_locator_node.MARKERS_TOPIC
    observer.create_subscription(MarkerArray, markers, drawn.append, 10)
    observer.create_subscription(DiagnosticArray, "/diagnostics", reports.append, 10)
    observer.create_subscription(
        PoseWithCovarianceStamped, f"{EMITTERS_TOPIC}/id_5/pose", poses.append, 10
    )
    spin_until_met(
        executor,
        node,
        observer,
        (BEARINGS_TOPIC, PLATFORM_TOPIC),
        (EMITTERS_TOPIC, markers),
    )
    parameters = LocatorParameters(publish_poses=True, known_range_error=1.0)
    alone, expected, number, count = EmitterLocator(parameters), [], 0, 0
    broken = PlatformState(start, float("nan"), 0.0, 0.0, 0.0, 0.0, 0.0)
    odometry.publish(encode_odometry(broken, ODOMETRY_TYPES))
    # A flight around the emitter at 8 km; each message is answered before the next is sent.
    while not poses:
        angle = 0.04 * number
        place = 8e3 * np.array([np.sin(angle), np.cos(angle)])
        stamp = start + number * NANOSECONDS
        state = PlatformState(stamp, float(place[0]), float(place[1]), 1e3, 0.0, 300.0, 0.0)
        azimuth = np.mod(np.arctan2(*-place), 2 * np.pi)
        table = Table(stamp, make_bearings([azimuth], std=0.01, identity=5))
        expected.append(alone.process_platform(state))
        odometry.publish(encode_odometry(state, ODOMETRY_TYPES))
        count += bool(len(expected[-1].rows))
        spin_until(
            executor,
            lambda number=number, count=count: (
                node._health.counts["fixes in"] > number and len(found) >= count
            ),
        )
        expected.append(alone.process(table))
        bearings.publish(table)
        count += 1
        spin_until(executor, lambda count=count: len(found) >= count)
        number += 1
        assert number < 60, "no pose was published"
    wanted = [t for t in expected if len(t.rows) or t.stamp in {f.stamp for f in found}]
    rows = np.concatenate([table.rows for table in found])
    assert rows.tobytes() == np.concatenate([table.rows for table in wanted]).tobytes()
    assert np.hypot(poses[0].pose.pose.position.x, poses[0].pose.pose.position.y) < 4e3
    spin_until(executor, lambda: drawn and reports)
    told = {value.key for report in reports for value in report.status[0].values}
    assert f"dropped: {PLATFORM_TOPIC}: a number is not finite" in told


def emitters():
    rows = np.zeros(5, EMITTER)
    rows["id"] = [1, 2, 3, 4, 2]
    rows["status"] = TrackStatus.CONFIRMED
    rows["status"][[0, 3]] = TrackStatus.TENTATIVE, TrackStatus.ENDED
    rows["range_known"] = [0, 1, 0, 1, 1]
    rows["x"], rows["range"], rows["azimuth"] = 1000.0, 3000.0, np.pi / 2
    covariance = np.zeros((4, 4))
    covariance[:2, :2] = [[100.0**2, 0.0], [0.0, 50.0**2]]
    rows["covariance"] = covariance.ravel()
    return Table(7 * NANOSECONDS, rows, "map")


def test_an_emitter_is_a_ray_until_its_range_is_known():
    message = emitter_markers(emitters(), 50e3)
    shown = {(m.id, m.ns): m for m in message.markers if m.action == Marker.ADD}
    assert shown.keys() == {(2, "ellipse"), (2, "label"), (3, "ray"), (3, "label")}
    deleted = {(m.id, m.ns) for m in message.markers if m.action == Marker.DELETE}
    assert deleted == {(2, "ray"), (3, "ellipse"), (4, "ray"), (4, "ellipse"), (4, "label")}
    ray, ellipse = shown[3, "ray"].points, shown[2, "ellipse"]
    assert (ray[0].x, ray[1].x) == pytest.approx((-2000.0, 48e3))
    assert (ellipse.scale.x, ellipse.scale.y) == pytest.approx((400.0, 200.0))
    assert abs(ellipse.pose.orientation.z) in (pytest.approx(0.0), pytest.approx(1.0))
    assert "unknown" in shown[3, "label"].text


def test_a_pose_tells_east_and_north():
    table = emitters()
    message = pose(table, table.rows[1])
    covariance = np.reshape(message.pose.covariance, (6, 6))
    assert (message.header.frame_id, message.header.stamp.sec) == ("map", 7)
    assert (covariance[0, 0], covariance[1, 1]) == pytest.approx((1e4, 2500.0))
    assert np.count_nonzero(covariance) == 2


def test_fused_bearings_are_lines_that_say_what_is_disturbed(make_bearings):
    rows = make_bearings([np.pi / 2, 0.0], identity=np.array([1, 2]))
    rows["active_health"][:, :2] = [[0.9, 0.1], [0.1, 0.9]]
    rows["passive_health"][:, :2] = 0.5
    message = bearing_markers(Table(0, rows, "map"), (100.0, 200.0))
    drawn = {(m.id, m.ns): m for m in message.markers}
    assert len(drawn) == 4
    begin, end = drawn[1, "bearing"].points
    assert (begin.x, begin.y, end.y) == pytest.approx((100.0, 200.0, 200.0))
    assert end.x > 10e3
    assert "jammed" in drawn[2, "label"].text
    assert "jammed" not in drawn[1, "label"].text
    assert drawn[1, "bearing"].color != drawn[2, "bearing"].color


def test_each_node_declares_every_parameter(context):
    for cls, parameters in (
        (BearingFusionNode, FusionParameters),
        (EmitterLocatorNode, LocatorParameters),
    ):
        node = cls(context=context)
        for field in dataclasses.fields(parameters):
            assert node.get_parameter(field.name).value == field.default
        node.destroy_node()


@pytest.mark.parametrize("crowd", ["one look", "spread over two seconds"])
def test_ten_thousand_bearings_in_one_message_stay_within_the_limits(
    context, executor, observer, make_bearings, start, crowd
):
    limit, rows_limit = 200, 9000
    common = {"maximum_bearings": rows_limit, "maximum_look": 500}
    settings = {"bearing_fusion": "maximum_targets", "emitter_locator": "maximum_emitters"}
    nodes = [
        cls(
            context=context,
            parameter_overrides=[
                Parameter(name, value=value)
                for name, value in {**common, settings[title]: limit}.items()
            ],
        )
        for title, cls in (
            ("bearing_fusion", BearingFusionNode),
            ("emitter_locator", EmitterLocatorNode),
        )
    ]
    for node in nodes:
        executor.add_node(node)
    bearings = TablePublisher(observer, BEARINGS_TOPIC)
    odometry = observer.create_publisher(Odometry, PLATFORM_TOPIC, 10)
    spin_until(executor, lambda: observer.count_subscribers(BEARINGS_TOPIC) == 2)
    spin_until(executor, lambda: observer.count_subscribers(PLATFORM_TOPIC) == 1)
    random = np.random.default_rng(3)
    rows = make_bearings(
        random.uniform(0.0, 2 * np.pi, 10_000),
        identity=random.integers(0, 3, 10_000),
        time_offset=random.uniform(0.0, 2.0, 10_000) if crowd != "one look" else 0.0,
    )
    fusion, locator = (node._health for node in nodes)
    bearings.publish(Table(start, rows))
    spin_until(executor, lambda: locator.counts["bearings in"])
    for second in range(4):
        state = PlatformState(start + second * NANOSECONDS, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
        odometry.publish(encode_odometry(state, ODOMETRY_TYPES))
    spin_until(executor, lambda: locator.counts["fixes in"] == 4)
    # A later message tells that the time of the first has passed.
    bearings.publish(Table(start + 60 * NANOSECONDS, rows[:0]))
    opened = "targets opened", "emitters opened"
    spin_until(executor, lambda: fusion.counts[opened[0]] and locator.counts[opened[1]])
    for health, count, lost in (
        (fusion, "passive bearings in", "bearings over the limit of targets"),
        (locator, "bearings in", "bearings over the limit of emitters"),
    ):
        assert health.counts[count] == rows_limit
        assert health.dropped["bearings over the limit of a message"] == 10_000 - rows_limit
        if crowd == "one look":
            assert health.dropped["sightings over the limit of a look"] > 1000
            assert health.dropped["sightings of one identity twice in a look"] > 5000
            assert health.dropped[lost] > 0
    assert fusion.counts[opened[0]] - fusion.counts["targets ended"] <= limit
    assert locator.counts[opened[1]] - locator.counts["emitters ended"] <= limit
