# SPDX-License-Identifier: Apache-2.0
"""ROS 2 node `bearing_fusion`: radar/tracks or radar/plots and passive/bearings in; fused/bearings and markers out."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rclpy.node import Node
from visualization_msgs.msg import MarkerArray

from bearing_tracker.bearing_fusion import BearingFusion
from bearing_tracker.fusion_parameters import FusionParameters
from bearing_tracker.ros.bearing_markers import bearing_markers
from radar_common.health import Health
from radar_common.ros.diagnostics import Diagnostics
from radar_common.ros.messages import TablePublisher, TableSubscription
from radar_common.ros.parameters import NodeParameters
from radar_common.ros.run import run
from radar_common.tables import (
    BEARING,
    BEARINGS_TOPIC,
    FUSED_BEARINGS_TOPIC,
    PLOT,
    PLOTS_TOPIC,
    TRACK,
    TRACKS_TOPIC,
    Table,
)

NODE_NAME = "bearing_fusion"
MARKERS_TOPIC = "fused/bearing_markers"


class BearingFusionNode(Node):
    """Runs one BearingFusion on the messages of both channels."""

    def __init__(self, **node_options: Any) -> None:
        """Wait for messages.

        Args:
            node_options: passed on to rclpy's Node.

        Raises:
            ParameterError: the parameters are impossible.
        """
        super().__init__(NODE_NAME, **node_options)
        self._health = Health()
        self._settings = NodeParameters(self, FusionParameters, self._change)
        self._fusion = BearingFusion(self._settings.values, self._health)
        self._fused = TablePublisher(self, FUSED_BEARINGS_TOPIC)
        self._markers = self.create_publisher(MarkerArray, MARKERS_TOPIC, 10)
        plots = self._settings.values.active_input == "plots"
        self._active = TableSubscription(
            self,
            PLOTS_TOPIC if plots else TRACKS_TOPIC,
            self._receive,
            self._health,
            expected=PLOT if plots else TRACK,
        )
        self._passive = TableSubscription(
            self, BEARINGS_TOPIC, self._receive, self._health, expected=BEARING
        )
        self._diagnostics = Diagnostics(self, self._health)

    def _change(self, parameters: FusionParameters) -> None:
        self._fusion.reconfigure(parameters)

    def _receive(self, table: Table) -> None:
        fused = self._fusion.process(table)
        self._fused.publish(fused)
        if len(fused.rows) and self._markers.get_subscription_count():
            place = (self._settings.values.radar_x, self._settings.values.radar_y)
            self._markers.publish(bearing_markers(fused, place))


def main(args: Sequence[str] | None = None) -> int:
    """Run the node until it is interrupted.

    Args:
        args: command line without the program's name, None for that of the process.

    Returns:
        Exit code: 0 after an interrupt, 2 if it cannot start.
    """
    return run(BearingFusionNode, args)
