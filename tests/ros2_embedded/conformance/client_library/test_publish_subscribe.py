# SPDX-License-Identifier: Apache-2.0
"""Publishing and subscribing."""

from __future__ import annotations

import array

import numpy as np
import pytest
from builtin_interfaces.msg import Time
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from geometry_msgs.msg import Point, TransformStamped
from nav_msgs.msg import Odometry
from rclpy.duration import Duration
from rclpy.exceptions import InvalidHandle, InvalidTopicNameException
from rclpy.serialization import deserialize_message, serialize_message
from sensor_msgs.msg import Image, NavSatFix, PointCloud2, PointField
from std_msgs.msg import (
    Bool,
    Byte,
    ByteMultiArray,
    Char,
    Empty,
    Float32,
    Float64MultiArray,
    Header,
    Int64,
    MultiArrayDimension,
    MultiArrayLayout,
    String,
    UInt8MultiArray,
)
from std_srvs.srv import SetBool
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import Marker, MarkerArray

HEADER = Header(stamp=Time(sec=12, nanosec=34), frame_id="radar")
MESSAGES = [
    Bool(data=True),
    Char(data=200),
    Byte(data=b"\xff"),
    Int64(data=-(2**63)),
    Float32(data=0.5),
    String(data="Grüße, 雷达"),
    String(),
    Empty(),
    HEADER,
    ByteMultiArray(data=[b"\x00", b"\xff", b"\x7f"]),
    UInt8MultiArray(data=bytes(range(256))),
    Float64MultiArray(
        layout=MultiArrayLayout(dim=[MultiArrayDimension(label="a", size=2, stride=2)]),
        data=[1.5, -2.5],
    ),
    PointCloud2(
        header=HEADER,
        height=1,
        width=2,
        fields=[PointField(name="x", offset=0, datatype=PointField.FLOAT32, count=1)],
        point_step=4,
        row_step=8,
        data=np.array([1.0, 2.0], np.float32).tobytes(),
        is_dense=True,
    ),
    Image(header=HEADER, height=2, width=3, encoding="mono8", step=3, data=bytes(6)),
    Odometry(header=HEADER, child_frame_id="base"),
    NavSatFix(header=HEADER, latitude=41.3, position_covariance=list(np.arange(9.0))),
    DiagnosticArray(
        header=HEADER,
        status=[
            DiagnosticStatus(
                level=DiagnosticStatus.WARN, name="n", values=[KeyValue(key="k", value="v")]
            ),
            DiagnosticStatus(),
        ],
    ),
    MarkerArray(markers=[Marker(header=HEADER, id=7, points=[Point(x=1.0), Point(y=2.0)])]),
    TFMessage(transforms=[TransformStamped(header=HEADER, child_frame_id="map")]),
]


def exact(message):
    """Compare by value in every element, which ``==`` of messages does not do for arrays."""
    return serialize_message(message)


@pytest.mark.parametrize("message", MESSAGES, ids=lambda message: type(message).__name__)
def test_message_arrives_as_it_was_sent(message, node, executor, topic, spin_until):
    received = []
    executor.add_node(node)
    node.create_subscription(type(message), topic, received.append, 10)
    publisher = node.create_publisher(type(message), topic, 10)
    spin_until(executor, lambda: publisher.get_subscription_count() == 1)
    publisher.publish(message)
    spin_until(executor, lambda: received)
    assert type(received[0]) is type(message)
    assert received[0] == message
    assert exact(received[0]) == exact(message)


@pytest.mark.parametrize("message", MESSAGES, ids=lambda message: type(message).__name__)
def test_serialized_message_reads_back(message):
    data = serialize_message(message)
    assert isinstance(data, bytes)
    duplicate = deserialize_message(data, type(message))
    assert duplicate == message
    assert serialize_message(duplicate) == data


def test_received_arrays_are_owned_and_mutable(node, executor, topic, spin_until):
    received = []
    executor.add_node(node)
    node.create_subscription(PointCloud2, topic, received.append, 10)
    node.create_subscription(PointCloud2, topic, received.append, 10)
    publisher = node.create_publisher(PointCloud2, topic, 10)
    spin_until(executor, lambda: publisher.get_subscription_count() == 2)
    publisher.publish(PointCloud2(data=b"abc"))
    spin_until(executor, lambda: len(received) == 2)
    assert isinstance(received[0].data, array.array)
    received[0].data[0] = 0
    received[0].data.append(1)
    assert received[1].data.tobytes() == b"abc"


def test_received_fixed_arrays_are_writable(node, executor, topic, spin_until):
    received = []
    executor.add_node(node)
    node.create_subscription(Odometry, topic, received.append, 10)
    publisher = node.create_publisher(Odometry, topic, 10)
    spin_until(executor, lambda: publisher.get_subscription_count() == 1)
    publisher.publish(Odometry())
    spin_until(executor, lambda: received)
    received[0].pose.covariance[0] = 2.0
    assert received[0].pose.covariance[0] == 2.0


def test_order_is_kept(node, executor, topic, spin_until):
    received = []
    executor.add_node(node)
    node.create_subscription(Int64, topic, lambda message: received.append(message.data), 100)
    publisher = node.create_publisher(Int64, topic, 100)
    spin_until(executor, lambda: publisher.get_subscription_count() == 1)
    for number in range(50):
        publisher.publish(Int64(data=number))
    spin_until(executor, lambda: len(received) == 50)
    assert received == list(range(50))


def test_large_message(node, executor, topic, spin_until):
    received = []
    executor.add_node(node)
    node.create_subscription(Image, topic, received.append, 10)
    publisher = node.create_publisher(Image, topic, 10)
    spin_until(executor, lambda: publisher.get_subscription_count() == 1)
    data = np.random.default_rng(1).integers(0, 256, 4_000_000, np.uint8).tobytes()
    publisher.publish(Image(data=data))
    spin_until(executor, lambda: received)
    assert received[0].data.tobytes() == data


def test_raw_subscription_gets_bytes(node, executor, topic, spin_until):
    received = []
    executor.add_node(node)
    node.create_subscription(String, topic, received.append, 10, raw=True)
    publisher = node.create_publisher(String, topic, 10)
    spin_until(executor, lambda: publisher.get_subscription_count() == 1)
    publisher.publish(String(data="raw"))
    spin_until(executor, lambda: received)
    assert isinstance(received[0], bytes)
    assert deserialize_message(received[0], String) == String(data="raw")


def test_bytes_can_be_published(node, executor, topic, spin_until):
    received = []
    executor.add_node(node)
    node.create_subscription(String, topic, received.append, 10)
    publisher = node.create_publisher(String, topic, 10)
    spin_until(executor, lambda: publisher.get_subscription_count() == 1)
    publisher.publish(serialize_message(String(data="raw")))
    spin_until(executor, lambda: received)
    assert received == [String(data="raw")]


def test_callback_with_message_info(node, executor, topic, spin_until):
    received = []
    executor.add_node(node)
    node.create_subscription(String, topic, lambda *both: received.append(both), 10)
    node.create_subscription(String, topic, lambda message, info: received.append(info), 10)
    publisher = node.create_publisher(String, topic, 10)
    spin_until(executor, lambda: publisher.get_subscription_count() == 2)
    publisher.publish(String())
    spin_until(executor, lambda: len(received) == 2)
    info = next(item for item in received if isinstance(item, dict))
    assert info["source_timestamp"] > 0
    assert "received_timestamp" in info
    assert (String(),) in received


def test_callback_with_wrong_signature_is_refused(node, topic):
    with pytest.raises(RuntimeError):
        node.create_subscription(String, topic, lambda: None, 10)


@pytest.mark.parametrize("wrong", [Bool(), "text", None, 5])
def test_other_type_cannot_be_published(wrong, node, topic):
    publisher = node.create_publisher(String, topic, 10)
    with pytest.raises(TypeError):
        publisher.publish(wrong)


@pytest.mark.parametrize("bad", ["", "two words", "a//b", "end/", "1st", "a?b", "{open", "x~"])
def test_bad_topic_name_is_refused(bad, node):
    with pytest.raises(InvalidTopicNameException):
        node.create_publisher(String, bad, 10)
    with pytest.raises(InvalidTopicNameException):
        node.create_subscription(String, bad, lambda message: None, 10)


def test_service_type_is_no_message_type(node, topic):
    with pytest.raises(RuntimeError):
        node.create_publisher(SetBool, topic, 10)
    with pytest.raises(AttributeError):
        node.create_publisher(int, topic, 10)


def test_counts_follow_creation_and_destruction(node, executor, topic, spin_until):
    executor.add_node(node)
    publisher = node.create_publisher(String, topic, 10)
    assert publisher.get_subscription_count() == 0
    subscription = node.create_subscription(String, topic, lambda message: None, 10)
    spin_until(executor, lambda: publisher.get_subscription_count() == 1)
    spin_until(executor, lambda: subscription.get_publisher_count() == 1)
    assert node.destroy_subscription(subscription)
    spin_until(executor, lambda: publisher.get_subscription_count() == 0)


def test_destroyed_entities_are_refused(node, topic):
    publisher = node.create_publisher(String, topic, 10)
    assert node.destroy_publisher(publisher)
    assert not node.destroy_publisher(publisher)
    with pytest.raises(InvalidHandle):
        publisher.publish(String())


def test_wait_for_all_acked(node, executor, topic, spin_until):
    received = []
    executor.add_node(node)
    node.create_subscription(String, topic, received.append, 10)
    publisher = node.create_publisher(String, topic, 10)
    spin_until(executor, lambda: publisher.get_subscription_count() == 1)
    publisher.publish(String())
    assert publisher.wait_for_all_acked(Duration(seconds=10))


def test_topic_name_is_full(make_node):
    node = make_node("talker", namespace="/space")
    assert node.create_publisher(String, "chatter", 10).topic_name == "/space/chatter"
    assert node.create_publisher(String, "/chatter", 10).topic_name == "/chatter"
    assert node.create_publisher(String, "~/chatter", 10).topic_name == "/space/talker/chatter"
