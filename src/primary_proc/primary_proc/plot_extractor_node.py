# SPDX-License-Identifier: Apache-2.0
"""Node `plot_extractor`: sweeps in, plots out, one message for each sector; a picture a turn for those who want it."""

from __future__ import annotations

import array
from collections.abc import Sequence
from typing import Any

from rclpy.node import Node
from sensor_msgs.msg import Image

from primary_proc.parameters import ExtractorParameters
from primary_proc.plot_extractor import PlotExtractor
from primary_proc.ppi import PlanPosition
from radar_common.health import Health
from radar_common.ros import qos
from radar_common.ros.diagnostics import Diagnostics
from radar_common.ros.messages import TablePublisher, TableSubscription
from radar_common.ros.parameters import NodeParameters
from radar_common.ros.run import run
from radar_common.tables import NANOSECONDS, PLOTS_TOPIC, SWEEPS_TOPIC, Table

NODE_NAME = "plot_extractor"
PPI_TOPIC = "radar/ppi"

_PPI_DEPTH = 1


class PlotExtractorNode(Node):
    """Publishes the plots of each sector as soon as it has arrived, also where there are none."""

    def __init__(self, **node_options: Any) -> None:
        """Wait for sweeps.

        Args:
            node_options: passed on to rclpy's Node.

        Raises:
            ParameterError: the parameters are impossible.
        """
        super().__init__(NODE_NAME, **node_options)
        self._health = Health()
        parameters = NodeParameters(self, ExtractorParameters, self._change).values
        self._extractor = PlotExtractor(parameters, self._health)
        self._plots = TablePublisher(self, PLOTS_TOPIC)
        self._pictures = self.create_publisher(Image, PPI_TOPIC, _PPI_DEPTH)
        self._ppi = _picture(parameters)
        self._subscription = TableSubscription(
            self, SWEEPS_TOPIC, self._extract, self._health, expected=None, profile=qos.SWEEPS_IN
        )
        self._diagnostics = Diagnostics(self, self._health)

    def _extract(self, sweeps: Table) -> None:
        self._health.count("sectors in")
        self._plots.publish(self._extractor.process(sweeps))
        if self._ppi is not None and self._ppi.paint(sweeps):
            self._publish_picture(sweeps)

    def _publish_picture(self, sweeps: Table) -> None:
        seconds, nanoseconds = divmod(sweeps.stamp, NANOSECONDS)
        assert self._ppi is not None
        height, width = self._ppi.image.shape
        picture = Image(height=height, width=width, encoding="mono8", step=width)
        picture.header.stamp.sec, picture.header.stamp.nanosec = seconds, nanoseconds
        picture.header.frame_id = sweeps.frame_id
        picture.data = array.array("B", self._ppi.image.tobytes())
        self._pictures.publish(picture)

    def _change(self, parameters: ExtractorParameters) -> None:
        rest = self._extractor.flush()
        if len(rest.rows):
            self._plots.publish(rest)
        self._extractor = PlotExtractor(parameters, self._health)
        self._ppi = _picture(parameters)
        self.get_logger().info("parameters changed; extraction starts afresh")


def _picture(parameters: ExtractorParameters) -> PlanPosition | None:
    return PlanPosition(parameters.ppi_pixels) if parameters.ppi_pixels else None


def main(args: Sequence[str] | None = None) -> int:
    """Run the node until it is interrupted.

    Args:
        args: command line without the program's name, None for that of the process.

    Returns:
        Exit code: 0 after an interrupt, 2 if it cannot start.
    """
    return run(PlotExtractorNode, args)
