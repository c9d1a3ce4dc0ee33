# SPDX-License-Identifier: Apache-2.0
"""A clutter map that learns over turns, together with cell averaging along range."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import numpy.typing as npt

from primary_proc.calculators.cfar.map_law import MapLevel, map_variance
from primary_proc.normalisers.map_memory import MapMemory
from primary_proc.normalisers.normaliser import FloatArray, square_in_place
from primary_proc.normalisers.reference_window import ReferenceWindow, behind, fitting_half
from primary_proc.normalisers.shift_network import ShiftNetwork
from primary_proc.normalisers.sliding_windows import window_sum
from primary_proc.normalisers.window_normaliser import WindowNormaliser

_PULSES = 8.0
_LARGEST_POWER = 16.0
_NODES = 257


class ClutterMap(WindowNormaliser):
    """Power of a cell over the greater of two levels: that of the map and that of the reference cells beside it.

    The map knows clutter that stays where it is, down to a single mast; the reference cells know what moves, such as
    the front of rain. A cell must exceed both.

    The map's cells are half a beamwidth wide and one range cell long. Each keeps a mean power that takes over the
    share `weight` of the mean of a turn's pulses (`MapMemory`). It begins with the level that cell averaging finds in
    the first turn, not with the cell's own power, so nothing is hidden in the second turn that was seen in the first.
    An echo that stays in a cell disappears when the map holds more than 1/T of its power, T being the threshold: after
    ln(1 - 1/T) / ln(1 - weight) turns, which is 5 with a weight of 0.05 and T = 4.4. On the flanks of the beam a strong
    echo rises within a bin, and its last plots take twice as long to go.

    In noise the law of the greater level is the same in every turn but the first: after some pulses the map's level
    varies so little that its threshold does not depend on how long it has learned. In the first turn there is only
    cell averaging; its ratios are moved to those that noise exceeds as rarely by the map's law.
    """

    def __init__(self, cells: int, reference: int, guard: int, weight: float, bins: int) -> None:
        """Bind to a number of cells.

        Args:
            cells: range cells of a pulse.
            reference: reference cells on each side; fewer where the range is too short for them.
            guard: cells on each side between the cell under test and its reference cells.
            weight: share of the latest turn in the map.
            bins: of azimuth in a turn.

        Raises:
            ValueError: there is no room for reference cells.
        """
        half = fitting_half(cells, reference, guard)
        first = _PULSES * 2 * half
        law = MapLevel(2 * half, map_variance(weight, _PULSES, np.inf, first))
        super().__init__(cells, law, 1)
        network = ShiftNetwork()
        total = window_sum(network, half)
        plan = network.plan(network.combine(np.add, total, total.ahead(behind(half, guard))))
        self._window = ReferenceWindow(cells, half, guard, plan, np.float32)
        self._mean = np.float32(1.0 / (2 * half))
        self._memory = MapMemory(
            bins, weight, ReferenceWindow(cells, half, guard, plan, np.float32), self._mean
        )
        self._averaged, self._moved = _first_turn(law)

    def ratios(self, video: npt.NDArray, azimuth: FloatArray, out: npt.NDArray[np.float32]) -> int:
        """Normalise some pulses and learn from them; see `Normaliser.ratios`.

        Args:
            video: shape (pulses, cells).
            azimuth: of each pulse, rad in [0, 2 pi), shape (pulses,).
            out: float32, shape (pulses, cells).

        Returns:
            How many samples were not finite.
        """
        bad = 0
        window, memory = self._window, self._memory
        place = memory.bin(azimuth)
        with np.errstate(over="ignore", divide="ignore", invalid="ignore"):
            for first in range(0, len(video), window.rows):
                block = video[first : first + window.rows]
                laid_out = window.source(len(block))
                power, level = window.inside(laid_out), out[first : first + len(block)]
                power[...] = block
                bad += square_in_place(laid_out)
                sums = window.statistic(len(block))[:, : level.shape[1]]
                np.multiply(sums, self._mean, out=level)
                turns = np.flatnonzero(np.diff(place[first : first + len(block)])) + 1
                for begin, end in pairwise([0, *turns.tolist(), len(block)]):
                    memory.turn_to(int(place[first + begin]))
                    self._divide(power[begin:end], level[begin:end])
                    memory.learn(power[begin:end])
        return bad

    def _divide(self, power: npt.NDArray[np.float32], level: npt.NDArray[np.float32]) -> None:
        """Turn the levels of the reference cells into ratios, for pulses of one bin."""
        known = self._memory.level
        if known is not None:
            np.maximum(level, known, out=level)
            np.divide(power, level, out=level)
            return
        np.divide(power, level, out=level)
        moved = np.interp(level, self._averaged, self._moved)
        beyond = level > self._averaged[-1]
        moved[beyond] = level[beyond] * (self._moved[-1] / self._averaged[-1])
        level[...] = moved


def _first_turn(law: MapLevel) -> tuple[FloatArray, FloatArray]:
    """Ratios to an average of N cells, and the ratios to the map's level that are exceeded as rarely.

    Beyond the last the power of an echo would be squeezed; it is kept in proportion instead.
    """
    chance = np.linspace(0.0, _LARGEST_POWER, _NODES)
    averaged = law.cells * np.expm1(chance / law.cells)
    # No level is ever so low that the map's ratio were the greater one.
    ratio = np.linspace(0.0, averaged[-1], 8 * _NODES)
    return averaged, np.interp(chance, -law.log_exceedance(ratio), ratio)
