# SPDX-License-Identifier: Apache-2.0
"""Memory of all tracks as one array a quantity, so that every step works on all tracks at once."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

COLUMNS = np.dtype(
    [
        ("id", "u4"),
        ("status", "u1"),
        ("state", "f8", (4,)),  # x, y, vx, vy in the radar's frame, m and m/s
        ("covariance", "f8", (4, 4)),
        ("time", "f8"),  # s, of the state: that of the last plot
        ("crossing", "f8"),  # s, last time the beam passed, with a plot or without
        ("expected", "f8"),  # s, when the beam will pass next
        ("opens", "f8"),  # s, from when on the beam may find the target again
        ("due", "f8"),  # s, from when on its absence is a miss
        ("born", "f8"),  # s, of the first plot
        ("hits", "u4"),
        ("misses", "u4"),
        ("rule", "u1"),  # memory of the initiation rule
        ("score", "f8"),
        ("best", "f8"),  # highest score so far
        ("plot_range", "f8"),
        ("plot_azimuth", "f8"),
    ]
)
_FIRST_CAPACITY = 64


class TrackStore:
    """A growing structure of arrays; `store["state"]` is a live view of all tracks."""

    def __init__(self, memory: np.dtype[Any]) -> None:
        """Start without tracks.

        Args:
            memory: dtype of the column "memory", which belongs to the smoother.
        """
        self._size = 0
        self._memory = memory
        self._columns = self._allocate(_FIRST_CAPACITY)

    def __len__(self) -> int:
        """Number of tracks."""
        return self._size

    def __getitem__(self, name: str) -> npt.NDArray[Any]:
        """View of one quantity of all tracks, writable, valid until tracks are added or removed.

        Args:
            name: one of COLUMNS.

        Returns:
            Array, first axis of length len(self).
        """
        return self._columns[name][: self._size]

    def append(self, values: Mapping[str, npt.ArrayLike], count: int) -> npt.NDArray[np.intp]:
        """Add tracks.

        Args:
            values: one array (count, ...) or scalar for every column.
            count: how many.

        Returns:
            Their indices.
        """
        before, after = self._size, self._size + count
        capacity = len(self._columns["id"])
        if after > capacity:
            larger = self._allocate(max(after, 2 * capacity))
            for name, column in larger.items():
                column[:before] = self._columns[name][:before]
            self._columns = larger
        self._size = after
        for name, column in self._columns.items():
            column[before:after] = values[name]
        return np.arange(before, after)

    def remove(self, gone: npt.NDArray[np.bool_]) -> None:
        """Remove tracks; the last ones move into the gaps.

        Args:
            gone: which, shape (len(self),).
        """
        size = self._size - int(np.count_nonzero(gone))
        gaps = np.flatnonzero(gone[:size])
        movers = size + np.flatnonzero(~gone[size:])
        for column in self._columns.values():
            column[gaps] = column[movers]
        self._size = size

    def set_memory(self, memory: np.dtype[Any]) -> None:
        """Give the smoother's column another dtype; a column of the dtype that it has keeps its content.

        Args:
            memory: the new dtype.
        """
        if memory != self._memory:
            self._memory = memory
            self._columns["memory"] = np.zeros(len(self._columns["id"]), memory)

    def _allocate(self, capacity: int) -> dict[str, npt.NDArray[Any]]:
        assert COLUMNS.names is not None
        columns = {name: np.zeros(capacity, COLUMNS[name]) for name in COLUMNS.names}
        columns["memory"] = np.zeros(capacity, self._memory)
        return columns
