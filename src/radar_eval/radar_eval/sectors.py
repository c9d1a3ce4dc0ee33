# SPDX-License-Identifier: Apache-2.0
"""Rows of a recording cut into messages as a live radar would send them: sector by sector, empty ones too."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from radar_common.tables import NANOSECONDS, Table

SECTORS = 32


def cut_into_sectors(
    rows: npt.NDArray[np.void],
    time: npt.NDArray[np.int64],
    *,
    start: int,
    stop: int,
    period: float,
    frame_id: str,
) -> Iterator[Table]:
    """Group rows by time into windows of 1/32 of a scan.

    A message is stamped with its first row, an empty one with the start of its window.

    Args:
        rows: with a field `time_offset`, which is filled in here, shape (n,); any order.
        time: nanoseconds since the epoch, shape (n,), each in [start, stop].
        start: nanoseconds since the epoch at which the first window opens.
        stop: nanoseconds since the epoch; the last window holds it.
        period: seconds a scan.
        frame_id: of the messages.

    Yields:
        One table a window, in order of time.
    """
    width = period * NANOSECONDS / SECTORS
    windows = int((stop - start) // width) + 1
    openings = start + np.round(np.arange(windows) * width).astype(np.int64)
    order = np.argsort(time, kind="stable")
    rows, time = rows[order], time[order]
    bounds = np.append(np.searchsorted(time, openings), len(time))
    stamps = openings.copy()
    filled = bounds[1:] > bounds[:-1]
    stamps[filled] = time[bounds[:-1][filled]]
    rows["time_offset"] = (time - np.repeat(stamps, np.diff(bounds))) / NANOSECONDS
    for stamp, begin, end in zip(stamps.tolist(), bounds[:-1], bounds[1:], strict=True):
        yield Table(stamp, rows[begin:end], frame_id)
