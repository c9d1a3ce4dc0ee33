# SPDX-License-Identifier: Apache-2.0
"""A limit on the plots of a whole turn, kept by raising the criterion everywhere."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

_GAIN = 0.2
_CALM = 0.7
_LARGEST_EXCESS_DB = 15.0


class PlotsLimit:
    """Follows the plots of the last turn, sector by sector.

    Clutter loses some 5 dB of plots a dB of raise, so a fifth of the excess a turn settles in two or three turns and
    does not swing. Between 0.7 of the limit and the limit nothing changes.

    Attributes:
        limit: most plots in a turn.
        raise_db: raise of the criterion, dB.
    """

    def __init__(self, limit: float, largest_db: float, sectors: int) -> None:
        """Start with no plots.

        Args:
            limit: most plots in a turn.
            largest_db: limit of the raise, dB.
            sectors: in a turn.
        """
        self.limit, self._largest = limit, largest_db
        self._coming = np.zeros(sectors, np.int64)
        self._last_turn = np.zeros(sectors, np.int64)
        self.raise_db = 0.0

    @property
    def load(self) -> int:
        """Plots of the last turn."""
        return int(self._last_turn.sum())

    def add(self, sector: npt.NDArray[np.integer]) -> None:
        """Count plots.

        Args:
            sector: of each, shape (n,).
        """
        np.add.at(self._coming, sector, 1)

    def settle(self, sector: int) -> None:
        """Close the account of a sector, all of whose plots have come, and set the raise.

        Args:
            sector: number of the sector.
        """
        self._last_turn[sector], self._coming[sector] = self._coming[sector], 0
        share = self.load / self.limit
        if _CALM <= share <= 1.0:
            return
        excess = 10.0 * math.log10(max(share, 1e-3))
        excess = min(max(excess, -_LARGEST_EXCESS_DB), _LARGEST_EXCESS_DB)
        step = _GAIN * excess / len(self._last_turn)
        self.raise_db = min(max(self.raise_db + step, 0.0), self._largest)
