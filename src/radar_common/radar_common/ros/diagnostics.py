# SPDX-License-Identifier: Apache-2.0
"""A node's health as `diagnostic_msgs/DiagnosticArray`, once a second."""

from __future__ import annotations

from collections import Counter

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rclpy.node import Node

from radar_common.health import Health

PERIOD = 1.0


class Diagnostics:
    """Publishes the counts of a Health and warns while something is being dropped."""

    def __init__(self, node: Node, health: Health) -> None:
        """Start the timer.

        Args:
            node: owner, whose name the status bears.
            health: what to publish.
        """
        self._node = node
        self._health = health
        self._before: Counter[str] = Counter()
        self._publisher = node.create_publisher(DiagnosticArray, "/diagnostics", 10)
        self._timer = node.create_timer(PERIOD, self.publish)

    def publish(self) -> None:
        """Send the present state."""
        dropped = Counter(self._health.dropped)
        fresh = dropped - self._before
        self._before = dropped
        if fresh:
            level, text = DiagnosticStatus.WARN, "dropped " + ", ".join(sorted(fresh))
        else:
            level, text = DiagnosticStatus.OK, "running"
        values = [KeyValue(key=k, value=str(v)) for k, v in sorted(self._health.counts.items())]
        values += [KeyValue(key=f"dropped: {k}", value=str(v)) for k, v in sorted(dropped.items())]
        for name, watch in sorted(self._health.watches.items()):
            values.append(KeyValue(key=f"{name}, expected", value=f"{watch.expected:.6g}"))
            values.append(KeyValue(key=f"{name}, observed", value=f"{watch.observed:.6g}"))
        message = DiagnosticArray()
        message.header.stamp = self._node.get_clock().now().to_msg()
        message.status = [
            DiagnosticStatus(
                level=level,
                name=self._node.get_fully_qualified_name(),
                message=text,
                hardware_id=self._node.get_name(),
                values=values,
            )
        ]
        self._publisher.publish(message)
