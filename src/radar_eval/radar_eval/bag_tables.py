# SPDX-License-Identifier: Apache-2.0
"""The whole of a bag's plots, tracks and truth as flat tables, each row with its time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt

from radar_common.bag import read_tables
from radar_common.cloud import require_finite
from radar_common.health import Health
from radar_common.tables import (
    NANOSECONDS,
    PLOT,
    PLOTS_TOPIC,
    TRACK,
    TRACKS_TOPIC,
    TRUTH,
    TRUTH_TOPIC,
    Table,
)
from radar_eval.errors import ScoreError

FloatArray = npt.NDArray[np.float64]

_LAYOUTS = {PLOTS_TOPIC: PLOT, TRACKS_TOPIC: TRACK, TRUTH_TOPIC: TRUTH}
_NEEDED = {
    PLOTS_TOPIC: ("time_offset", "range", "azimuth"),
    TRACKS_TOPIC: ("time_offset", "x", "y"),
    TRUTH_TOPIC: ("time_offset", "x", "y", "range", "azimuth"),
}


@dataclass(frozen=True, slots=True)
class TimedRows:
    """Rows of one topic.

    Attributes:
        rows: structured array, shape (n,), in order of time.
        time: seconds after the origin of the bag, shape (n,).
        messages: number of messages that they came in.
    """

    rows: npt.NDArray[np.void]
    time: FloatArray
    messages: int

    def __len__(self) -> int:
        """Count the rows."""
        return len(self.rows)


@dataclass(frozen=True, slots=True)
class BagTables:
    """What a bag holds for evaluation.

    Attributes:
        plots: of dtype PLOT.
        tracks: of dtype TRACK.
        truth: of dtype TRUTH.
        origin: nanoseconds since the epoch that all times refer to.
        start: seconds after the origin of the first message of plots.
        stop: seconds after the origin of the last plot or message of plots.
    """

    plots: TimedRows
    tracks: TimedRows
    truth: TimedRows
    origin: int
    start: float
    stop: float


def load_tables(
    path: str | Path, *, truth_path: str | Path | None = None, health: Health | None = None
) -> BagTables:
    """Read a bag of plots, tracks and truth.

    Args:
        path: folder of the bag.
        truth_path: bag to take the truth from instead.
        health: counts messages that do not hold their table.

    Returns:
        The tables; topics that the bag lacks are empty.

    Raises:
        BagError: a bag is missing, truncated or not readable.
        ScoreError: there is no message of plots.
    """
    tables: dict[str, list[Table]] = {topic: [] for topic in _LAYOUTS}
    wanted = dict(_LAYOUTS)
    if truth_path is not None:
        del wanted[TRUTH_TOPIC]
        for topic, table in read_tables(truth_path, {TRUTH_TOPIC: TRUTH}, health):
            tables[topic].append(table)
    for topic, table in read_tables(path, wanted, health):
        tables[topic].append(table)
    if not tables[PLOTS_TOPIC]:
        raise ScoreError(f"bag {path}: no readable message on /{PLOTS_TOPIC}")
    return lay_out(tables, health)


def lay_out(messages: Mapping[str, Sequence[Table]], health: Health | None = None) -> BagTables:
    """Make flat tables of messages, whether they came from a bag or were just computed.

    Args:
        messages: by their topics, some of plots among them; topics that are missing count as empty.
        health: counts rows that cannot be used.

    Returns:
        The tables.
    """
    tables = {topic: list(messages.get(topic, ())) for topic in _LAYOUTS}
    messages_of_plots = tables[PLOTS_TOPIC]
    origin = min(table.stamp for topic in tables for table in tables[topic])
    health = Health() if health is None else health
    plots, tracks, truth = (
        flatten(topic, tables[topic], _LAYOUTS[topic], _NEEDED[topic], origin, health)
        for topic in (PLOTS_TOPIC, TRACKS_TOPIC, TRUTH_TOPIC)
    )
    stamps = [(table.stamp - origin) / NANOSECONDS for table in messages_of_plots]
    return BagTables(
        plots,
        tracks,
        truth,
        origin,
        min(stamps),
        max([*stamps, *plots.time[-1:].tolist()]),
    )


def flatten(
    topic: str,
    tables: Sequence[Table],
    layout: np.dtype[np.void],
    needed: Sequence[str],
    origin: int,
    health: Health,
) -> TimedRows:
    """Put the messages of a topic together.

    Args:
        topic: of them.
        tables: messages.
        layout: of the rows that are wanted; messages may carry more fields, in another order.
        needed: fields that must be finite.
        origin: nanoseconds since the epoch that times refer to.
        health: counts rows that cannot be used.

    Returns:
        All rows, in order of time.
    """
    rows = np.zeros(sum(len(table.rows) for table in tables), layout)
    time = np.empty(len(rows))
    begin = 0
    for table in tables:
        end = begin + len(table.rows)
        for name in layout.names or ():
            rows[name][begin:end] = table.rows[name]
        time[begin:end] = (table.stamp - origin) / NANOSECONDS + table.rows["time_offset"]
        begin = end
    good = require_finite(rows, *needed)
    health.drop(f"{topic}: row with a number that is not finite", int(np.sum(~good)))
    rows, time = rows[good], time[good]
    order = np.argsort(time, kind="stable")
    return TimedRows(rows[order], time[order], len(tables))
