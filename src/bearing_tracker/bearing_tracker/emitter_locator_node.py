# SPDX-License-Identifier: Apache-2.0
"""ROS 2 node `emitter_locator`: passive/bearings and platform/odometry in; emitters, markers and poses out."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from geometry_msgs.msg import PoseWithCovarianceStamped
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.publisher import Publisher
from visualization_msgs.msg import MarkerArray

from bearing_tracker.emitter_locator import EmitterLocator
from bearing_tracker.locator_parameters import LocatorParameters
from bearing_tracker.ros.emitter_markers import emitter_markers, pose
from radar_common.cloud import TableError
from radar_common.health import Health
from radar_common.odometry import decode_odometry
from radar_common.ros import qos
from radar_common.ros.diagnostics import Diagnostics
from radar_common.ros.messages import WARNING_PERIOD, TablePublisher, TableSubscription
from radar_common.ros.parameters import NodeParameters
from radar_common.ros.run import run
from radar_common.tables import (
    BEARING,
    BEARINGS_TOPIC,
    EMITTERS_TOPIC,
    PLATFORM_TOPIC,
    Table,
    TrackStatus,
)

NODE_NAME = "emitter_locator"
MARKERS_TOPIC = "emitter_markers"
MOST_POSES = 100
"""Emitters that get a topic of their own at once."""


class EmitterLocatorNode(Node):
    """Runs one EmitterLocator on bearings and odometry."""

    def __init__(self, **node_options: Any) -> None:
        """Wait for messages.

        Args:
            node_options: passed on to rclpy's Node.

        Raises:
            ParameterError: the parameters are impossible.
        """
        super().__init__(NODE_NAME, **node_options)
        self._health = Health()
        self._settings = NodeParameters(self, LocatorParameters, self._change)
        self._locator = EmitterLocator(self._settings.values, self._health)
        self._emitters = TablePublisher(self, EMITTERS_TOPIC)
        self._markers = self.create_publisher(MarkerArray, MARKERS_TOPIC, 10)
        self._poses: dict[int, Publisher] = {}
        self._bearings = TableSubscription(
            self,
            BEARINGS_TOPIC,
            lambda bearings: self._send(self._locator.process(bearings)),
            self._health,
            expected=BEARING,
        )
        self._odometry = self.create_subscription(
            Odometry,
            PLATFORM_TOPIC,
            self._move,
            qos.TABLES,
            qos_overriding_options=qos.OVERRIDABLE,
        )
        self._diagnostics = Diagnostics(self, self._health)

    def _change(self, parameters: LocatorParameters) -> None:
        self._locator.reconfigure(parameters)

    def _move(self, message: Odometry) -> None:
        try:
            emitters = self._locator.process_platform(decode_odometry(message))
        except TableError as error:
            self._health.drop(f"{PLATFORM_TOPIC}: {error}")
        else:
            # Fixes come often, and most of them bring no bearing with them.
            if len(emitters.rows):
                self._send(emitters)
        for reason, number in self._health.news().items():
            self.get_logger().warning(
                f"dropped {number}: {reason}", throttle_duration_sec=WARNING_PERIOD
            )

    def _send(self, emitters: Table) -> None:
        self._emitters.publish(emitters)
        if not len(emitters.rows):
            return
        if self._markers.get_subscription_count():
            reach = self._settings.values.maximum_range
            self._markers.publish(emitter_markers(emitters, reach))
        if self._settings.values.publish_poses:
            self._send_poses(emitters)

    def _send_poses(self, emitters: Table) -> None:
        for row in emitters.rows:
            number = int(row["id"])
            if row["status"] == TrackStatus.ENDED:
                if number in self._poses:
                    self.destroy_publisher(self._poses.pop(number))
            elif row["status"] == TrackStatus.CONFIRMED and row["range_known"]:
                if number not in self._poses and len(self._poses) < MOST_POSES:
                    self._poses[number] = self.create_publisher(
                        PoseWithCovarianceStamped, f"{EMITTERS_TOPIC}/id_{number}/pose", 10
                    )
                if number in self._poses:
                    self._poses[number].publish(pose(emitters, row))


def main(args: Sequence[str] | None = None) -> int:
    """Run the node until it is interrupted.

    Args:
        args: command line without the program's name, None for that of the process.

    Returns:
        Exit code: 0 after an interrupt, 2 if it cannot start.
    """
    return run(EmitterLocatorNode, args)
