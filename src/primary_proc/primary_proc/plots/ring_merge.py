# SPDX-License-Identifier: Apache-2.0
"""Bursts of adjacent range rings at the same azimuth belong to one target.

Kuzmin (1967, ch. 3) leaves every ring to itself, so that a pulse across the edge of two range quanta would give two
plots. Here nearness makes a graph, and each connected part of it is one plot.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from primary_proc.detectors.burst_detector import BURST, joined

_LONGEST_CHAIN = 2
_NO_PLOTS = np.zeros(0, np.int64)
_END_OF_TIME = 1 << 62


@dataclass(frozen=True, slots=True)
class Groups:
    """Bursts, those of one plot behind each other.

    Attributes:
        bursts: dtype BURST, shape (n,).
        first: index of each plot's first burst, shape (plots,).
    """

    bursts: npt.NDArray[np.void]
    first: npt.NDArray[np.int64]

    def __len__(self) -> int:
        """Count the plots."""
        return len(self.first)


class RingMerger:
    """Collects ended bursts until no other burst can join them.

    Two bursts of the same or of adjacent rings are connected if no more than a gap lies between the end of one and the
    start of the other: a strong target's burst falls into pieces now and then, and a weak neighbour ring fires late. A
    connected part is complete once none of its bursts is open and the gap after the last has passed. A part that has
    grown over more than two longest bursts, as along a coast, is given out as it is; what goes on joining it after that
    is the same echo and is left out until it ends.

    Attributes:
        longest: limit of a burst's length, in pulses.
        gap: pulses.
        waiting: bursts collected, dtype BURST.
        left_out: bursts that the last call left out.
    """

    def __init__(self, longest: int, gap: int) -> None:
        """Start with nothing collected.

        Args:
            longest: limit of a burst's length, in pulses.
            gap: most pulses between the end of one burst and the start of another of the same target.
        """
        self.longest = longest
        self.gap = gap
        self.waiting = np.zeros(0, BURST)
        self.left_out = 0
        # Which of the waiting bursts have been given out and only hold the place of their echo.
        self._given = np.zeros(0, bool)

    def add(self, closed: npt.NDArray[np.void], going: npt.NDArray[np.void], now: int) -> Groups:
        """Take the bursts that ended and give those whose plot is complete.

        Args:
            closed: bursts that ended since the last call.
            going: all bursts that have not ended.
            now: number of the last pulse processed.

        Returns:
            Complete groups.
        """
        self.left_out = 0
        if not len(closed) and not len(self.waiting):
            return Groups(self.waiting, _NO_PLOTS)
        bursts = joined(self.waiting, closed, going)
        is_open = np.zeros(len(bursts), bool)
        is_open[len(bursts) - len(going) :] = True
        given = np.zeros(len(bursts), bool)
        given[: len(self._given)] = self._given
        end = np.where(is_open, now, bursts["end"])
        order = np.lexsort((bursts["start"], bursts["ring"]))
        part = _connected(bursts["ring"][order], bursts["start"][order], end[order], self.gap)
        by_part = part.argsort(kind="stable")
        part, order = part[by_part], order[by_part]
        bursts, is_open, given, end = bursts[order], is_open[order], given[order], end[order]

        begins = np.ones(len(part), bool)
        np.not_equal(part[1:], part[:-1], out=begins[1:])
        first = begins.nonzero()[0]
        number = np.add.accumulate(begins, dtype=np.int64) - 1
        goes_on = np.logical_or.reduceat(is_open | (end > now - self.gap), first)
        start = bursts["start"]
        spent = np.logical_or.reduceat(given, first)
        too_long = np.minimum.reduceat(start, first) < now - _LONGEST_CHAIN * self.longest
        echo = spent | (goes_on & too_long)
        waits = (goes_on & ~echo)[number]
        kept, done = waits & ~is_open, ~(waits | is_open)
        stays = np.zeros(len(part), bool)
        if np.logical_or.reduce(echo):
            # Of an echo that goes on only those bursts stay that something may still join.
            oldest = np.minimum.reduceat(np.where(is_open, start, now), first)
            stays = (echo & goes_on)[number] & ~is_open & (end + self.gap >= oldest[number])
            prolongs = spent[number]
            self.left_out = int(np.count_nonzero(done & prolongs & ~given))
            kept, done = kept | stays, done & ~prolongs
        self.waiting, self._given = bursts[kept], stays[kept]
        sizes = np.add.reduceat(done, first, dtype=np.int64)
        sizes = sizes[sizes > 0]
        return Groups(bursts[done], np.add.accumulate(sizes) - sizes)

    def finish(self) -> Groups:
        """Give what was collected, complete or not.

        Returns:
            The groups.
        """
        none = self.waiting[:0]
        return self.add(none, none, _END_OF_TIME)


def _connected(
    ring: npt.NDArray[np.int32],
    start: npt.NDArray[np.int64],
    end: npt.NDArray[np.int64],
    gap: int,
) -> npt.NDArray[np.integer]:
    """Label the connected parts of the graph; bursts in order of ring and start.

    Bursts of one ring lie one behind the other, so those of the next ring that are near a burst are a run of the list:
    from the first that ends at its start or later, to the last that starts at its end or earlier, the gap allowed for.
    """
    index = np.arange(len(ring))
    origin = int(np.minimum.reduce(start)) - gap
    span = int(np.maximum.reduce(end)) - origin + gap + 1
    row = ring * np.int64(span) - origin
    starts, ends = row + start, row + end
    first = ends.searchsorted(starts + (span - gap), side="left")
    count = np.maximum(starts.searchsorted(ends + (span + gap), side="right") - first, 0)
    follows = index[:-1][starts[1:] <= ends[:-1] + gap]
    if not np.add.reduce(count) and not len(follows):
        return index
    one = np.concatenate([np.repeat(index, count), follows])
    run = np.arange(len(one) - len(follows)) - np.repeat(np.cumsum(count) - count - first, count)
    return _lowest_labels(one, np.concatenate([run, follows + 1]), index)


def _lowest_labels(
    one: npt.NDArray[np.int64], other: npt.NDArray[np.int64], label: npt.NDArray[np.int64]
) -> npt.NDArray[np.int64]:
    """Give each node the lowest number in its connected part, the edges given by their two ends.

    Where an edge joins two parts, the higher label is linked to the lower, until none does. Graphs of a sector are
    small: a sparse matrix would take ten times as long to build.
    """
    while True:
        low, high = label[one], label[other]
        differ = low != high
        if not np.logical_or.reduce(differ):
            return label
        low, high = low[differ], high[differ]
        label = label.copy()
        np.minimum.at(label, np.maximum(low, high), np.minimum(low, high))
        linked = label[label]
        while not np.array_equal(linked, label):
            label, linked = linked, linked[linked]
