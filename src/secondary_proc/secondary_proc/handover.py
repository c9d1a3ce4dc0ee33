# SPDX-License-Identifier: Apache-2.0
"""What one tracker leaves to the next, in memory or in a file that survives whatever ends the process."""

from __future__ import annotations

import os
import tempfile
import zipfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from radar_common.tables import TRACK, Table, TrackStatus

_RESERVED_IDS = 1_000_000
"""Ids that may have been given out between the last writing of the file and the end of the process."""


class HandoverError(ValueError):
    """The file holds nothing that a tracker could go on with; the text says why."""


@dataclass(frozen=True, slots=True)
class Handover:
    """Tracks at a moment.

    Attributes:
        tracks: dtype TRACK, in the map; of several rows of one id the last counts, and only confirmed and coasting
            tracks are continued. The stamp is that of the last message processed.
        next_id: first id that was never given out, 0 if only the rows tell.
        period: of the antenna, seconds, 0 for unknown.
    """

    tracks: Table
    next_id: int = 0
    period: float = 0.0

    def alive(self) -> np.ndarray[tuple[int], np.dtype[np.void]]:
        """Rows to go on with.

        Returns:
            The last row of each track that is confirmed or coasting, and finite.
        """
        rows = self.tracks.rows
        last = len(rows) - 1 - np.unique(rows["id"][::-1], return_index=True)[1]
        rows = rows[np.sort(last)]
        kept = np.isin(rows["status"], (TrackStatus.CONFIRMED, TrackStatus.COASTING))
        for name in ("x", "y", "vx", "vy", "time_offset", "age"):
            kept &= np.isfinite(rows[name])
        kept &= np.isfinite(rows["covariance"]).all(axis=1)
        chosen: np.ndarray[tuple[int], np.dtype[np.void]] = rows[kept]
        return chosen

    def save(self, path: str | Path) -> None:
        """Write a file, in one step: a reader sees the old one or the new one.

        Args:
            path: of the file.

        Raises:
            OSError: it cannot be written.
        """
        target = Path(path)
        descriptor, name = tempfile.mkstemp(prefix=target.name, dir=target.parent)
        try:
            with os.fdopen(descriptor, "wb") as file:
                np.savez(
                    file,
                    rows=self.tracks.rows,
                    stamp=np.int64(self.tracks.stamp),
                    next_id=np.int64(self.next_id),
                    period=np.float64(self.period),
                )
            Path(name).replace(target)
        except BaseException:
            Path(name).unlink(missing_ok=True)
            raise

    @classmethod
    def load(cls, path: str | Path) -> Handover:
        """Read a file.

        Args:
            path: of the file.

        Returns:
            What it holds, with ids that nobody can have seen.

        Raises:
            HandoverError: it is none of ours, or broken.
            FileNotFoundError: there is none.
        """
        try:
            with np.load(path, allow_pickle=False) as held:
                rows, period = held["rows"], float(held["period"])
                stamp, next_id = int(held["stamp"]), int(held["next_id"])
        except FileNotFoundError:
            raise
        except (OSError, ValueError, KeyError, EOFError, TypeError, zipfile.BadZipFile) as error:
            raise HandoverError(f"state file {path}: {error}") from error
        if rows.dtype != TRACK or rows.ndim != 1 or not np.isfinite(period) or next_id < 1:
            raise HandoverError(f"state file {path} holds no tracks of this version")
        return cls(Table(stamp, rows), next_id + _RESERVED_IDS, max(period, 0.0))
