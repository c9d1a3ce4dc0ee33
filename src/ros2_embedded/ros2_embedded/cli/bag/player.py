# SPDX-License-Identifier: Apache-2.0
"""Publishes the messages of a bag, serialised as they are, in the order and pace of the log."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass

from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.time import Time
from rosbags.interfaces import Connection, ConnectionExtRosbag2
from rosbags.rosbag2 import Reader
from rosgraph_msgs.msg import Clock

from ros2_embedded.cli.bag.pace import Pace
from ros2_embedded.cli.bag.qos import offer_of
from ros2_embedded.cli.bag.stopping import StopRequest
from ros2_embedded.cli.interfaces import UnknownTypeError, message_class


@dataclass(frozen=True, kw_only=True)
class Playback:
    """How a bag is played.

    Attributes:
        rate: Seconds of bag time a second.
        start: Bag time (ns) of the first message that is played.
        end: Bag time (ns) of the last message that is played.
        clock_period: Wall time between two clock messages (ns); None publishes none.
    """

    rate: float
    start: int
    end: int
    clock_period: int | None


class Player:
    """Plays topics of an open bag.

    Args:
        node: The node that publishes.
        reader: The open bag.
        connections: What is played of it.
    """

    def __init__(self, node: Node, reader: Reader, connections: Sequence[Connection]) -> None:
        self._node = node
        self._reader = reader
        self._connections = list(connections)
        self._publishers = {
            connection.topic: publisher
            for connection in connections
            if (publisher := _publisher(node, connection)) is not None
        }
        self._clock: Publisher | None = None

    def play(self, playback: Playback, stop: StopRequest) -> None:
        """Play once from start to end.

        Args:
            playback: How the bag is played.
            stop: Ends the playback before its time.
        """
        if not self._connections:
            # For the reader no connection at all means every one.
            return
        pace = Pace(playback.start, time.monotonic_ns(), playback.rate)
        next_tick = None if playback.clock_period is None else pace.wall_start
        messages = self._reader.messages(self._connections, playback.start, playback.end + 1)
        for connection, timestamp, data in messages:
            due = pace.wall_time(timestamp)
            while next_tick is not None and next_tick <= due and not stop:
                stop.sleep_until(next_tick)
                self._publish_clock(pace.bag_time(next_tick))
                next_tick += playback.clock_period or 0
            stop.sleep_until(due)
            if stop:
                return
            publisher = self._publishers.get(connection.topic)
            if publisher is not None:
                publisher.publish(data)

    def wait_for_all_acked(self, milliseconds: int) -> None:
        """Wait until the subscribers have acknowledged every message.

        Args:
            milliseconds: The longest wait a topic; 0 waits without limit.
        """
        timeout = Duration(nanoseconds=milliseconds * 1_000_000 if milliseconds else -1)
        for topic, publisher in self._publishers.items():
            if not publisher.wait_for_all_acked(timeout):
                self._node.get_logger().error(
                    "Timed out while waiting for all published messages to be acknowledged "
                    f"for topic {topic}"
                )

    def start_clock(self) -> None:
        """Create the publisher of the clock, so that subscribers find it before the start."""
        self._clock = self._node.create_publisher(Clock, "/clock", 1)

    def _publish_clock(self, bag_time: int) -> None:
        if self._clock is not None:
            self._clock.publish(Clock(clock=Time(nanoseconds=bag_time).to_msg()))


def _publisher(node: Node, connection: Connection) -> Publisher | None:
    assert isinstance(connection.ext, ConnectionExtRosbag2)
    try:
        kind = message_class(connection.msgtype)
    except UnknownTypeError as error:
        node.get_logger().warning(f"Ignoring a topic '{connection.topic}', reason: {error}")
        return None
    profile, agreed = offer_of(connection.ext.offered_qos_profiles)
    if not agreed:
        node.get_logger().warning(
            f"Not all original publishers on topic {connection.topic} offered the same QoS "
            "profiles. Falling back to the default profile."
        )
    return node.create_publisher(kind, connection.topic, profile)
