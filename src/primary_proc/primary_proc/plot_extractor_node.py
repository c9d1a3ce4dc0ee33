# SPDX-License-Identifier: Apache-2.0
"""Node `plot_extractor`: sweeps in, plots out, one message for each sector."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rclpy.node import Node

from primary_proc.parameters import ExtractorParameters
from primary_proc.plot_extractor import PlotExtractor
from radar_common.health import Health
from radar_common.ros import qos
from radar_common.ros.diagnostics import Diagnostics
from radar_common.ros.messages import TablePublisher, TableSubscription
from radar_common.ros.parameters import NodeParameters
from radar_common.ros.run import run
from radar_common.tables import PLOTS_TOPIC, SWEEPS_TOPIC, Table

NODE_NAME = "plot_extractor"


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
        self._subscription = TableSubscription(
            self, SWEEPS_TOPIC, self._extract, self._health, expected=None, profile=qos.SWEEPS_IN
        )
        self._diagnostics = Diagnostics(self, self._health)

    def _extract(self, sweeps: Table) -> None:
        self._health.count("sectors in")
        self._plots.publish(self._extractor.process(sweeps))

    def _change(self, parameters: ExtractorParameters) -> None:
        rest = self._extractor.flush()
        if len(rest.rows):
            self._plots.publish(rest)
        self._extractor = PlotExtractor(parameters, self._health)
        self.get_logger().info("parameters changed; extraction starts afresh")


def main(args: Sequence[str] | None = None) -> int:
    """Run the node until it is interrupted.

    Args:
        args: command line without the program's name, None for that of the process.

    Returns:
        Exit code: 0 after an interrupt, 2 if it cannot start.
    """
    return run(PlotExtractorNode, args)
