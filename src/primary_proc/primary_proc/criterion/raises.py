# SPDX-License-Identifier: Apache-2.0
"""Which zones are looked at, and by how much the criterion is raised in each."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from primary_proc.criterion.clutter_tail import LEVELS_DB, needed_raise_db
from primary_proc.criterion.zones import Zones

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]

_SUSPICIOUS = 3
_MARGIN_DB = 0.5
_START_DB, _STOP_DB = 1.5, 0.75
_FALL_DB = 1.5
_MEMORY = 4
_PAUSE, _LONGEST_PAUSE = 4, 256
_MOST_AT_ONCE = 0.25
_NONE = np.zeros(0, np.int64)


class Raises:
    """Raise of each zone, and what it rests on.

    A zone with three plots more in a turn than noise makes is suspicious, and so are the zones around one that was
    raised, for clutter has an extent. A suspicious zone that is found clean is left alone for some turns, twice as many
    each time, so that a busy airport costs nothing. A raised zone is looked at every other turn. The raise begins at
    1.5 dB and ends below 0.75 dB, and falls by no more than
    1.5 dB a look, so that clutter which comes and goes does not flood the plots each time.

    Attributes:
        raise_db: raise of the criterion, dB, shape (sectors, zones).
        busy: for each sector, whether there may be something to choose in it.
    """

    def __init__(self, zones: Zones, largest_db: float) -> None:
        """Start with nothing raised.

        Args:
            zones: of the coverage.
            largest_db: limit of a raise, dB.
        """
        self._zones, self._largest = zones, largest_db
        shape = zones.sectors, len(zones)
        self.raise_db: FloatArray = np.zeros(shape)
        self._suspicious = np.zeros(shape, bool)
        self.busy = [False] * zones.sectors
        self._pause = np.zeros(shape, np.int64)
        self._next_pause = np.full(shape, _PAUSE)
        self._looks = np.zeros(shape, np.int64)
        self._waited = np.zeros(shape, np.int64)
        self._mean = np.zeros((*shape, len(LEVELS_DB)))

    def suspect(self, plots: IntArray, expected: FloatArray) -> None:
        """Look for zones with too many plots.

        Args:
            plots: of each zone in its last turn, zero for those not asked about, shape (sectors, zones).
            expected: plots of each zone in a turn that noise makes, shape (zones,).
        """
        crowded = plots >= _SUSPICIOUS + expected
        if crowded.any():
            self._suspicious |= crowded
            for sector in np.flatnonzero(crowded.any(axis=1)).tolist():
                self.busy[sector] = True

    def choose(self, sector: int) -> IntArray:
        """Choose the zones of a sector to look at in this turn.

        Args:
            sector: that the beam enters.

        Returns:
            Numbers of zones, ascending, shape (n,).
        """
        if not self.busy[sector]:
            return _NONE
        raised = self.raise_db[sector] > 0.0
        self._pause[sector] = np.maximum(self._pause[sector] - 1, 0)
        self.busy[sector] = bool(
            (self._suspicious[sector] | raised | (self._pause[sector] > 0)).any()
        )
        self._waited[sector] += 1
        wanted = np.where(
            raised, self._waited[sector] >= 2, self._suspicious[sector] & (self._pause[sector] == 0)
        )
        chosen = np.flatnonzero(wanted)
        most = max(2, round(_MOST_AT_ONCE * len(raised)))
        if len(chosen) > most:
            longest_first = np.argsort(-self._waited[sector, chosen], kind="stable")
            chosen = np.sort(chosen[longest_first[:most]])
        self._waited[sector, chosen] = 0
        return chosen

    def learn(
        self,
        sector: int,
        zone: IntArray,
        counts: FloatArray,
        noise: FloatArray,
        expected: FloatArray,
    ) -> None:
        """Take over what a look has shown.

        Args:
            sector: that the beam leaves.
            zone: zones looked at, shape (n,).
            counts: bursts of each at each of LEVELS_DB, shape (n, levels).
            noise: the same as noise alone makes it, shape (n, levels).
            expected: bursts of each in a turn that noise makes by design, shape (n,).
        """
        self._looks[sector, zone] += 1
        weight = 1.0 / np.minimum(self._looks[sector, zone], _MEMORY)
        mean = self._mean[sector, zone]
        mean += weight[:, None] * (counts - mean)
        self._mean[sector, zone] = mean
        needed = needed_raise_db(mean, noise, expected, self._zones.resolution_cells[zone])

        before = self.raise_db[sector, zone]
        least = np.where(before > 0.0, _STOP_DB, _START_DB)
        after = np.where(needed < least, 0.0, np.minimum(needed + _MARGIN_DB, self._largest))
        after = np.maximum(after, before - _FALL_DB)
        after[after < _STOP_DB] = 0.0
        self.raise_db[sector, zone] = after
        self._rest(sector, zone[after == 0.0])
        self._spread(sector, zone[(before == 0.0) & (after > 0.0)])

    def _rest(self, sector: int, zone: IntArray) -> None:
        self._suspicious[sector, zone] = False
        self._looks[sector, zone] = 0
        pause = self._next_pause[sector, zone]
        self._pause[sector, zone] = pause
        self._next_pause[sector, zone] = np.minimum(2 * pause, _LONGEST_PAUSE)

    def _spread(self, sector: int, zone: IntArray) -> None:
        around = self._zones.neighbours(sector, zone)
        self._suspicious[around] = True
        for other in set(around[0].tolist()):
            self.busy[other] = True
        self._pause[around] = 0
        self._next_pause[around] = _PAUSE
