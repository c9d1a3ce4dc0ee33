# SPDX-License-Identifier: Apache-2.0
"""Node `radar_simulator`: sweeps and truth in real time, faster, or straight into a bag."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from geometry_msgs.msg import TransformStamped
from rclpy.node import Node
from tf2_msgs.msg import TFMessage

from radar_common.health import Health
from radar_common.ros import qos
from radar_common.ros.diagnostics import Diagnostics
from radar_common.ros.messages import TablePublisher
from radar_common.ros.parameters import NodeParameters
from radar_common.tables import (
    NANOSECONDS,
    RADAR_FRAME,
    SITE_FRAME,
    SWEEPS_TOPIC,
    TRUTH_TOPIC,
)
from radar_sim.parameters import SimulatorParameters
from radar_sim.recording import record
from radar_sim.ros.command import run_or_record
from radar_sim.simulator import Sector, Simulator

NODE_NAME = "radar_simulator"

_TICKS_PER_SECTOR = 16.0
_SHORTEST_TICK, _LONGEST_TICK = 0.001, 0.05
# The rest of the node must have its turn also where the machine cannot keep up with the rate.
_SECTORS_PER_TICK = 4
_DELIVERY_TIMEOUT = 10.0


class RadarSimulatorNode(Node):
    """Publishes each sector when its last pulse has been received by the node's clock."""

    def __init__(
        self, *, on_finished: Callable[[], None] | None = None, **node_options: Any
    ) -> None:
        """Draw the scenario; the antenna starts with the first tick after all have subscribed.

        Args:
            on_finished: called once all scans have been delivered; None shuts the node's context down.
            node_options: passed on to rclpy's Node.

        Raises:
            ParameterError: the parameters or the scenario are impossible.
        """
        super().__init__(NODE_NAME, **node_options)
        self._settings = NodeParameters(self, SimulatorParameters).values
        self._on_finished = on_finished or self.context.try_shutdown
        self._simulator = Simulator.from_parameters(self._settings)
        self._upcoming: Sector | None = None
        self._health = Health()
        self._sweeps = TablePublisher(self, SWEEPS_TOPIC, qos.SWEEPS_OUT)
        self._truth = TablePublisher(self, TRUTH_TOPIC)
        self._diagnostics = Diagnostics(self, self._health)
        self._publish_site()
        self._timer = self.create_timer(self._tick_period(), self._tick)

    def _publish_site(self) -> None:
        radar = self._simulator.radar
        transform = TransformStamped(child_frame_id=RADAR_FRAME)
        transform.header.frame_id = SITE_FRAME
        transform.header.stamp = self.get_clock().now().to_msg()
        transform.transform.translation.x = float(radar.x)
        transform.transform.translation.y = float(radar.y)
        transform.transform.translation.z = float(radar.z)
        self._site = self.create_publisher(TFMessage, "/tf_static", qos.LATCHED)
        self._site.publish(TFMessage(transforms=[transform]))

    def _tick_period(self) -> float:
        if not self._settings.rate:
            return _SHORTEST_TICK
        sector = self._simulator.radar.scan_period / self._settings.sectors
        period = sector / self._settings.rate / _TICKS_PER_SECTOR
        return min(max(period, _SHORTEST_TICK), _LONGEST_TICK)

    def _tick(self) -> None:
        if self._upcoming is None and not self._start():
            return
        for _ in range(_SECTORS_PER_TICK):
            if not self._is_due():
                return
            self._publish()
            self._upcoming = next(self._simulator, None)
            if self._upcoming is None:
                self._finish()
                return

    def _start(self) -> bool:
        now = self.get_clock().now().nanoseconds
        begin_at = self._settings.begin_at * NANOSECONDS
        # Simulated time stands at zero until the first message on /clock.
        if (
            now <= begin_at
            or self._sweeps.subscriptions < self._settings.wait_for_subscribers
            or self._truth.subscriptions < self._settings.wait_for_truth_subscribers
        ):
            return False
        self._simulator.start = begin_at or now
        self._upcoming = next(self._simulator)
        radar = self._simulator.radar
        self.get_logger().info(
            f"{len(self._simulator.targets)} targets, {radar.pulses_per_scan:g} pulses of "
            f"{radar.cells} cells in {radar.scan_period:g} s"
        )
        return True

    def _is_due(self) -> bool:
        if not self._settings.rate:
            return True
        elapsed = (self.get_clock().now().nanoseconds - self._simulator.start) / 1e9
        return elapsed * self._settings.rate >= self._simulator.elapsed

    def _publish(self) -> None:
        assert self._upcoming is not None
        sweeps, truth = self._upcoming
        self._sweeps.publish(sweeps)
        self._truth.publish(truth)
        self._health.count("sectors", 1)
        self._health.count("pulses", len(sweeps.rows))
        self._health.count("targets passed", len(truth.rows))
        elapsed = (self.get_clock().now().nanoseconds - self._simulator.start) / 1e9
        if elapsed > 0.0 and self._settings.rate:
            observed = self._simulator.elapsed / elapsed
            self._health.watch("seconds simulated in a second", self._settings.rate, observed)

    def _finish(self) -> None:
        self._timer.cancel()
        delivered = [p.wait_until_received(_DELIVERY_TIMEOUT) for p in (self._sweeps, self._truth)]
        self.get_logger().info(
            f"{self._settings.scans} scans published"
            + ("" if all(delivered) else "; a subscription has not received all of them")
        )
        self._on_finished()


def main(args: Sequence[str] | None = None) -> int:
    """Run the node, or write a bag where the command line says so.

    Args:
        args: command line without the program's name, None for that of the process.

    Returns:
        Exit code: 0 after all scans or an interrupt, 2 if it cannot start.
    """
    return run_or_record(
        RadarSimulatorNode,
        SimulatorParameters,
        record,
        name=NODE_NAME,
        description="Simulated radar. Parameters follow --ros-args: -p scenario:=airport -p seed:=1",
        args=args,
    )
