# SPDX-License-Identifier: Apache-2.0
"""Brings plots into order of time and hands them out once no later plot can contest them."""

from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from radar_common.health import Health
from radar_common.tables import NANOSECONDS, Table
from secondary_proc.plot_check import check
from secondary_proc.plots import AZIMUTH, QUEUE_COLUMNS, RANGE, STRENGTH, TIME, FloatArray

if TYPE_CHECKING:
    from secondary_proc.parameters import TrackerParameters


class PlotQueue:
    """Sorted memory of plots that wait, and of those just handed out, against duplicates.

    A plot is ripe once a later message has come, or once its own message shows that the antenna is well past it:
    only then have all plots arrived that a track could take instead of it.
    """

    def __init__(self, health: Health) -> None:
        """Start empty.

        Args:
            health: where refused plots are counted.
        """
        self._health = health
        self._epoch = 0
        self._begun = False
        self._last_stamp = 0
        self._waiting = np.zeros((0, QUEUE_COLUMNS))
        self._handed_out: deque[FloatArray] = deque()
        self._latest = -np.inf
        self._ripe_until = -np.inf
        self.now = -np.inf
        """Latest stamp in seconds since the first message: no plot much older than this will be accepted."""

    def seconds(self, stamp: int) -> float:
        """Time of a stamp on the tracker's own axis, on which floats are exact to less than a microsecond.

        Args:
            stamp: nanoseconds.

        Returns:
            Seconds since the first message.
        """
        if not self._begun:
            self._begun, self._epoch = True, stamp
        return (stamp - self._epoch) / NANOSECONDS

    @property
    def last_stamp(self) -> int:
        """Latest stamp in nanoseconds, 0 before the first message."""
        return self._last_stamp

    @property
    def begin(self) -> float:
        """Time of the first plot that waits, or the present time: all before has been handed out."""
        return float(min(self._waiting[0, TIME], self.now)) if len(self._waiting) else self.now

    def put(self, table: Table, parameters: TrackerParameters, period: float) -> FloatArray:
        """Take in the plots of a message.

        Args:
            table: plots, dtype PLOT.
            parameters: limits and errors by default.
            period: of the antenna, seconds.

        Returns:
            The plots accepted, QUEUE_COLUMNS each, in order of time.
        """
        stamp = self.seconds(table.stamp)
        before = float(self._waiting[-1, TIME]) if len(self._waiting) else -np.inf
        if stamp >= self.now:
            self.now, self._last_stamp = stamp, table.stamp
        self._ripe_until = max(self._ripe_until, self.now, before)
        if not len(table.rows):
            return self._waiting[:0]
        rows = check(table.rows, stamp, parameters, self._health)
        times = rows[:, TIME]
        if len(rows) and not self._is_news(times, self.now - period / 4):
            rows = self._sorted_out(rows, self.now - period / 4)
        if not len(rows):
            return rows
        earliest, latest = float(rows[0, TIME]), float(rows[-1, TIME])
        span = latest - min(earliest, self.now)
        rows = self._strongest(rows, parameters.maximum_plots * max(1.0, span / period))
        if before > earliest:
            waiting = np.concatenate([self._waiting, rows])
            self._waiting = waiting[np.argsort(waiting[:, TIME], kind="stable")]
        else:
            self._waiting = np.concatenate([self._waiting, rows]) if len(self._waiting) else rows
        self._latest = max(self._latest, latest)
        self._ripe_until = max(self._ripe_until, latest - period / 32)
        return rows

    def take(
        self, longest: float, ahead: float, *, everything: bool = False
    ) -> tuple[FloatArray, int] | None:
        """Hand out the next slice of ripe plots, followed by plots that might compete with them.

        Args:
            longest: span of the slice, seconds.
            ahead: how far behind the slice's end competitors are included, seconds.
            everything: whether all plots count as ripe, because no message will follow.

        Returns:
            (plots, ripe): QUEUE_COLUMNS each in order of time, of which the first `ripe` are handed out and the others
            stay in the queue until `take_also` removes them; None if nothing is ripe.
        """
        times = self._waiting[:, TIME]
        if not len(times) or (times[0] > self._ripe_until and not everything):
            return None
        end = times[0] + longest
        if not everything:
            end = min(end, self._ripe_until)
        ripe, seen = times.searchsorted([end, end + ahead], side="right").tolist()
        taken = self._waiting[:seen]
        self._waiting = self._waiting[ripe:]
        while self._handed_out and self._handed_out[0][-1, TIME] <= self.now - 2 * longest:
            self._handed_out.popleft()
        if ripe:
            self._handed_out.append(taken[:ripe])
        return taken, ripe

    def take_also(self, which: npt.NDArray[np.intp]) -> None:
        """Hand out competitors as well, because a ripe plot's track chose them.

        Args:
            which: indices into the queue, that is, into the plots behind the ripe ones of the last `take`.
        """
        if len(which):
            self._handed_out.append(self._waiting[np.sort(which)])
            self._waiting = np.delete(self._waiting, which, axis=0)

    def _is_news(self, times: FloatArray, oldest: float) -> bool:
        # Ascending and later than all before: neither late nor known nor out of order.
        return bool(times[0] > max(self._latest, oldest) and (times[1:] > times[:-1]).all())

    def _sorted_out(self, rows: FloatArray, oldest: float) -> FloatArray:
        late = rows[:, TIME] < oldest
        self._health.drop("plots older than the tracks", int(np.count_nonzero(late)))
        rows = self._without_duplicates(rows[~late] if late.any() else rows)
        return rows[np.argsort(rows[:, TIME], kind="stable")]

    def _without_duplicates(self, rows: FloatArray) -> FloatArray:
        known = np.concatenate([*self._handed_out, self._waiting, rows])
        times = np.sort(known[:, TIME])
        if not (times[1:] == times[:-1]).any():
            return rows
        order = np.lexsort((known[:, RANGE], known[:, AZIMUTH], known[:, TIME]))
        same = np.zeros(len(known), bool)
        ordered = known[order][:, [TIME, RANGE, AZIMUTH]]
        # lexsort is stable, so that of equal plots the one known first stays first.
        same[order[1:]] = (ordered[1:] == ordered[:-1]).all(axis=1)
        fresh = ~same[len(known) - len(rows) :]
        self._health.drop("duplicate plots", len(rows) - int(np.count_nonzero(fresh)))
        return rows[fresh]

    def _strongest(self, rows: FloatArray, limit: float) -> FloatArray:
        if len(rows) <= limit:
            return rows
        self._health.drop("plots over the limit of a scan", len(rows) - int(limit))
        return rows[np.sort(np.argsort(-rows[:, STRENGTH], kind="stable")[: int(limit)])]
