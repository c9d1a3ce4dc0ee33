# SPDX-License-Identifier: Apache-2.0
"""Pipelines of the nodes as stages of an offline run, each with its health and the time that it took."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Protocol

from radar_common.health import Health
from radar_common.parameters import from_file
from radar_common.tables import Table
from radar_eval.run_record import StageRecord, stage_record


class Pipeline(Protocol):
    """What a processing package offers: tables in, tables out."""

    def process(self, table: Table, /) -> Table:
        """Take in one message.

        Args:
            table: message.

        Returns:
            What came out.
        """

    def flush(self) -> Table:
        """Give out what still waits for messages to come."""


@dataclass(slots=True)
class Stage:
    """A pipeline with its health and the time that it took."""

    pipeline: Any
    health: Health
    seconds: float = field(default=0.0, init=False)

    def process(self, table: Table) -> Table:
        """Take in one message, on the clock.

        Args:
            table: message.

        Returns:
            What came out.
        """
        return self.timed(lambda: self.pipeline.process(table))

    def flush(self) -> Table:
        """Give out what is left, on the clock.

        Returns:
            What came out.
        """
        return self.timed(self.pipeline.flush)

    def timed(self, work: Callable[[], Table]) -> Table:
        """Do some work of the pipeline on the clock.

        Args:
            work: gives a table.

        Returns:
            The table.
        """
        begin = time.perf_counter()
        table = work()
        self.seconds += time.perf_counter() - begin
        return table

    def record(self) -> StageRecord:
        """Note down how the stage fared.

        Returns:
            The record.
        """
        return stage_record(self.seconds, self.health)


def make_stage(
    pipeline: Callable[[Any, Health], Pipeline],
    kind: Any,
    parameters: str | Path | None,
    node: str,
) -> Stage:
    """Build a pipeline as its node does.

    Args:
        pipeline: class of it.
        kind: class of its parameters.
        parameters: ROS 2 parameter file; None takes the defaults.
        node: name of the node, which is that of its section in the file.

    Returns:
        The stage.

    Raises:
        ParameterError: the parameter file is wrong.
    """
    values = kind() if parameters is None else from_file(kind, parameters, node)
    health = Health()
    return Stage(pipeline(values, health), health)
