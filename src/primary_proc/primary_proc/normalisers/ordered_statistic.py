# SPDX-License-Identifier: Apache-2.0
"""Ordered-statistic CFAR along range in the square-law domain."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from primary_proc.calculators.cfar.cfar_laws import OrderedLevel
from primary_proc.normalisers.normaliser import FloatArray
from primary_proc.normalisers.reference_window import ReferenceWindow, behind, fitting_half
from primary_proc.normalisers.shift_network import ShiftNetwork
from primary_proc.normalisers.sliding_windows import ordered_of_two, sorted_window
from primary_proc.normalisers.window_normaliser import WindowNormaliser

_DROPPED = 13
_HALF_STEP = np.int32(1 << (_DROPPED - 1))
_EXPONENT = -32
_LIMIT = np.float32(2.0**-63)


class OrderedStatistic(WindowNormaliser):
    """Power of a cell over the k-th smallest power of its N reference cells (H. Rohling, IEEE Trans. AES 19, 1983).

    Both halves of a window are sorted for all cells at once, by merging windows of 1, 2, 4, … cells with themselves
    moved along; the k-th of two sorted halves takes no further merging.

    What is sorted are 16-bit keys, which numpy compares twice as fast as 32 bits: powers rounded to 11 binary digits,
    by 1/2048 (0.002 dB) at most, over the 180 dB below the strongest cell of the pulse. This moves p_N by
    (T Z / 5000)^2 of itself, 1e-6 at p_N = 0.01 and 2e-5 at 1e-8. A key is cut out of the 32 bits of the power itself:
    positive floating-point numbers are in the order of their bits, and below 2^-63 the first three of these are zero.
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
        shape = self._window.rows, self._window.width
        self._power, self._key = np.zeros(shape, np.float32), np.zeros(shape, np.int32)

    def ratios(self, video: npt.NDArray, azimuth: FloatArray, out: npt.NDArray[np.float32]) -> int:
        """Normalise some pulses; see `Normaliser.ratios`.

        Args:
            video: shape (pulses, cells).
            azimuth: not used.
            out: float32, shape (pulses, cells).

        Returns:
            How many samples were not finite.
        """
        bad, window = 0, self._window
        with np.errstate(all="ignore"):
            for first in range(0, len(video), window.rows):
                block = video[first : first + window.rows]
                count = len(block)
                power, key = self._power[:count], self._key[:count]
                bad += self._scaled_power(block, power)
                np.add(power.view(np.int32), _HALF_STEP, out=key)
                key >>= _DROPPED
                np.copyto(window.source(count), key, casting="unsafe")
                np.copyto(key, window.statistic(count))
                key <<= _DROPPED
                window.divide(power, key.view(np.float32), out[first : first + count])
        return bad

    def _scaled_power(self, block: npt.NDArray, power: npt.NDArray[np.float32]) -> int:
        """Power of some pulses, each in a unit that is a power of two and makes its strongest cell just fit a key.

        Args:
            block: video, shape (pulses, cells).
            power: where it goes, laid out as the window's source.

        Returns:
            How many samples were not finite; they count as zero.
        """
        if self._scale(block, power) < _LIMIT:
            return 0
        # A sample that is not finite, or negative, misled the choice of the unit.
        sound = np.abs(block, dtype=np.float32)
        bad = ~np.isfinite(np.square(sound))
        sound[bad] = 0.0
        self._scale(sound, power)
        return int(np.count_nonzero(bad))

    def _scale(self, block: npt.NDArray, power: npt.NDArray[np.float32]) -> np.float32:
        """Power in units of its pulse, and the greatest of all, NaN if there is one."""
        strongest = np.maximum.reduce(block, axis=1, keepdims=True).astype(np.float32)
        unit = np.ldexp(np.float32(1.0), _EXPONENT - np.frexp(strongest)[1])
        np.multiply(block, unit, out=self._window.inside(power), casting="same_kind")
        np.multiply(power, power, out=power)
        return np.maximum.reduce(power, axis=None)
