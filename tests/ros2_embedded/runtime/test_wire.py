# SPDX-License-Identifier: Apache-2.0
"""What goes over the wire: type hashes, serialisation, all message types through DDS."""

from __future__ import annotations

import array
import os

import numpy as np
import pytest
from rclpy.qos import QoSProfile

from ros2_embedded.dds.endpoints import Reader, Writer
from ros2_embedded.dds.library import DdsError
from ros2_embedded.dds.participant import Participant
from ros2_embedded.dds.waitset import WaitSet
from ros2_embedded.messages.classes import message_class
from ros2_embedded.messages.codec import deserialize, serialize, type_hash
from ros2_embedded.messages.definitions import type_store

DOMAIN = 1 + os.getpid() % 100
TYPES = sorted(type_store().fielddefs)
SAMPLES = 3
SECOND = 10**9

#: As `ros2 topic info -v` and `ros2 service info -v` of Jazzy show them.
PUBLISHED_HASHES = {
    "std_msgs/msg/String": "df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18",
    "sensor_msgs/msg/PointCloud2": (
        "9198cabf7da3796ae6fe19c4cb3bdd3525492988c70522628af5daa124bae2b5"
    ),
    "sensor_msgs/msg/Image": "d31d41a9a4c4bc8eae9be757b0beed306564f7526c88ea6a4588fb9582527d47",
    "nav_msgs/msg/Odometry": "3cc97dc7fb7502f8714462c526d369e35b603cfc34d946e3f2eda2766dfec6e0",
    "rosgraph_msgs/msg/Clock": "692f7a66e93a3c83e71765d033b60349ba68023a8c689a79e48078bcb5c58564",
    "rmw_dds_common/msg/ParticipantEntitiesInfo": (
        "91a0593bacdcc50ea9bdcf849a938b128412cc1ea821245c663bcd26f83c295e"
    ),
}


@pytest.mark.parametrize(("ros_type", "digest"), PUBLISHED_HASHES.items())
def test_type_hashes(ros_type, digest):
    assert type_hash(ros_type) == f"RIHS01_{digest}"


def random_value(generator, text):
    """Make a value for a field of a type as `get_fields_and_field_types` shows it."""
    if text.startswith("sequence<"):
        element, _, bound = text[len("sequence<") : -1].partition(", ")
        count = int(generator.integers(0, min(int(bound or 4), 4) + 1))
        return [random_value(generator, element) for _ in range(count)]
    if text.endswith("]"):
        element, _, size = text[:-1].partition("[")
        return [random_value(generator, element) for _ in range(int(size))]
    if text.startswith("string"):
        return "".join(chr(c) for c in generator.integers(0x20, 0x2FF, generator.integers(0, 9)))
    if "/" in text:
        package, name = text.split("/")
        return random_message(generator, f"{package}/msg/{name}")
    if text == "boolean":
        return bool(generator.integers(2))
    if text == "octet":
        return bytes(generator.integers(0, 256, 1, np.uint8))
    if text in ("float", "double"):
        return float(np.float32(generator.normal()))
    limits = np.iinfo(text)
    return int(generator.integers(limits.min, limits.max, dtype=text, endpoint=True))


def random_message(generator, ros_type):
    """Make a message of a type with random values in all fields."""
    cls = message_class(ros_type)
    fields = cls.get_fields_and_field_types()
    return cls(**{name: random_value(generator, text) for name, text in fields.items()})


def same(one, other):
    """Compare exactly, which `==` of messages does not do for arrays of fixed size."""
    if hasattr(one, "get_fields_and_field_types"):
        names = one.get_fields_and_field_types()
        return type(one) is type(other) and all(
            same(getattr(one, name), getattr(other, name)) for name in names
        )
    if isinstance(one, list):
        return len(one) == len(other) and all(map(same, one, other))
    return type(one) is type(other) and np.array_equal(one, other)


@pytest.mark.parametrize("ros_type", TYPES)
def test_random_messages_survive_serialisation(ros_type):
    generator = np.random.default_rng(TYPES.index(ros_type))
    for _ in range(SAMPLES):
        message = random_message(generator, ros_type)
        data = serialize(message)
        assert len(data) % 4 == 0
        assert same(deserialize(bytes(data), ros_type), message)


@pytest.fixture(scope="module")
def participant():
    """A participant in a domain."""
    participant = Participant(DOMAIN)
    yield participant
    participant.close()


@pytest.mark.parametrize("ros_type", TYPES)
def test_random_messages_survive_dds(ros_type, participant):
    generator = np.random.default_rng(1000 + TYPES.index(ros_type))
    profile = QoSProfile(depth=SAMPLES)
    reader = Reader(participant, "rt/random", ros_type, profile)
    writer = Writer(participant, "rt/random", ros_type, profile)
    waitset = WaitSet(participant)
    sent = [random_message(generator, ros_type) for _ in range(SAMPLES)]
    for message in sent:
        writer.write(serialize(message))
    for message in sent:
        assert waitset.wait({reader.condition}, 10 * SECOND) == {reader.condition}
        taken = reader.take(lambda data: deserialize(data, ros_type))
        assert same(taken[0], message)
    assert reader.take(bytes) is None
    waitset.close()
    reader.close()
    writer.close()


def test_wrong_bytes_are_not_sent(participant):
    writer = Writer(participant, "rt/wrong", "std_msgs/msg/String", QoSProfile(depth=1))
    with pytest.raises(DdsError):
        writer.write(bytearray(b"\x00\x01\x00\x00\xff\xff\xff\xff"))
    writer.close()


@pytest.mark.parametrize("data", [b"", b"\x00\x01", b"\x09\x09\x00\x00abcd", b"\x00\x01\x00\x00"])
def test_wrong_bytes_are_not_read(data):
    with pytest.raises(ValueError, match=r"CDR|read"):
        deserialize(data, "std_msgs/msg/String")


def test_big_endian_is_read():
    data = b"\x00\x00\x00\x00" + (2).to_bytes(4, "big") + b"\x00\x01\x00\x02"
    layout = b"\x00\x00\x00\x00" * 2
    message = deserialize(b"\x00\x00\x00\x00" + layout + data[4:], "std_msgs/msg/UInt16MultiArray")
    assert message.data == array.array("H", [1, 2])


def test_taken_messages_own_their_data(participant):
    profile = QoSProfile(depth=1)
    ros_type = "nav_msgs/msg/Odometry"
    reader = Reader(participant, "rt/owned", ros_type, profile)
    writer = Writer(participant, "rt/owned", ros_type, profile)
    writer.write(serialize(message_class(ros_type)()))
    message, _ = reader.take(lambda data: deserialize(data, ros_type))
    reader.close()
    writer.close()
    assert message.pose.covariance.flags.owndata
    assert message.pose.covariance.flags.writeable
