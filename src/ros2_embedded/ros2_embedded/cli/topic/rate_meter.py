# SPDX-License-Identifier: Apache-2.0
"""Rate of a topic over a window of its last messages."""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass

_REPORT_INTERVAL = 1_000_000_000


@dataclass(frozen=True)
class Rate:
    """Statistics of the intervals between messages.

    Attributes:
        mean: Mean interval (ns).
        shortest: Shortest interval (ns).
        longest: Longest interval (ns).
        deviation: Standard deviation of the intervals (ns).
        window: Number of intervals.
    """

    mean: float
    shortest: int
    longest: int
    deviation: float
    window: int

    def __str__(self) -> str:
        """Return the two lines that `ros2 topic hz` prints."""
        frequency = 1e9 / self.mean if self.mean > 0 else 0.0
        return (
            f"average rate: {frequency:.3f}\n"
            f"\tmin: {self.shortest * 1e-9:.3f}s max: {self.longest * 1e-9:.3f}s "
            f"std dev: {self.deviation * 1e-9:.5f}s window: {self.window}"
        )


class RateMeter:
    """Collects arrival times and reports about once a second, as long as messages come.

    Args:
        window: The number of intervals that count.
    """

    def __init__(self, window: int) -> None:
        self._intervals: deque[int] = deque(maxlen=window)
        self._first: int | None = None
        self._last = 0
        self._reported: int | None = None

    def record(self, now: int) -> None:
        """Take note of a message.

        Args:
            now: When it arrived (ns); going backwards starts the window anew.
        """
        if self._first is None or now < self._first:
            self._first = now
            self._reported = None
            self._intervals.clear()
        else:
            self._intervals.append(now - self._last)
        self._last = now

    def report(self) -> Rate | None:
        """Return the statistics if a report is due, else None."""
        if not self._intervals:
            return None
        if self._reported is None:
            self._reported = self._last
            return None
        if self._last < self._reported + _REPORT_INTERVAL:
            return None
        self._reported = self._last
        count = len(self._intervals)
        mean = sum(self._intervals) / count
        deviation = math.sqrt(sum((interval - mean) ** 2 for interval in self._intervals) / count)
        return Rate(mean, min(self._intervals), max(self._intervals), deviation, count)
