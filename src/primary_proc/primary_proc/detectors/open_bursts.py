# SPDX-License-Identifier: Apache-2.0
"""Bursts under way, and what becomes of them when their ends or their limit come."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from primary_proc.detectors.burst_detector import bursts


class OpenBursts(NamedTuple):
    """Bursts that have not met their end criterion.

    Attributes:
        ring: range cells, shape (n,).
        start: pulse of declaration, shape (n,).
        silent: whether the limit has ended them already, shape (n,).
    """

    ring: npt.NDArray[np.int64]
    start: npt.NDArray[np.int64]
    silent: npt.NDArray[np.bool_]

    @staticmethod
    def none() -> OpenBursts:
        """Make an empty list.

        Returns:
            The list.
        """
        empty = np.zeros(0, np.int64)
        return OpenBursts(empty, empty, empty > 0)

    def joined(self, ring: npt.NDArray[np.int64], start: npt.NDArray[np.int64]) -> OpenBursts:
        """Add bursts that have just been declared.

        Args:
            ring: range cells, shape (m,).
            start: pulse of declaration, shape (m,).

        Returns:
            The bursts of the list, then the new ones.
        """
        return OpenBursts(
            np.concatenate([self.ring, ring]),
            np.concatenate([self.start, start]),
            np.concatenate([self.silent, np.zeros(len(ring), bool)]),
        )

    def close(
        self, end: npt.NDArray[np.int64], ended: npt.NDArray[np.bool_], longest: int
    ) -> tuple[npt.NDArray[np.void], OpenBursts]:
        """Split into bursts that ended and those that go on.

        Args:
            end: pulse of the end, where there is none yet the pulse after the last one seen, shape (n,).
            ended: whether the end is one, shape (n,).
            longest: limit of a burst's length, in pulses.

        Returns:
            (table of the bursts to report, in order of end and ring; bursts to follow, in order of ring).
        """
        limit = self.start + longest
        heard = ~self.silent
        overflow = heard & (end > limit)
        closed = (heard & (ended | overflow)).nonzero()[0]
        kept = (~ended).nonzero()[0]
        kept = kept[self.ring[kept].argsort(kind="stable")]
        silent = (self.silent | overflow)[kept]
        going = OpenBursts(self.ring[kept], self.start[kept], silent)
        if not len(closed):
            return bursts(closed, closed, closed, False), going
        end = np.minimum(end, limit)[closed]
        ring = self.ring[closed]
        # In order of end and ring.
        order = np.lexsort((ring, end))
        closed = closed[order]
        return bursts(ring[order], self.start[closed], end[order], overflow[closed]), going

    def heard(self) -> npt.NDArray[np.void]:
        """List those that the limit has not ended.

        Returns:
            Table of dtype BURST, ends unset.
        """
        heard = ~self.silent
        return bursts(self.ring[heard], self.start[heard], -1, False)
