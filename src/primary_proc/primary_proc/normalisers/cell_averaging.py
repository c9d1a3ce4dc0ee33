# SPDX-License-Identifier: Apache-2.0
"""Cell-averaging CFAR along range in the square-law domain."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from primary_proc.calculators.cfar_loss import averaging_loss_db
from primary_proc.normalisers.normaliser import FloatArray, Normaliser, square_finite

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
        self._rows = max(1, _BLOCK_BYTES // (4 * width))
        self._power = np.zeros((self._rows, width), np.float32)
        self._sums, self._additions = self._plan()
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
        with np.errstate(over="ignore", divide="ignore", invalid="ignore"):
            # A block of pulses stays in the processor's cache from the first pass to the last.
            for first in range(0, len(video), self._rows):
                block = video[first : first + self._rows]
                count = len(block)
                bad += square_finite(block, inner[:count])
                for one, other, total in self._additions:
                    np.add(one, other, out=total)
                sums = self._sums[:count, : self._cells]
                np.divide(inner[:count], sums, out=out[first : first + count])
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

        Pulses lie one behind another in flat buffers; the zeros between them keep their windows apart.

        Returns:
            The sums, shape (pulses of a block, width), column c for cell c, and the additions in their order.
        """
        power = self._power.reshape(-1)
        buffers = [np.zeros_like(power) for _ in range(3)]
        additions = []

        def add(one: Block, other: Block, shift: int, *kept: Block | None) -> Block:
            """Add an array, moved, to another, into a buffer that neither they nor the kept one use."""
            total = next(b for b in buffers if not any(b is used for used in (one, other, *kept)))
            size = len(total) - shift
            additions.append((one[:size], other[shift:], total[:size]))
            return total

        doubled, half, width, covered = power, None, 1, 0
        while width <= self._reference:
            if self._reference & width:
                half = doubled if half is None else add(half, doubled, covered)
                covered += width
            if 2 * width <= self._reference:
                doubled = add(doubled, doubled, width, half)
            width *= 2
        assert half is not None
        sums = add(half, half, self._reference + 2 * self._guard + 1)
        return sums.reshape(self._power.shape), additions


def _window_population(cells: int, reference: int, guard: int) -> npt.NDArray[np.int64]:
    """How many reference cells lie inside the range, for each cell."""
    cell = np.arange(cells)
    behind = np.clip(cell - guard, 0, reference)
    ahead = np.clip(cells - 1 - cell - guard, 0, reference)
    return behind + ahead
