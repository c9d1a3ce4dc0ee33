# SPDX-License-Identifier: Apache-2.0
"""Node `bearing_simulator`: bearings, plots of an active channel, the platform and the truth."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from nav_msgs.msg import Odometry
from rclpy.duration import Duration
from rclpy.node import Node

from radar_common.health import Health
from radar_common.odometry import PlatformState, encode_odometry
from radar_common.ros import qos
from radar_common.ros.diagnostics import Diagnostics
from radar_common.ros.messages import TablePublisher
from radar_common.ros.odometry import ODOMETRY_TYPES
from radar_common.ros.parameters import NodeParameters
from radar_common.tables import (
    BEARINGS_TOPIC,
    CHANNEL_TRUTH_TOPIC,
    NANOSECONDS,
    PLATFORM_TOPIC,
    PLOTS_TOPIC,
    TRUTH_TOPIC,
)
from radar_sim.bearings.parameters import BearingSimulatorParameters
from radar_sim.bearings.recording import record_bearings
from radar_sim.bearings.simulator import BearingSimulator, Message
from radar_sim.ros.command import run_or_record

NODE_NAME = "bearing_simulator"

_TICK = 0.005
# The rest of the node must have its turn also where the machine cannot keep up with the rate.
_MESSAGES_PER_TICK = 32
_DELIVERY_TIMEOUT = 10.0


class BearingSimulatorNode(Node):
    """Publishes each message when it is due by the node's clock."""

    def __init__(
        self, *, on_finished: Callable[[], None] | None = None, **node_options: Any
    ) -> None:
        """Draw the scenario; time begins with the first tick after all have subscribed.

        Args:
            on_finished: called once everything has been delivered; None shuts the node's context down.
            node_options: passed on to rclpy's Node.

        Raises:
            ParameterError: the parameters or the scenario are impossible.
        """
        super().__init__(NODE_NAME, **node_options)
        self._settings = NodeParameters(self, BearingSimulatorParameters).values
        self._on_finished = on_finished or self.context.try_shutdown
        self._simulator = BearingSimulator.from_parameters(self._settings)
        self._upcoming: Message | None = None
        self._health = Health()
        topics = [BEARINGS_TOPIC] if self._simulator.has_direction_finder else []
        topics += [PLOTS_TOPIC] if self._simulator.has_active_channel else []
        self._sensors = topics
        self._tables = {
            topic: TablePublisher(self, topic)
            for topic in (*topics, TRUTH_TOPIC, CHANNEL_TRUTH_TOPIC)
        }
        self._odometry = self.create_publisher(
            Odometry, PLATFORM_TOPIC, qos.TABLES, qos_overriding_options=qos.OVERRIDABLE
        )
        self._diagnostics = Diagnostics(self, self._health)
        self._timer = self.create_timer(_TICK, self._tick)

    def _tick(self) -> None:
        if self._upcoming is None and not self._start():
            return
        for _ in range(_MESSAGES_PER_TICK):
            assert self._upcoming is not None
            if not self._is_due(self._upcoming):
                return
            self._publish(self._upcoming)
            self._upcoming = next(self._simulator, None)
            if self._upcoming is None:
                self._finish()
                return

    def _start(self) -> bool:
        now = self.get_clock().now().nanoseconds
        begin_at = self._settings.begin_at * NANOSECONDS
        truth, sensor = self._tables[CHANNEL_TRUTH_TOPIC], self._tables[self._sensors[0]]
        # Simulated time stands at zero until the first message on /clock.
        if (
            now <= begin_at
            or sensor.subscriptions < self._settings.wait_for_subscribers
            or truth.subscriptions < self._settings.wait_for_truth_subscribers
        ):
            return False
        self._simulator.start = begin_at or now
        self._upcoming = next(self._simulator)
        self.get_logger().info(
            f"{len(self._simulator.sources)} sources, {' and '.join(self._sensors)}"
        )
        return True

    def _elapsed(self) -> float:
        return (self.get_clock().now().nanoseconds - self._simulator.start) / NANOSECONDS

    def _is_due(self, message: Message) -> bool:
        return not self._settings.rate or self._elapsed() * self._settings.rate >= message.due

    def _publish(self, message: Message) -> None:
        topic, content = message.topic, message.content
        if isinstance(content, PlatformState):
            self._odometry.publish(encode_odometry(content, ODOMETRY_TYPES))
            self._health.count("platform states", 1)
        else:
            self._tables[topic].publish(content)
            if topic in self._sensors:
                self._health.count(f"looks, {topic}", 1)
                self._health.count(f"rows, {topic}", len(content.rows))
        elapsed = self._elapsed()
        if elapsed > 0.0 and self._settings.rate:
            observed = message.due / elapsed
            self._health.watch("seconds simulated in a second", self._settings.rate, observed)

    def _finish(self) -> None:
        self._timer.cancel()
        delivered = [p.wait_until_received(_DELIVERY_TIMEOUT) for p in self._tables.values()]
        timeout = Duration(seconds=_DELIVERY_TIMEOUT)
        delivered.append(bool(self._odometry.wait_for_all_acked(timeout)))
        self.get_logger().info(
            f"{self._settings.duration:g} s published"
            + ("" if all(delivered) else "; a subscription has not received all of them")
        )
        self._on_finished()


def main(args: Sequence[str] | None = None) -> int:
    """Run the node, or write a bag where the command line says so.

    Args:
        args: command line without the program's name, None for that of the process.

    Returns:
        Exit code: 0 at the end of the duration or after an interrupt, 2 if it cannot start.
    """
    return run_or_record(
        BearingSimulatorNode,
        BearingSimulatorParameters,
        record_bearings,
        name=NODE_NAME,
        description="Simulated bearings. Parameters follow --ros-args: -p scenario:=ship -p seed:=1",
        args=args,
    )
