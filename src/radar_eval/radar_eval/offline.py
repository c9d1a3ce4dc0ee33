# SPDX-License-Identifier: Apache-2.0
"""The nodes run from a bag into a bag, through the same pipelines, as fast as the machine allows."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

from radar_common.bag import ODOMETRY, BagWriter, read_messages, topics
from radar_common.cloud import TableError
from radar_common.health import Health
from radar_common.odometry import PlatformState
from radar_common.tables import (
    BEARING,
    BEARINGS_TOPIC,
    CHANNEL_TRUTH_TOPIC,
    PLATFORM_TOPIC,
    PLOT,
    PLOTS_TOPIC,
    SWEEPS_TOPIC,
    TRACK,
    TRACKS_TOPIC,
    TRUTH,
    TRUTH_TOPIC,
    Table,
)
from radar_eval.bearing_chain import BearingChain
from radar_eval.errors import EvaluationError
from radar_eval.radar_chain import RadarChain
from radar_eval.run_record import RunRecord, stage_record
from radar_eval.stages import Stage

READER = "bag"

_LAYOUTS = {
    SWEEPS_TOPIC: None,
    PLOTS_TOPIC: PLOT,
    TRACKS_TOPIC: TRACK,
    BEARINGS_TOPIC: BEARING,
    TRUTH_TOPIC: TRUTH,
    CHANNEL_TRUTH_TOPIC: BEARING,
}

Content = Table | PlatformState
Progress = Callable[..., Iterable[tuple[str, Content]]]


class _Run:
    """The pipelines that a bag has input for, joined by topics as the nodes are."""

    def __init__(self, bag: str | Path, parameters: str | Path | None) -> None:
        # A topic that nobody spoke on is as good as none, but what there is of sweeps or plots must be of use.
        tables = topics(bag)
        platform = topics(bag, ODOMETRY).get(PLATFORM_TOPIC, 0) > 0
        sources = [topic for topic in (SWEEPS_TOPIC, PLOTS_TOPIC) if topic in tables][:1]
        bearings = tables.get(BEARINGS_TOPIC, 0) > 0
        if not sources and not bearings:
            raise EvaluationError(
                f"bag {bag} holds neither /{SWEEPS_TOPIC} nor /{PLOTS_TOPIC} nor /{BEARINGS_TOPIC}"
            )
        # A finder without a radar on a moving platform has nothing to fuse.
        active = bool(sources) or tables.get(TRACKS_TOPIC, 0) > 0
        self.finder = BearingChain(
            fuse=bearings and (active or not platform),
            locate=bearings and platform,
            parameters=parameters,
        )
        # Plots that are fused as they are need no tracker.
        untracked = sources == [PLOTS_TOPIC] and self.finder.active == PLOTS_TOPIC
        self.radar = RadarChain(sources[0], parameters) if sources and not untracked else None
        self.sources = [*sources, *([BEARINGS_TOPIC] if bearings else [])]
        used = {*sources, TRUTH_TOPIC}
        if bearings:
            used |= {BEARINGS_TOPIC, CHANNEL_TRUTH_TOPIC}
            # Tracks of the bag count only where none are made of plots.
            used |= set() if sources else {TRACKS_TOPIC}
        self.expected = {topic: kind for topic, kind in _LAYOUTS.items() if topic in used}
        self.odometry = PLATFORM_TOPIC if bearings and platform else None
        self.total = sum(tables.get(topic, 0) for topic in self.expected)

    @property
    def stages(self) -> dict[str, Stage]:
        """All pipelines by the names of their nodes."""
        return (self.radar.stages if self.radar else {}) | self.finder.stages

    def process(self, topic: str, content: Content) -> Iterator[tuple[str, Content]]:
        """Pass a message through all that hear it, and what comes out through all that hear that."""
        if isinstance(content, Table) and self.radar is not None and topic == self.radar.source:
            yield from self._joined(self.radar.process(content))
        else:
            yield topic, content
            yield from self.finder.process(topic, content)

    def flush(self) -> Iterator[tuple[str, Content]]:
        """Give out what still waits for messages to come."""
        if self.radar is not None:
            yield from self._joined(self.radar.flush())
        yield from self.finder.flush()

    def _joined(self, tables: Iterable[tuple[str, Table]]) -> Iterator[tuple[str, Content]]:
        for topic, table in tables:
            yield topic, table
            yield from self.finder.process(topic, table)

    def record(self, reader: Health) -> RunRecord:
        """Note down how the run fared."""
        plots, seconds = 0, 0.0
        if self.radar is not None:
            plots = self.radar.plots
            seconds = sum(stage.seconds for stage in self.radar.stages.values())
        return RunRecord(
            plots / seconds if seconds else float("nan"),
            {READER: stage_record(0.0, reader)}
            | {name: stage.record() for name, stage in self.stages.items()},
        )


def run_offline(
    bag: str | Path,
    out: str | Path,
    *,
    parameters: str | Path | None = None,
    storage: str = "mcap",
    progress: Progress,
) -> RunRecord:
    """Process a bag: sweeps, or plots where it has no sweeps, and the bearings of a direction finder.

    The new bag holds plots and tracks; passive and fused bearings, emitters and the platform; and the truth that was
    there. It depends on nothing but the bag and the parameters.

    Args:
        bag: folder to read.
        out: folder to write, which must not exist yet.
        parameters: ROS 2 parameter file with a section for each node; None takes the defaults.
        storage: "mcap" or "sqlite3".
        progress: wraps the iteration over the messages, given their number as `total`.

    Returns:
        Throughput and health, also written beside the bag's files.

    Raises:
        EvaluationError: the bag holds no sweeps, plots or bearings that can be read.
        BagError: the bag cannot be read, or the new one cannot be written.
        ParameterError: the parameter file is wrong.
    """
    writer = BagWriter(out, storage=storage)
    run = _Run(bag, parameters)
    reader = Health()
    try:
        with writer:
            messages = read_messages(bag, run.expected, odometry=run.odometry, health=reader)
            for topic, content in progress(messages, total=run.total):
                _pass_on(writer, run, reader, topic, content)
            _write(writer, run.flush())
        for source in run.sources:
            _require_input(bag, source, reader)
    except BaseException:
        # Half a bag would only stand in the way of the next attempt.
        shutil.rmtree(out, ignore_errors=True)
        raise
    record = run.record(reader)
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


def _pass_on(writer: BagWriter, run: _Run, reader: Health, topic: str, content: Content) -> None:
    try:
        _write(writer, run.process(topic, content))
        reader.count(f"messages on /{topic}")
    except TableError as error:
        # As a live node does: what is no table of its kind is dropped and counted.
        reader.drop(f"{topic}: {error}")


def _write(writer: BagWriter, messages: Iterable[tuple[str, Content]]) -> None:
    for topic, content in messages:
        if isinstance(content, PlatformState):
            writer.write_odometry(topic, content)
        else:
            writer.write(topic, content)
