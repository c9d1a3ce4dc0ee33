# SPDX-License-Identifier: Apache-2.0
"""Two halves of reference cells around every cell of a pulse, and a statistic of them over blocks of pulses."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from primary_proc.normalisers.shift_network import Operation, ShiftPlan

_BUFFER_BYTES = 144 * 1024
_ALL_BYTES = 896 * 1024


def fitting_half(cells: int, reference: int, guard: int) -> int:
    """Reference cells of a half, less than wanted where the range is too short for a whole window.

    Args:
        cells: range cells of a pulse.
        reference: cells wanted on each side.
        guard: cells on each side between the cell under test and its reference cells.

    Returns:
        Cells of each half, at least one.

    Raises:
        ValueError: not even one fits.
    """
    half = min(reference, (cells - 2 * guard - 1) // 2)
    if half < 1:
        raise ValueError(
            f"{cells} range cells leave no room for two reference cells beside a guard of {guard}"
        )
    return half


class ReferenceWindow:
    """Blocks of pulses with the cells that their windows need past both ends, and the statistic's buffers.

    The window of a cell is a half before it, a half behind it, and between them the cell and its guard cells. Near an
    end of the range the whole window is moved inside: what it lacks on one side it takes on its other side. Laid out,
    the pulse goes on past its ends with cells one window's length further inside, and no cell needs a treatment of its
    own. Every cell has the same number of reference cells in each half, and so the same law.

    Attributes:
        rows: pulses of a block.
        pad: cells laid out before the first cell and after the last.
        width: cells of a pulse as it is laid out.
    """

    def __init__(
        self, cells: int, half: int, guard: int, plan: ShiftPlan, kind: npt.DTypeLike
    ) -> None:
        """Lay out the buffers.

        Args:
            cells: range cells of a pulse.
            half: reference cells of a half, as `fitting_half` gives them.
            guard: cells between the cell under test and a half.
            plan: statistic of the window, at the place of the window's first cell.
            kind: type of the cells that it works on.
        """
        self._cells, self._plan = cells, plan
        self.pad, self._length = half + guard, 2 * (half + guard) + 1
        self.width = cells + 2 * self.pad
        row = self.width * np.dtype(kind).itemsize
        rows = max(1, min(_BUFFER_BYTES, _ALL_BYTES // plan.buffers) // row)
        # A power of two, as the pulses of a sector often are: then no block is cut.
        self.rows = 1 << (rows.bit_length() - 1)
        self._buffers = [np.zeros(self.rows * self.width, kind) for _ in range(plan.buffers)]
        self._bound: dict[int, list[Operation]] = {}

    def source(self, pulses: int) -> npt.NDArray:
        """Where a block goes; operations on all of it are faster than on the cells alone.

        Args:
            pulses: of the block, at most `rows`.

        Returns:
            View, shape (pulses, width), zero past the ends of the range.
        """
        block = self._block(0, pulses)
        block[:, : self.pad] = 0
        block[:, -self.pad :] = 0
        return block

    def inside(self, block: npt.NDArray) -> npt.NDArray:
        """Cells of a block laid out as `source` is.

        Args:
            block: shape (pulses, width).

        Returns:
            View, shape (pulses, cells).
        """
        return block[:, self.pad : self.pad + self._cells]

    def statistic(self, pulses: int) -> npt.NDArray:
        """Compute the statistic of the window of every cell in `source`.

        Args:
            pulses: of the block.

        Returns:
            View, shape (pulses, width), valid until the next block; cells begin in column 0, the last columns are void.
        """
        block, pad, length = self._block(0, pulses), self.pad, self._length
        block[:, :pad] = block[:, length : length + pad]
        block[:, -pad:] = block[:, -pad - length : -length]
        if pulses not in self._bound:
            self._bound[pulses] = self._plan.bind(self._buffers, pulses * self.width)
        for operation, one, other, target in self._bound[pulses]:
            operation(one, other, out=target)
        return self._block(self._plan.result, pulses)

    def divide(self, tested: npt.NDArray, level: npt.NDArray, out: npt.NDArray[np.float32]) -> None:
        """Divide cells by their levels.

        Args:
            tested: cells laid out as `source` is, shape (pulses, width).
            level: laid out as `statistic` is, float32, shape (pulses, width); overwritten.
            out: float32, shape (pulses, cells).
        """
        levels = level.reshape(-1)[: -self.pad]
        np.divide(tested.reshape(-1)[self.pad :], levels, out=levels)
        out[...] = level[:, : self._cells]

    def _block(self, buffer: int, pulses: int) -> npt.NDArray:
        return self._buffers[buffer][: pulses * self.width].reshape(pulses, self.width)


def behind(half: int, guard: int) -> int:
    """Distance from the first cell of the half before a cell to that of the half behind it.

    Args:
        half: reference cells of a half.
        guard: cells between the cell under test and a half.

    Returns:
        Cells.
    """
    return half + 2 * guard + 1
