# SPDX-License-Identifier: Apache-2.0
"""Memory of all tracks as one matrix, a row for each quantity, so that every step works on all tracks at once.

Numpy takes about a microsecond a call whatever the length; that the quantities of some tracks can be taken and put
back in one call is what makes a message of a few plots cheap.
"""

from __future__ import annotations

from typing import Any, Self

import numpy as np
import numpy.typing as npt

STATE, COVARIANCE, TIME_OF_STATE = slice(0, 4), slice(4, 20), 20
"""Rows of `Columns.numbers` that a prediction needs; they come first."""
PREDICTED_ROWS = TIME_OF_STATE + 1
_CROSSING, _EXPECTED, _DUE, _PLOT_RANGE = 21, 22, 24, 28
_REAL_ROWS = 30
_HITS = 3
_WHOLE_ROWS = 6
_FIRST_CAPACITY = 64

FloatArray = npt.NDArray[np.float64]


class Columns:
    """Quantities of some tracks, each a writable view; `columns["state"]` is `columns.state`.

    Attributes:
        numbers: those that are real, a row each, shape (rows, n).
        counts: those that are whole, a row each, shape (rows, n).
        memory: what the smoother keeps of each track, shape (n,).
        state: x, y, vx, vy in the radar's frame, m and m/s, shape (n, 4).
        covariance: of the state, shape (n, 4, 4).
        time: of the state, which is that of the last plot, s.
        crossing: when the beam passed last, with a plot or without, s.
        expected: when the beam will pass next, s.
        opens: from when on the beam may find the target again, s.
        due: from when on its absence is a miss, s.
        born: time of the first plot, s.
        score: logarithmic likelihood ratio.
        best: highest score so far.
        plot_range: of the last plot, m.
        plot_azimuth: of the last plot, rad.
        schedule: `expected`, `opens` and `due` together, infinite until they are calculated, shape (3, n).
        passed: `time` and `crossing` together, shape (2, n).
        plot: `plot_range` and `plot_azimuth` together, shape (2, n).
        id: never used again.
        status: TrackStatus.
        reason: EndReason.
        hits: plots in the track.
        misses: passages without a plot since the last one.
        rule: memory of the initiation rule.
        passages: `hits` and `misses` together, shape (2, n).
    """

    def __init__(
        self,
        numbers: npt.NDArray[np.float64],
        counts: npt.NDArray[np.int64],
        memory: npt.NDArray[Any],
    ) -> None:
        """Hold the quantities.

        Args:
            numbers: those that are real, a row each, shape (rows, n).
            counts: those that are whole, a row each, shape (rows, n).
            memory: what the smoother keeps of each track, shape (n,).
        """
        self.numbers = numbers
        self.counts = counts
        self.memory = memory
        self.state: FloatArray = numbers[:4].T
        self.covariance: FloatArray = numbers[4:20].T.reshape(-1, 4, 4)
        # Unpacked in one go, which is cheaper than to look up each when it is needed.
        (
            self.time,
            self.crossing,
            self.expected,
            self.opens,
            self.due,
            self.born,
            self.score,
            self.best,
            self.plot_range,
            self.plot_azimuth,
        ) = numbers[TIME_OF_STATE:]
        self.passed = numbers[TIME_OF_STATE : _CROSSING + 1]
        self.schedule = numbers[_EXPECTED : _DUE + 1]
        self.plot = numbers[_PLOT_RANGE:]
        self.id, self.status, self.reason, self.hits, self.misses, self.rule = counts
        self.passages = counts[_HITS : _HITS + 2]

    @classmethod
    def zeros(cls, count: int, memory: np.dtype[Any]) -> Self:
        """Make room.

        Args:
            count: number of tracks.
            memory: dtype of what the smoother keeps.

        Returns:
            Tracks of zeros.
        """
        return cls(
            np.zeros((_REAL_ROWS, count)),
            np.zeros((_WHOLE_ROWS, count), np.int64),
            np.zeros(count, memory),
        )

    def __len__(self) -> int:
        """Number of tracks."""
        return self.counts.shape[1]

    def __getitem__(self, name: str) -> npt.NDArray[Any]:
        """View of one quantity.

        Args:
            name: of the quantity.

        Returns:
            Array, first axis of length len(self).
        """
        column: npt.NDArray[Any] = getattr(self, name)
        return column

    def take(self, which: npt.NDArray[Any]) -> Columns:
        """Copy some.

        Args:
            which: indices, shape (n,).

        Returns:
            The copy.
        """
        return Columns(
            self.numbers.take(which, axis=1),
            self.counts.take(which, axis=1),
            self.memory.take(which),
        )

    def first(self, number: int) -> Columns:
        """View of the first tracks.

        Args:
            number: of tracks.

        Returns:
            The same memory, cut.
        """
        return Columns(self.numbers[:, :number], self.counts[:, :number], self.memory[:number])


class TrackStore:
    """Growing memory of all tracks; `store["state"]` is a live view of them.

    Attributes:
        live: all tracks, writable, valid until tracks are added or removed.
    """

    def __init__(self, memory: np.dtype[Any]) -> None:
        """Start without tracks.

        Args:
            memory: dtype of the column "memory", which belongs to the smoother.
        """
        self._size = 0
        self._all = Columns.zeros(_FIRST_CAPACITY, memory)
        self.live = self._all.first(0)

    def __len__(self) -> int:
        """Number of tracks."""
        return self._size

    def __getitem__(self, name: str) -> npt.NDArray[Any]:
        """View of one quantity of all tracks, writable, valid until tracks are added or removed.

        Args:
            name: of the quantity.

        Returns:
            Array, first axis of length len(self).
        """
        return self.live[name]

    def take(self, tracks: npt.NDArray[np.intp]) -> Columns:
        """Copy all that is known of some tracks.

        Args:
            tracks: indices, shape (n,).

        Returns:
            The copy, to be changed and given to `put`.
        """
        return self.live.take(tracks)

    def put(self, tracks: npt.NDArray[np.intp], columns: Columns) -> None:
        """Write back what `take` copied.

        Args:
            tracks: the same indices, each once, shape (n,).
            columns: the changed copy.
        """
        live = self.live
        live.numbers[:, tracks] = columns.numbers
        live.counts[:, tracks] = columns.counts
        live.memory[tracks] = columns.memory

    def append(self, columns: Columns) -> None:
        """Add tracks.

        Args:
            columns: all that is known of them.
        """
        before, after = self._size, self._size + len(columns)
        if after > len(self._all):
            larger = Columns.zeros(max(after, 2 * len(self._all)), self._all.memory.dtype)
            larger.numbers[:, :before] = self.live.numbers
            larger.counts[:, :before] = self.live.counts
            larger.memory[:before] = self.live.memory
            self._all = larger
        self._resize(after)
        live = self.live
        live.numbers[:, before:] = columns.numbers
        live.counts[:, before:] = columns.counts
        live.memory[before:] = columns.memory

    def remove(self, gone: npt.NDArray[np.bool_]) -> None:
        """Remove tracks; the last ones move into the gaps.

        Args:
            gone: which, shape (len(self),).
        """
        size = self._size - int(np.count_nonzero(gone))
        gaps = np.flatnonzero(gone[:size])
        self.put(gaps, self.take(size + np.flatnonzero(~gone[size:])))
        self._resize(size)

    def set_memory(self, memory: np.dtype[Any]) -> None:
        """Give the smoother's column another dtype; a column of the dtype that it has keeps its content.

        Args:
            memory: the new dtype.
        """
        if memory != self._all.memory.dtype:
            self._all.memory = np.zeros(len(self._all), memory)
            self._resize(self._size)

    def _resize(self, size: int) -> None:
        self._size = size
        self.live = self._all.first(size)
