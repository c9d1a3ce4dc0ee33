# SPDX-License-Identifier: Apache-2.0
"""Ordered-statistic CFAR along range in the square-law domain."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from primary_proc.calculators.cfar_laws import OrderedLevel
from primary_proc.normalisers.normaliser import FloatArray, square_finite
from primary_proc.normalisers.reference_window import ReferenceWindow, behind, fitting_half
from primary_proc.normalisers.shift_network import ShiftNetwork
from primary_proc.normalisers.sliding_windows import ordered_of_two, sorted_window
from primary_proc.normalisers.window_normaliser import WindowNormaliser

_SHIFT = 13
_HALF_STEP = np.int32(1 << (_SHIFT - 1))
_LARGEST_KEY = np.int32(0xFFFF)


class OrderedStatistic(WindowNormaliser):
    """Power of a cell over the k-th smallest power of its N reference cells (H. Rohling, IEEE Trans. AES 19, 1983).

    Both halves of a window are sorted for all cells at once, by merging windows of 1, 2, 4, … cells with themselves
    moved along; the k-th of two sorted halves takes no further merging.

    What is sorted are 16-bit keys, which numpy compares twice as fast as 32 bits: the powers rounded to 11 binary
    digits, by 1/2048 (0.002 dB) at most, over the 190 dB below the strongest cell of the pulse. This moves p_N by
    (T Z / 5000)^2 of itself, 1e-6 at p_N = 0.01 and 2e-5 at 1e-8.
    """

    def __init__(self, cells: int, reference: int, guard: int, order: float) -> None:
        """Bind to a number of cells.

        Args:
            cells: range cells of a pulse.
            reference: reference cells on each side; fewer where the range is too short for them.
            guard: cells on each side between the cell under test and its reference cells.
            order: k as a share of the reference cells of both sides.

        Raises:
            ValueError: there is no room for reference cells.
        """
        half = fitting_half(cells, reference, guard)
        rank = min(max(1, round(order * 2 * half)), 2 * half)
        super().__init__(cells, OrderedLevel(2 * half, rank), 1)
        network = ShiftNetwork()
        before = sorted_window(network, half)
        after = [signal.ahead(behind(half, guard)) for signal in before]
        plan = network.plan(ordered_of_two(network, before, after, rank))
        self._window = ReferenceWindow(cells, half, guard, plan, np.uint16)
        self._key = np.zeros((self._window.rows, cells), np.int32)
        self._zero = np.zeros(cells, np.int32)

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
        with np.errstate(over="ignore", divide="ignore", invalid="ignore"):
            for first in range(0, len(video), self._window.rows):
                block = video[first : first + self._window.rows]
                power, key = out[first : first + len(block)], self._key[: len(block)]
                bad += square_finite(block, power)
                base = _base(power)
                np.subtract(power.view(np.int32), base - _HALF_STEP, out=key)
                np.maximum(key, self._zero, out=key)
                key >>= _SHIFT
                np.copyto(self._window.room(len(block)), key, casting="unsafe")
                np.copyto(key, self._window.statistic(len(block)))
                key <<= _SHIFT
                key += base
                np.divide(power, key.view(np.float32), out=power)
        return bad


def _base(power: npt.NDArray[np.float32]) -> npt.NDArray[np.int32]:
    """What to take from the bits of each pulse so that those of its strongest cell, rounded, fit a key.

    Positive floating-point numbers are in the order of their bits taken as integers.
    """
    strongest = power.max(axis=1, keepdims=True).view(np.int32) + _HALF_STEP
    return np.maximum((strongest >> _SHIFT) - _LARGEST_KEY, 0) << _SHIFT
