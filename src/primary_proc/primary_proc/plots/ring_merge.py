# SPDX-License-Identifier: Apache-2.0
"""Bursts of adjacent range rings at the same azimuth belong to one target.

Kuzmin (1967, ch. 3) leaves every ring to itself, so that a pulse across the edge of two range quanta would give two
plots. Here nearness makes a graph, and each connected part of it is one plot.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

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
    grown over more than two longest bursts, as along a coast, is cut.

    Attributes:
        longest: limit of a burst's length, in pulses.
        gap: pulses.
        waiting: bursts collected, dtype BURST.
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

    def add(self, closed: npt.NDArray[np.void], going: npt.NDArray[np.void], now: int) -> Groups:
        """Take the bursts that ended and give those whose plot is complete.

        Args:
            closed: bursts that ended since the last call.
            going: all bursts that have not ended.
            now: number of the last pulse processed.

        Returns:
            Complete groups.
        """
        if not len(closed) and not len(self.waiting):
            return Groups(self.waiting, _NO_PLOTS)
        bursts = joined(self.waiting, closed, going)
        is_open = np.zeros(len(bursts), bool)
        is_open[len(bursts) - len(going) :] = True
        end = np.where(is_open, now, bursts["end"])
        order = np.lexsort((bursts["start"], bursts["ring"]))
        part = _connected(bursts["ring"][order], bursts["start"][order], end[order], self.gap)
        by_part = part.argsort(kind="stable")
        part, order = part[by_part], order[by_part]
        bursts, is_open, end = bursts[order], is_open[order], end[order]

        begins = np.ones(len(part), bool)
        np.not_equal(part[1:], part[:-1], out=begins[1:])
        first = begins.nonzero()[0]
        grows = np.logical_or.reduceat(is_open | (end > now - self.gap), first)
        grows &= np.minimum.reduceat(bursts["start"], first) >= now - _LONGEST_CHAIN * self.longest
        growing = grows[np.add.accumulate(begins, dtype=np.int64) - 1]
        self.waiting = bursts[growing & ~is_open]
        done = ~(growing | is_open)
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
    """Number the connected parts of the graph; bursts in order of ring and start.

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
    run = np.arange(count.sum()) - np.repeat(np.cumsum(count) - count - first, count)
    other = np.concatenate([run, follows + 1])
    graph = coo_array((np.ones(len(one), np.int8), (one, other)), (len(ring), len(ring)))
    return connected_components(graph, directed=False)[1]
