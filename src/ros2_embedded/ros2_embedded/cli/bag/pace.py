# SPDX-License-Identifier: Apache-2.0
"""The time of a bag against the time on the wall."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Pace:
    """A bag's time running at a constant rate.

    Attributes:
        bag_start: Bag time (ns) at the start of the playback.
        wall_start: Monotonic time (ns) at the start of the playback.
        rate: Seconds of bag time a second.
    """

    bag_start: int
    wall_start: int
    rate: float

    def wall_time(self, bag_time: int) -> int:
        """Return the monotonic time (ns) at which a point of bag time is reached.

        Args:
            bag_time: The point (ns).
        """
        return self.wall_start + round((bag_time - self.bag_start) / self.rate)

    def bag_time(self, wall_time: int) -> int:
        """Return the bag time (ns) at a point of monotonic time.

        Args:
            wall_time: The point (ns).
        """
        return self.bag_start + round((wall_time - self.wall_start) * self.rate)
