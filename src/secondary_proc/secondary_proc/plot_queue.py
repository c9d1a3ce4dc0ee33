# SPDX-License-Identifier: Apache-2.0
"""Brings plots into order of time and hands them out once no later plot can contest them."""

from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from radar_common.health import Health
from radar_common.tables import NANOSECONDS, Table
from secondary_proc.plot_check import PlotCheck
from secondary_proc.plots import AZIMUTH, PLOT_ROWS, RANGE, STRENGTH, TIME, FloatArray

if TYPE_CHECKING:
    from secondary_proc.parameters import TrackerParameters


class PlotQueue:
    """Sorted memory of plots that wait, and of those just handed out, against duplicates.

    A plot is ripe once a later message has come, or once its own message shows that the antenna is well past it:
    only then have all plots arrived that a track could take instead of it.
    """

    def __init__(self, parameters: TrackerParameters, health: Health) -> None:
        """Start empty.

        Args:
            parameters: limits and errors by default.
            health: where refused plots are counted.
        """
        self._health = health
        self.reconfigure(parameters)
        self._epoch = 0
        self._begun = False
        self._last_stamp = 0
        self._waiting = np.zeros((PLOT_ROWS, 0))
        self._handed_out: deque[FloatArray] = deque()
        self._latest = -np.inf
        self._ripe_until = -np.inf
        self.now = -np.inf
        """Latest stamp in seconds since the first message: no plot much older than this will be accepted."""

    def reconfigure(self, parameters: TrackerParameters) -> None:
        """Go on with other limits and the same plots.

        Args:
            parameters: limits and errors by default.
        """
        self._check = PlotCheck(parameters)
        self._most = parameters.maximum_plots

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

    def start(self, stamp: int) -> float:
        """Take up the time where another tracker left it.

        Args:
            stamp: of its last message, nanoseconds.

        Returns:
            The same in seconds.

        Raises:
            RuntimeError: there have been messages already.
        """
        if self._begun:
            raise RuntimeError("tracks can be taken over before the first message only")
        self.now, self._last_stamp = self.seconds(stamp), stamp
        return self.now

    @property
    def last_stamp(self) -> int:
        """Latest stamp in nanoseconds, 0 before the first message."""
        return self._last_stamp

    @property
    def begin(self) -> float:
        """Time of the first plot that waits, or the present time: all before has been handed out."""
        waiting = self._waiting[TIME]
        return min(float(waiting[0]), self.now) if len(waiting) else self.now

    def put(self, table: Table, period: float) -> FloatArray:
        """Take in the plots of a message.

        Args:
            table: plots, dtype PLOT.
            period: of the antenna, seconds.

        Returns:
            The plots accepted, in order of time, shape (PLOT_ROWS, n).
        """
        stamp = self.seconds(table.stamp)
        waiting = self._waiting[TIME]
        before = float(waiting[-1]) if len(waiting) else -np.inf
        if stamp >= self.now:
            self.now, self._last_stamp = stamp, table.stamp
        self._ripe_until = max(self._ripe_until, self.now, before)
        if not len(table.rows):
            return self._waiting[:, :0]
        plots = self._check(table.rows, stamp, self._health)
        times = plots[TIME]
        if len(times) and not self._is_news(times, self.now - period / 4):
            plots = self._sorted_out(plots, self.now - period / 4)
            times = plots[TIME]
        if not len(times):
            return plots
        earliest, latest = float(times[0]), float(times[-1])
        span = latest - min(earliest, self.now)
        plots = self._strongest(plots, self._most * max(1.0, span / period))
        if len(waiting):
            joined = np.concatenate([self._waiting, plots], axis=1)
            if before > earliest:
                joined = joined[:, np.argsort(joined[TIME], kind="stable")]
            self._waiting = joined
        else:
            self._waiting = plots
        self._latest = max(self._latest, latest)
        self._ripe_until = max(self._ripe_until, latest - period / 32)
        return plots

    def take(
        self, longest: float, ahead: float, *, everything: bool = False
    ) -> tuple[FloatArray, int] | None:
        """Hand out the next slice of ripe plots, followed by plots that might compete with them.

        Args:
            longest: span of the slice, seconds.
            ahead: how far behind the slice's end competitors are included, seconds.
            everything: whether all plots count as ripe, because no message will follow.

        Returns:
            (plots, ripe): in order of time, shape (PLOT_ROWS, n), of which the first `ripe` are handed out and the
            others stay in the queue until `take_also` removes them; None if nothing is ripe.
        """
        times = self._waiting[TIME]
        if not len(times) or ((first := float(times[0])) > self._ripe_until and not everything):
            return None
        end = first + longest
        if not everything:
            end = min(end, self._ripe_until)
        ripe, seen = times.searchsorted([end, end + ahead], side="right").tolist()
        taken = self._waiting[:, :seen]
        self._waiting = self._waiting[:, ripe:]
        while self._handed_out and self._handed_out[0][TIME, -1] <= self.now - 2 * longest:
            self._handed_out.popleft()
        if ripe:
            self._handed_out.append(taken[:, :ripe])
        return taken, ripe

    def take_also(self, which: npt.NDArray[np.intp]) -> None:
        """Hand out competitors as well, because a ripe plot's track chose them.

        Args:
            which: indices into the queue, that is, into the plots behind the ripe ones of the last `take`.
        """
        if len(which):
            self._handed_out.append(self._waiting[:, np.sort(which)])
            self._waiting = np.delete(self._waiting, which, axis=1)

    def _is_news(self, times: FloatArray, oldest: float) -> bool:
        # Ascending and later than all before: neither late nor known nor out of order.
        if times[0] <= max(self._latest, oldest):
            return False
        return int(np.count_nonzero(times[1:] > times[:-1])) == len(times) - 1

    def _sorted_out(self, plots: FloatArray, oldest: float) -> FloatArray:
        late = plots[TIME] < oldest
        self._health.drop("plots older than the tracks", int(np.count_nonzero(late)))
        plots = self._without_duplicates(plots[:, ~late] if late.any() else plots)
        return plots[:, np.argsort(plots[TIME], kind="stable")]

    def _without_duplicates(self, plots: FloatArray) -> FloatArray:
        known = np.concatenate([*self._handed_out, self._waiting, plots], axis=1)
        times = np.sort(known[TIME])
        if not (times[1:] == times[:-1]).any():
            return plots
        order = np.lexsort((known[RANGE], known[AZIMUTH], known[TIME]))
        same = np.zeros(len(order), bool)
        ordered = known[[[TIME], [RANGE], [AZIMUTH]], order]
        # lexsort is stable, so that of equal plots the one known first stays first.
        same[order[1:]] = (ordered[:, 1:] == ordered[:, :-1]).all(axis=0)
        fresh = ~same[len(order) - plots.shape[1] :]
        self._health.drop("duplicate plots", int(np.count_nonzero(~fresh)))
        return plots[:, fresh]

    def _strongest(self, plots: FloatArray, limit: float) -> FloatArray:
        count = plots.shape[1]
        if count <= limit:
            return plots
        self._health.drop("plots over the limit of a scan", count - int(limit))
        return plots[:, np.sort(np.argsort(-plots[STRENGTH], kind="stable")[: int(limit)])]
