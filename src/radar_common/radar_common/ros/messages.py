# SPDX-License-Identifier: Apache-2.0
"""Tables on topics: publishers and subscriptions that speak in tables and survive bad messages."""

from __future__ import annotations

import array
from collections.abc import Callable

import numpy as np
import numpy.typing as npt
from builtin_interfaces.msg import Time
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import QoSProfile
from sensor_msgs.msg import PointCloud2, PointField
from std_msgs.msg import Header

from radar_common.cloud import MessageTypes, TableError, decode, encode
from radar_common.health import Health
from radar_common.ros import qos
from radar_common.tables import Table

WARNING_PERIOD = 10.0


def _byte_array(data: npt.NDArray[np.uint8]) -> array.array[int]:
    # The generated setter checks every element of anything but an array.array.
    copy = array.array("B")
    copy.frombytes(data.data)
    return copy


TYPES = MessageTypes(
    PointCloud2=PointCloud2,
    PointField=PointField,
    Header=Header,
    Time=Time,
    bytes_of=_byte_array,
)


class TablePublisher:
    """Publishes tables as point clouds."""

    def __init__(self, node: Node, topic: str, profile: QoSProfile = qos.TABLES) -> None:
        """Create the publisher.

        Args:
            node: owner.
            topic: relative name, so that a namespace applies.
            profile: quality of service.
        """
        self._publisher = node.create_publisher(
            PointCloud2, topic, profile, qos_overriding_options=qos.OVERRIDABLE
        )

    def publish(self, table: Table) -> None:
        """Publish one table.

        Args:
            table: what to send.
        """
        self._publisher.publish(encode(table, TYPES))

    @property
    def subscriptions(self) -> int:
        """Number of subscriptions that are connected."""
        return int(self._publisher.get_subscription_count())

    def wait_until_received(self, timeout: float) -> bool:
        """Wait until every reliable subscription has received everything.

        Args:
            timeout: seconds at most.

        Returns:
            Whether they have.
        """
        return bool(self._publisher.wait_for_all_acked(Duration(seconds=timeout)))


class TableSubscription:
    """Hands tables to a callback; what is no table is dropped, counted and warned of."""

    def __init__(
        self,
        node: Node,
        topic: str,
        callback: Callable[[Table], None],
        health: Health,
        *,
        expected: np.dtype[np.void] | None,
        profile: QoSProfile = qos.TABLES,
    ) -> None:
        """Create the subscription.

        Args:
            node: owner.
            topic: relative name, so that a namespace applies.
            callback: called with each table.
            health: where dropped messages are counted, also those that the callback refuses by TableError.
            expected: dtype whose fields are wanted, None for any.
            profile: quality of service.
        """
        self._node = node
        self._callback = callback
        self._health = health
        self._expected = expected
        self._topic = topic
        node.create_subscription(
            PointCloud2, topic, self._receive, profile, qos_overriding_options=qos.OVERRIDABLE
        )

    def _receive(self, message: PointCloud2) -> None:
        try:
            self._callback(decode(message, self._expected))
        except TableError as error:
            self._health.drop(f"{self._topic}: {error}")
        for reason, number in self._health.news().items():
            self._node.get_logger().warning(
                f"dropped {number}: {reason}", throttle_duration_sec=WARNING_PERIOD
            )
