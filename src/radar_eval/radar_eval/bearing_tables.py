# SPDX-License-Identifier: Apache-2.0
"""The whole of a bag's bearings and emitters, and the truth about them, as flat tables."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from radar_common.bag import read_tables
from radar_common.health import Health
from radar_common.tables import (
    BEARING,
    BEARINGS_TOPIC,
    CHANNEL_TRUTH_TOPIC,
    EMITTER,
    EMITTERS_TOPIC,
    FUSED_BEARINGS_TOPIC,
    PLOT,
    PLOTS_TOPIC,
    TRUTH,
    TRUTH_TOPIC,
    Table,
)
from radar_eval.bag_tables import TimedRows, flatten

_LAYOUTS = {
    PLOTS_TOPIC: PLOT,
    BEARINGS_TOPIC: BEARING,
    FUSED_BEARINGS_TOPIC: BEARING,
    EMITTERS_TOPIC: EMITTER,
    CHANNEL_TRUTH_TOPIC: BEARING,
    TRUTH_TOPIC: TRUTH,
}
_RESULTS = (FUSED_BEARINGS_TOPIC, EMITTERS_TOPIC)
_TRUTHS = (CHANNEL_TRUTH_TOPIC, TRUTH_TOPIC)
_NEEDED = ("time_offset", "azimuth")


@dataclass(frozen=True, slots=True)
class BearingTables:
    """What a bag holds of bearings.

    Attributes:
        active: plots, of dtype PLOT.
        passive: bearings of the direction finder, of dtype BEARING.
        fused: fused bearings, of dtype BEARING.
        emitters: of dtype EMITTER.
        channels: truth about both channels, of dtype BEARING.
        truth: of dtype TRUTH.
    """

    active: TimedRows
    passive: TimedRows
    fused: TimedRows
    emitters: TimedRows
    channels: TimedRows
    truth: TimedRows

    @property
    def has_results(self) -> bool:
        """Whether there are fused bearings or emitters."""
        return bool(len(self.fused) or len(self.emitters))


def load_bearing_tables(
    path: str | Path, *, truth_path: str | Path | None = None, health: Health | None = None
) -> BearingTables:
    """Read what a bag holds of bearings.

    Args:
        path: folder of the bag.
        truth_path: bag to take the truth from instead.
        health: counts messages that do not hold their table.

    Returns:
        The tables; topics that the bag lacks are empty.

    Raises:
        BagError: a bag is missing, truncated or not readable.
    """
    tables: dict[str, list[Table]] = {topic: [] for topic in _LAYOUTS}
    truths = {topic: _LAYOUTS[topic] for topic in _TRUTHS}
    others = {topic: kind for topic, kind in _LAYOUTS.items() if topic not in truths}
    for source, wanted in ((path, others), (truth_path or path, truths)):
        for topic, table in read_tables(source, wanted, health):
            tables[topic].append(table)
    return lay_out_bearings(tables, health)


def lay_out_bearings(
    messages: Mapping[str, Sequence[Table]], health: Health | None = None
) -> BearingTables:
    """Make flat tables of messages, whether they came from a bag or were just computed.

    Args:
        messages: by their topics; topics that are missing count as empty.
        health: counts rows that cannot be used.

    Returns:
        The tables.
    """
    tables = {topic: messages.get(topic, ()) for topic in _LAYOUTS}
    origin = min((table.stamp for part in tables.values() for table in part), default=0)
    counts = Health() if health is None else health
    active, passive, fused, emitters, channels, truth = (
        flatten(topic, part, _LAYOUTS[topic], _NEEDED, origin, counts)
        for topic, part in tables.items()
    )
    return BearingTables(active, passive, fused, emitters, channels, truth)
