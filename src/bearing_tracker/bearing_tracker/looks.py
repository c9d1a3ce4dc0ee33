# SPDX-License-Identifier: Apache-2.0
"""Cuts an ordered row of sightings into looks: what one sensor saw so close in time that a target stands in it once."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from radar_common.health import Health

Rows = npt.NDArray[np.void]


def looks(rows: Rows, span: float, most: int, health: Health) -> Iterator[Rows]:
    """Cut sightings into looks of one channel each.

    Args:
        rows: dtype SIGHTING, in order of time.
        span: seconds that a look lasts at most.
        most: sightings that a look may hold, which bounds time and memory; those above are dropped.
        health: where dropped sightings are counted.

    Yields:
        Sightings of one channel, in order of time, each identity once.
    """
    times, begin = rows["time"], 0
    while begin < len(rows):
        end = int(np.searchsorted(times, times[begin] + span, side="right"))
        part = rows[begin:end]
        begin = end
        for channel in np.unique(part["channel"]):
            same = part if len(part) == 1 else part[part["channel"] == channel]
            single = _each_once(same)
            health.drop("sightings of one identity twice in a look", len(same) - len(single))
            health.drop("sightings over the limit of a look", len(single) - min(len(single), most))
            yield single[:most]


def whole_looks(times: npt.NDArray[np.float64], span: float, until: float) -> int:
    """Count the sightings of looks that are over.

    Args:
        times: of sightings, ascending, seconds, shape (n,).
        span: seconds that a look lasts at most.
        until: no earlier sighting can follow any more, seconds.

    Returns:
        Index of the first sighting of a look that may still grow, n if there is none.
    """
    begin = 0
    while begin < len(times) and times[begin] + span <= until:
        begin = int(np.searchsorted(times, times[begin] + span, side="right"))
    return begin


def _each_once(rows: Rows) -> Rows:
    # The end of a track may share a look with its last plot.
    key = np.where(rows["ended"], -rows["id"], rows["id"])
    _, first = np.unique(key, return_index=True)
    kept = key == 0
    kept[first] = True
    return rows[kept]
