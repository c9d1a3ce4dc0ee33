# SPDX-License-Identifier: Apache-2.0
"""Cell-averaging CFAR along range in the square-law domain."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from primary_proc.calculators.cfar.cfar_loss import averaging_loss_db
from primary_proc.normalisers.normaliser import FloatArray, Normaliser, square_in_place

Block = npt.NDArray[np.float32]

_BLOCK_BYTES = 144 * 1024
_LARGEST_RATIO = 1e9


class CellAveraging(Normaliser):
    """Power of a cell over the sum of the powers of N reference cells around it.

    In exponentially distributed noise power p_N = (1 + T / N)^-N with T on the mean, that is (1 + t)^-N with t on the
    sum (Finn and Johnson 1968; Gandhi and Kassam 1988, (7)). Towards the ends of the range the window is cut and N is
    what is left of it, so that the probability holds in every cell.

    The window sums come from doubling: sums of 2, 4, 8, … cells are sums of two shifted arrays. There is no running
    sum, so nothing drifts and the result does not depend on how pulses are grouped into messages.
    """

    def __init__(self, cells: int, reference: int, guard: int) -> None:
        """Bind to a number of cells.

        Args:
            cells: range cells of a pulse.
            reference: reference cells on each side.
            guard: cells on each side between the cell under test and its reference cells.

        Raises:
            ValueError: some cell would have no reference cell at all.
        """
        self._count = _window_population(cells, reference, guard)
        if self._count.min() < 1:
            raise ValueError(
                f"{cells} range cells leave some cell without a reference cell beside a guard of {guard}"
            )
        self._cells, self._reference, self._guard = cells, reference, guard
        self._pad = guard + reference
        width = cells + 2 * self._pad
        self._rows = _power_of_two(_BLOCK_BYTES // (4 * width))
        self._power = np.zeros((self._rows, width), np.float32)
        self._sums, self._additions = self._plan()
        self._tested = self._power.reshape(-1)[self._pad :][: len(self._sums)]
        whole = self._sums.base
        assert whole is not None
        self._divided = whole.reshape(self._power.shape)[:, :cells]
        self.noise_scale = self._count.astype(float)

    def ratios(self, video: npt.NDArray, azimuth: FloatArray, out: npt.NDArray[np.float32]) -> int:
        """Normalise some pulses; see `Normaliser.ratios`.

        Args:
            video: shape (pulses, cells).
            azimuth: not used.
            out: float32, shape (pulses, cells).

        Returns:
            How many samples were not finite.
        """
        inner = self._power[:, self._pad : self._pad + self._cells]
        bad = 0
        with np.errstate(all="ignore"):
            # A block of pulses stays in the processor's cache from the first pass to the last. Only the first and the
            # last pass go pulse by pulse, which costs numpy several times as much as going through all at once.
            for first in range(0, len(video), self._rows):
                block = video[first : first + self._rows]
                count = len(block)
                inner[:count] = block
                bad += square_in_place(self._power[:count])
                for one, other, total in self._additions:
                    np.add(one, other, out=total)
                np.divide(self._tested, self._sums, out=self._sums)
                out[first : first + count] = self._divided[:count]
        return bad

    def threshold(self, probability: float) -> FloatArray:
        """Threshold on the ratio to the sum; see `Normaliser.threshold`.

        Args:
            probability: p_N.

        Returns:
            Shape (cells,).
        """
        return np.expm1(-np.log(probability) / self._count)

    def exceedance(self, ratio: npt.ArrayLike, cell: npt.NDArray[np.integer]) -> FloatArray:
        """Inverse of `threshold`; see `Normaliser.exceedance`.

        Args:
            ratio: shape (n,).
            cell: shape (n,).

        Returns:
            Shape (n,).
        """
        return np.exp(-self._count[cell] * np.log1p(ratio))

    def noise_power(self, ratios: npt.NDArray[np.float32]) -> npt.NDArray[np.float32]:
        """N ln(1 + t); see `Normaliser.noise_power`.

        Args:
            ratios: shape (pulses, cells).

        Returns:
            Same shape.
        """
        power = np.log1p(np.nan_to_num(ratios, posinf=_LARGEST_RATIO))
        power *= self._count.astype(np.float32)
        return power

    def loss_db(self, probability: float) -> float:
        """Loss of the full window; see `Normaliser.loss_db`.

        Args:
            probability: p_N.

        Returns:
            dB.
        """
        return averaging_loss_db(probability, float(self._count.max()))

    def _plan(self) -> tuple[Block, list[tuple[Block, Block, Block]]]:
        """Lay out the additions that lead to the sums over both halves of the window.

        Pulses lie one behind another in flat buffers; the zeros between them keep their windows apart. Each array ends
        where its windows would leave the block.

        Returns:
            The sums, shape (n,), number r * width + c for cell c of pulse r, and the additions in their order.
        """
        buffers = [np.zeros(self._power.size, np.float32) for _ in range(3)]
        additions = []

        def add(one: Block, other: Block, shift: int, *kept: Block | None) -> Block:
            """Add an array, moved, to another, into a buffer that neither they nor the kept one use."""
            used = [array.base for array in (one, other, *kept) if array is not None]
            free = next(b for b in buffers if not any(b is base for base in used))
            size = min(len(one), len(other) - shift)
            additions.append((one[:size], other[shift : shift + size], free[:size]))
            return free[:size]

        doubled, half, width, covered = self._power.reshape(-1), None, 1, 0
        while width <= self._reference:
            if self._reference & width:
                half = doubled if half is None else add(half, doubled, covered)
                covered += width
            if 2 * width <= self._reference:
                doubled = add(doubled, doubled, width, half)
            width *= 2
        assert half is not None
        return add(half, half, self._reference + 2 * self._guard + 1), additions


def _window_population(cells: int, reference: int, guard: int) -> npt.NDArray[np.int64]:
    """How many reference cells lie inside the range, for each cell."""
    cell = np.arange(cells)
    behind = np.clip(cell - guard, 0, reference)
    ahead = np.clip(cells - 1 - cell - guard, 0, reference)
    return behind + ahead


def _power_of_two(number: int) -> int:
    """Largest one that is not above a number, one at least; sectors are often multiples of it."""
    return 1 << max(number.bit_length() - 1, 0)
