# SPDX-License-Identifier: Apache-2.0
"""What a pipeline counted, dropped and measured of itself: the content of its node's diagnostics."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Watch:
    """A rate that the design predicts and the pipeline observes."""

    expected: float
    observed: float


class Health:
    """Counts of a running pipeline. Cores write it, nodes publish it, offline runs print it."""

    def __init__(self) -> None:
        """Start with nothing counted."""
        self.counts: Counter[str] = Counter()
        self.dropped: Counter[str] = Counter()
        self.watches: dict[str, Watch] = {}
        self._reported: Counter[str] = Counter()

    def count(self, what: str, number: int = 1) -> None:
        """Add to a count of what went well.

        Args:
            what: name as a reader of diagnostics understands it, such as "plots out".
            number: how many.
        """
        self.counts[what] += int(number)

    def drop(self, reason: str, number: int = 1) -> None:
        """Add to a count of what was refused.

        Args:
            reason: why, such as "sector out of order".
            number: how many; zero is no event.
        """
        if number:
            self.dropped[reason] += int(number)

    def watch(self, name: str, expected: float, observed: float) -> None:
        """Hold an observed rate against the one that the design predicts.

        Args:
            name: of the rate, with its unit, such as "false plots per scan".
            expected: value by design.
            observed: value as measured.
        """
        self.watches[name] = Watch(float(expected), float(observed))

    def news(self) -> dict[str, int]:
        """Take what was dropped since the last call.

        Returns:
            Reason and number, empty where nothing new was dropped.
        """
        fresh = self.dropped - self._reported
        self._reported = Counter(self.dropped)
        return dict(fresh)
