# SPDX-License-Identifier: Apache-2.0
"""CFAR on the sums of the reference cells before and behind a cell: the greater, or the smaller of the two."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from primary_proc.calculators.cfar.cfar_half_laws import GreatestLevel, SmallestLevel
from primary_proc.normalisers.normaliser import FloatArray, square_in_place
from primary_proc.normalisers.reference_window import ReferenceWindow, behind, fitting_half
from primary_proc.normalisers.shift_network import ShiftNetwork
from primary_proc.normalisers.sliding_windows import window_sum
from primary_proc.normalisers.window_normaliser import WindowNormaliser


class HalfSums(WindowNormaliser):
    """Power of a cell over a choice between the sums of the two halves of its window."""

    def __init__(
        self,
        cells: int,
        half: int,
        guard: int,
        law: GreatestLevel | SmallestLevel,
        choice: np.ufunc,
    ) -> None:
        """Bind to a number of cells and a choice.

        Args:
            cells: range cells of a pulse.
            half: reference cells of a half.
            guard: cells between the cell under test and a half.
            law: of the chosen mean.
            choice: `numpy.maximum` or `numpy.minimum`.
        """
        super().__init__(cells, law, half)
        network = ShiftNetwork()
        total = window_sum(network, half)
        chosen = network.combine(choice, total, total.ahead(behind(half, guard)))
        self._window = ReferenceWindow(cells, half, guard, network.plan(chosen), np.float32)

    def ratios(self, video: npt.NDArray, azimuth: FloatArray, out: npt.NDArray[np.float32]) -> int:
        """Normalise some pulses; see `Normaliser.ratios`.

        Args:
            video: shape (pulses, cells).
            azimuth: not used.
            out: float32, shape (pulses, cells).

        Returns:
            How many samples were not finite.
        """
        bad = 0
        window = self._window
        with np.errstate(all="ignore"):
            for first in range(0, len(video), window.rows):
                block = video[first : first + window.rows]
                power = window.source(len(block))
                window.inside(power)[...] = block
                bad += square_in_place(power)
                level = window.statistic(len(block))
                window.divide(power, level, out[first : first + len(block)])
        return bad


class GreatestOf(HalfSums):
    """Over the greater sum: few false alarms where the noise level changes, at the price of masking near edges."""

    def __init__(self, cells: int, reference: int, guard: int) -> None:
        """Bind to a number of cells.

        Args:
            cells: range cells of a pulse.
            reference: reference cells on each side; fewer where the range is too short for them.
            guard: cells on each side between the cell under test and its reference cells.

        Raises:
            ValueError: there is no room for reference cells.
        """
        half = fitting_half(cells, reference, guard)
        super().__init__(cells, half, guard, GreatestLevel(half), np.maximum)


class SmallestOf(HalfSums):
    """Over the smaller sum: a strong echo in one half does not hide the cell, but clutter edges break through."""

    def __init__(self, cells: int, reference: int, guard: int) -> None:
        """Bind to a number of cells.

        Args:
            cells: range cells of a pulse.
            reference: reference cells on each side; fewer where the range is too short for them.
            guard: cells on each side between the cell under test and its reference cells.

        Raises:
            ValueError: there is no room for reference cells.
        """
        half = fitting_half(cells, reference, guard)
        super().__init__(cells, half, guard, SmallestLevel(half), np.minimum)
