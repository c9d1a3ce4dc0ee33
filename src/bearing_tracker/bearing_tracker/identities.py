# SPDX-License-Identifier: Apache-2.0
"""Numbers of targets and emitters: those of a sensor where they are free, else own ones; none is used twice."""

from __future__ import annotations

from collections import deque

import numpy as np
import numpy.typing as npt

from radar_common.tables import NANOSECONDS

FIRST_OWN = 1 << 31
"""Own numbers start here; sensors and trackers count from one and do not come that far."""

_OWN = 1 << 31
_PER_SECOND = 64
_REMEMBERED = 100_000


class Identities:
    """Gives out numbers.

    Own ones begin at the time of the first message, 64 to the second: the same recording gives the same numbers, and a
    process that is killed and started again does not repeat those of its predecessor, unless that gave out more than
    64 new ones a second for all its life.
    """

    def __init__(self) -> None:
        """Start before the first message."""
        self._next: int | None = None
        self._used: set[int] = set()
        self._order: deque[int] = deque()

    def start(self, stamp: int) -> None:
        """Begin to count; once begun, the count goes on.

        Args:
            stamp: of the first message, nanoseconds.
        """
        if self._next is None:
            self._next = (stamp * _PER_SECOND // NANOSECONDS) % _OWN

    def take(self, wanted: npt.NDArray[np.int64]) -> npt.NDArray[np.int64]:
        """Give out numbers, the wanted one where it has not been used before.

        Args:
            wanted: numbers of a sensor, 0 for any, shape (n,).

        Returns:
            Shape (n,).
        """
        given = []
        for number in wanted.tolist():
            if number == 0 or number >= FIRST_OWN or number in self._used:
                number = self._own()
            else:
                self._remember(number)
            given.append(number)
        return np.array(given, np.int64)

    def _own(self) -> int:
        first = self._next or 0
        self._next = (first + 1) % _OWN
        return FIRST_OWN + first

    def _remember(self, number: int) -> None:
        self._used.add(number)
        self._order.append(number)
        if len(self._order) > _REMEMBERED:
            self._used.discard(self._order.popleft())
