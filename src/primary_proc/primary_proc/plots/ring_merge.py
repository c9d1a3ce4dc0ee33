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
_NO_PARTS = np.zeros(0, np.int64)


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
            return _groups(self.waiting, _NO_PARTS)
        bursts = joined(self.waiting, closed, going)
        is_open = np.arange(len(bursts)) >= len(bursts) - len(going)
        order = np.lexsort((bursts["start"], bursts["ring"]))
        bursts, is_open = bursts[order], is_open[order]
        end = np.where(is_open, now, bursts["end"])
        part = _connected(bursts["ring"], bursts["start"], end, self.gap)
        parts = int(part.max()) + 1
        begin = np.full(parts, now)
        np.minimum.at(begin, part, bursts["start"])
        grows = np.bincount(part, is_open | (end + self.gap > now), parts) > 0
        grows &= now - begin <= _LONGEST_CHAIN * self.longest
        self.waiting = bursts[grows[part] & ~is_open]
        done = ~grows[part] & ~is_open
        return _groups(bursts[done], part[done])

    def finish(self) -> Groups:
        """Give what was collected, complete or not.

        Returns:
            The groups.
        """
        bursts, self.waiting = self.waiting, self.waiting[:0]
        if not len(bursts):
            return _groups(bursts, _NO_PARTS)
        part = _connected(bursts["ring"], bursts["start"], bursts["end"], self.gap)
        return _groups(bursts, part)


def _groups(bursts: npt.NDArray[np.void], part: npt.NDArray[np.integer]) -> Groups:
    order = np.argsort(part, kind="stable")
    sizes = np.bincount(part)
    sizes = sizes[sizes > 0]
    return Groups(bursts[order], np.cumsum(sizes) - sizes)


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
    origin = int(start.min()) - gap
    span = int(end.max()) - origin + gap + 1
    starts = ring * np.int64(span) + (start - origin)
    ends = ring * np.int64(span) + (end - origin)
    first = np.searchsorted(ends, starts + (span - gap), side="left")
    stop = np.searchsorted(starts, ends + (span + gap), side="right")
    count = np.maximum(stop - first, 0)
    follows = index[:-1][starts[1:] <= ends[:-1] + gap]
    if not count.any() and not len(follows):
        return index
    one = np.concatenate([np.repeat(index, count), follows])
    run = np.arange(count.sum()) - np.repeat(np.cumsum(count) - count - first, count)
    other = np.concatenate([run, follows + 1])
    graph = coo_array((np.ones(len(one), np.int8), (one, other)), (len(ring), len(ring)))
    return connected_components(graph, directed=False)[1]
