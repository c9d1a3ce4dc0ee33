# SPDX-License-Identifier: Apache-2.0
"""The chain run from a bag into a bag, through the same pipelines as the nodes, as fast as the machine allows."""

from __future__ import annotations

import shutil
import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Protocol

from primary_proc.parameters import ExtractorParameters
from primary_proc.plot_extractor import PlotExtractor
from radar_common.bag import BagWriter, read_tables, topics
from radar_common.cloud import TableError
from radar_common.health import Health
from radar_common.parameters import from_file
from radar_common.tables import (
    PLOT,
    PLOTS_TOPIC,
    SWEEPS_TOPIC,
    TRACKS_TOPIC,
    TRUTH,
    TRUTH_TOPIC,
    Table,
)
from radar_eval.errors import EvaluationError
from radar_eval.run_record import RunRecord, StageRecord, stage_record
from secondary_proc.parameters import TrackerParameters
from secondary_proc.tracker import Tracker

EXTRACTOR_NODE, TRACKER_NODE, READER = "plot_extractor", "tracker", "bag"

Progress = Callable[..., Iterable[tuple[str, Table]]]


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

    pipeline: Pipeline
    health: Health
    seconds: float = field(default=0.0, init=False)

    def process(self, table: Table) -> Table:
        """Take in one message, on the clock.

        Args:
            table: message.

        Returns:
            What came out.
        """
        return self._timed(lambda: self.pipeline.process(table))

    def flush(self) -> Table:
        """Give out what is left, on the clock.

        Returns:
            What came out.
        """
        return self._timed(self.pipeline.flush)

    def record(self) -> StageRecord:
        """Note down how the stage fared.

        Returns:
            The record.
        """
        return stage_record(self.seconds, self.health)

    def _timed(self, work: Callable[[], Table]) -> Table:
        begin = time.perf_counter()
        table = work()
        self.seconds += time.perf_counter() - begin
        return table


def run_offline(
    bag: str | Path,
    out: str | Path,
    *,
    parameters: str | Path | None = None,
    storage: str = "mcap",
    progress: Progress,
) -> RunRecord:
    """Process a bag of sweeps, or of plots where it has no sweeps.

    The new bag holds plots, tracks and the truth that was there. It depends on nothing but the bag and the parameters.

    Args:
        bag: folder to read.
        out: folder to write, which must not exist yet.
        parameters: ROS 2 parameter file with sections for plot_extractor and tracker; None takes the defaults.
        storage: "mcap" or "sqlite3".
        progress: wraps the iteration over the messages, given their number as `total`.

    Returns:
        Throughput and health, also written beside the bag's files.

    Raises:
        EvaluationError: the bag holds neither sweeps nor plots that can be read.
        BagError: the bag cannot be read, or the new one cannot be written.
        ParameterError: the parameter file is wrong.
    """
    writer = BagWriter(out, storage=storage)
    held = topics(bag)
    source = SWEEPS_TOPIC if SWEEPS_TOPIC in held else PLOTS_TOPIC
    if source not in held:
        raise EvaluationError(f"bag {bag} holds neither /{SWEEPS_TOPIC} nor /{PLOTS_TOPIC}")
    stages = _stages(source, parameters)
    wanted = {source: None if source == SWEEPS_TOPIC else PLOT, TRUTH_TOPIC: TRUTH}
    reader = Health()
    total = sum(number for topic, number in held.items() if topic in wanted)
    try:
        with writer:
            messages = progress(read_tables(bag, wanted, reader), total=total)
            plots = sum(_pass_on(writer, stages, reader, *message) for message in messages)
            plots += _flush(writer, stages)
        _require_input(bag, source, reader)
    except BaseException:
        # Half a bag would only stand in the way of the next attempt.
        shutil.rmtree(out, ignore_errors=True)
        raise
    seconds = sum(stage.seconds for stage in stages.values())
    record = RunRecord(
        plots / seconds if seconds else float("nan"),
        {READER: stage_record(0.0, reader)}
        | {name: stage.record() for name, stage in stages.items()},
    )
    record.write(out)
    return record


def _require_input(bag: str | Path, source: str, reader: Health) -> None:
    """Refuse a run of which most input was refused: what came out of it would say nothing."""
    refused = {why: number for why, number in reader.dropped.items() if why.startswith(source)}
    used = reader.counts[f"messages on /{source}"]
    if used <= sum(refused.values()):
        reason = max(refused, key=lambda why: refused[why]) if refused else "there is none"
        raise EvaluationError(
            f"bag {bag}: {used} of {used + sum(refused.values())} messages on /{source} can be "
            f"used: {reason.removeprefix(f'{source}: ')}"
        )


def _pass_on(
    writer: BagWriter, stages: dict[str, Stage], reader: Health, topic: str, table: Table
) -> int:
    plots = 0
    try:
        if topic == TRUTH_TOPIC:
            writer.write(TRUTH_TOPIC, table)
        else:
            plots = _process(writer, stages, topic, table)
        reader.count(f"messages on /{topic}")
    except TableError as error:
        # As a live node does: what is no table of its kind is dropped and counted.
        reader.drop(f"{topic}: {error}")
    return plots


def _stages(source: str, parameters: str | Path | None) -> dict[str, Stage]:
    stages: dict[str, Stage] = {}
    if source == SWEEPS_TOPIC:
        stages[EXTRACTOR_NODE] = _stage(
            PlotExtractor, ExtractorParameters, parameters, EXTRACTOR_NODE
        )
    stages[TRACKER_NODE] = _stage(Tracker, TrackerParameters, parameters, TRACKER_NODE)
    return stages


def _stage(pipeline: Any, kind: Any, parameters: str | Path | None, node: str) -> Stage:
    values = kind() if parameters is None else from_file(kind, parameters, node)
    health = Health()
    return Stage(pipeline(values, health), health)


def _process(writer: BagWriter, stages: dict[str, Stage], topic: str, table: Table) -> int:
    if topic == SWEEPS_TOPIC:
        table = stages[EXTRACTOR_NODE].process(table)
    # A message may carry more fields than a plot has; the pipelines take plots and nothing else.
    table = Table(table.stamp, table.rows.astype(PLOT, copy=False), table.frame_id)
    writer.write(PLOTS_TOPIC, table)
    tracks = stages[TRACKER_NODE].process(table)
    writer.write(TRACKS_TOPIC, tracks)
    return len(table.rows)


def _flush(writer: BagWriter, stages: dict[str, Stage]) -> int:
    plots = 0
    if EXTRACTOR_NODE in stages:
        last = stages[EXTRACTOR_NODE].flush()
        if len(last.rows):
            plots = _process(writer, stages, PLOTS_TOPIC, last)
    tracks = stages[TRACKER_NODE].flush()
    if len(tracks.rows):
        writer.write(TRACKS_TOPIC, tracks)
    return plots
