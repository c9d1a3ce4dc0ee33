# SPDX-License-Identifier: Apache-2.0
"""Numbers for what a sensor does not number: never used twice, and not again after a restart."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from radar_common.tables import NANOSECONDS

FIRST_OWN = 1 << 31
"""Own numbers start here; sensors and trackers count from one and do not come that far."""

_OWN = 1 << 31
_PER_SECOND = 64


class Identities:
    """Gives out numbers from `FIRST_OWN` on.

    They begin at the time of the first message, 64 to the second: the same recording gives the same numbers, and a
    process that is killed and started again does not repeat those of its predecessor, unless that gave out more than
    64 new ones a second for all its life.
    """

    def __init__(self) -> None:
        """Start before the first message."""
        self._next: int | None = None

    def start(self, stamp: int) -> None:
        """Begin to count; once begun, the count goes on.

        Args:
            stamp: of the first message, nanoseconds.
        """
        if self._next is None:
            self._next = (stamp * _PER_SECOND // NANOSECONDS) % _OWN

    def take(self, count: int) -> npt.NDArray[np.int64]:
        """Give out numbers.

        Args:
            count: how many.

        Returns:
            Shape (count,).
        """
        first = self._next or 0
        self._next = (first + count) % _OWN
        return FIRST_OWN + (first + np.arange(count, dtype=np.int64)) % _OWN
