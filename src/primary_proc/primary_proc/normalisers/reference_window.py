# SPDX-License-Identifier: Apache-2.0
"""Two halves of reference cells around every cell of a pulse, and a statistic of them over blocks of pulses."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from primary_proc.normalisers.shift_network import Operation, ShiftPlan

_BUFFER_BYTES = 72 * 1024
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
        self._pad, self._length = half + guard, 2 * (half + guard) + 1
        self._width = cells + 2 * self._pad
        row = self._width * np.dtype(kind).itemsize
        self.rows = max(1, min(_BUFFER_BYTES, _ALL_BYTES // plan.buffers) // row)
        self._buffers = [np.zeros(self.rows * self._width, kind) for _ in range(plan.buffers)]
        self._bound: dict[int, list[Operation]] = {}

    def room(self, pulses: int) -> npt.NDArray:
        """Where the cells of a block go.

        Args:
            pulses: of the block, at most `rows`.

        Returns:
            View, shape (pulses, cells).
        """
        return self._block(0, pulses)[:, self._pad : self._pad + self._cells]

    def statistic(self, pulses: int) -> npt.NDArray:
        """Compute the statistic of the window of every cell in `room`.

        Args:
            pulses: of the block.

        Returns:
            View, shape (pulses, cells); valid until the next block.
        """
        block, pad, length = self._block(0, pulses), self._pad, self._length
        block[:, :pad] = block[:, length : length + pad]
        block[:, -pad:] = block[:, -pad - length : -length]
        if pulses not in self._bound:
            self._bound[pulses] = self._plan.bind(self._buffers, pulses * self._width)
        for operation, one, other, target in self._bound[pulses]:
            operation(one, other, out=target)
        result = self._plan.result
        return self._block(result.node, pulses)[:, result.shift : result.shift + self._cells]

    def _block(self, buffer: int, pulses: int) -> npt.NDArray:
        return self._buffers[buffer][: pulses * self._width].reshape(pulses, self._width)


def behind(half: int, guard: int) -> int:
    """Distance from the first cell of the half before a cell to that of the half behind it.

    Args:
        half: reference cells of a half.
        guard: cells between the cell under test and a half.

    Returns:
        Cells.
    """
    return half + 2 * guard + 1
