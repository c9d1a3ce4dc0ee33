# SPDX-License-Identifier: Apache-2.0
"""The mean power of every range cell in every bin of azimuth, over turns."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from primary_proc.normalisers.normaliser import FloatArray
from primary_proc.normalisers.reference_window import ReferenceWindow
from radar_common.frames import TWO_PI

_ROWS = 64
_LARGEST = 1e30
_FEWEST_BINS, _MOST_VALUES = 16, 1 << 26
_BIN = 0.5


def bins_for(beamwidth: float, cells: int) -> int:
    """Number of azimuth bins: two in a beamwidth, as far as memory goes.

    Wider bins would blur the flank of a strong echo, whose pulses must be like each other in a bin; narrower ones hold
    fewer pulses to average.

    Args:
        beamwidth: one-way half-power width, rad.
        cells: range cells of a pulse.

    Returns:
        Bins; with the cells they make no more than 2^26 values (256 MB), and 2 MB for 1024 cells and 1.4 deg.
    """
    wanted = math.ceil(TWO_PI / (_BIN * beamwidth))
    return max(_FEWEST_BINS, min(wanted, _MOST_VALUES // cells))


class MapMemory:
    """Follows the beam through the bins; when it leaves one, the mean of its pulses goes into the map.

    The pulses of a bin are gathered first and added up when it is over, so what is learned does not depend on how
    pulses are cut into messages. An encoder that trembles between two bins does not take the beam back.
    """

    def __init__(self, bins: int, weight: float, window: ReferenceWindow, mean: np.float32) -> None:
        """Start with nothing known.

        Args:
            bins: of azimuth in a turn.
            weight: share of the latest turn in the map.
            window: sums reference cells; the memory uses its buffers.
            mean: one over the number of reference cells.
        """
        self._bins, self._weight = bins, np.float32(weight)
        self._window, self._mean = window, mean
        cells = window.inside(window.source(1)).shape[1]
        self._map = np.zeros((bins, cells), np.float32)
        self._known = np.zeros(bins, bool)
        self._rows = np.zeros((_ROWS, cells), np.float32)
        self._sum = np.zeros(cells)
        self._filled = self._pulses = 0
        self._place = -1

    @property
    def level(self) -> npt.NDArray[np.float32] | None:
        """Mean power in the bin at hand, shape (cells,); None in its first turn."""
        return self._map[self._place] if self._known[self._place] else None

    def bin(self, azimuth: FloatArray) -> npt.NDArray[np.int64]:
        """Tell the bin of each azimuth.

        Args:
            azimuth: rad in [0, 2 pi), shape (n,).

        Returns:
            Numbers of the bins, shape (n,).
        """
        place = np.asarray(azimuth * (self._bins / TWO_PI), np.int64)
        return np.minimum(place, self._bins - 1)

    def turn_to(self, place: int) -> None:
        """Go on to a bin; the one before goes into the map.

        Args:
            place: number of the bin that the next pulses are in.
        """
        if self._place >= 0 and (self._place - place) % self._bins <= 1:
            return
        if self._pulses:
            self._keep()
        self._place = place

    def learn(self, power: npt.NDArray[np.float32]) -> None:
        """Gather pulses of the bin at hand.

        Args:
            power: shape (pulses, cells).
        """
        self._pulses += len(power)
        while len(power):
            taken = min(len(power), _ROWS - self._filled)
            self._rows[self._filled : self._filled + taken] = power[:taken]
            self._filled += taken
            power = power[taken:]
            if self._filled == _ROWS:
                self._add_up()

    def _add_up(self) -> None:
        self._sum += self._rows[: self._filled].sum(axis=0, dtype=float)
        self._filled = 0

    def _keep(self) -> None:
        self._add_up()
        latest = np.minimum(self._sum / self._pulses, _LARGEST).astype(np.float32)
        level = self._map[self._place]
        if not self._known[self._place]:
            self._window.inside(self._window.source(1))[0] = latest
            np.multiply(self._window.statistic(1)[0, : len(level)], self._mean, out=level)
            self._known[self._place] = True
        level += self._weight * (latest - level)
        self._sum[:] = 0.0
        self._pulses = 0
