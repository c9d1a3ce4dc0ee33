# SPDX-License-Identifier: Apache-2.0
"""Which points of two sets lie close together, without looking at every pair."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]
IndexArray = npt.NDArray[np.intp]

_DENSE = 4096


def neighbour_pairs(
    first: FloatArray, second: FloatArray, radius: float, limit: int
) -> tuple[IndexArray, IndexArray, int]:
    """Find pairs that differ by at most `radius` in x and in y.

    Points of the second set are sorted into square cells of that side; a point of the first set then meets its own
    cell and the eight around it, which are three runs of the sorted list.

    Args:
        first: positions, metres, shape (n, 2).
        second: positions, metres, shape (m, 2).
        radius: largest difference, metres.
        limit: number of pairs to examine at most, which bounds time and memory.

    Returns:
        (i, j, skipped): indices into both sets, in order of i, and the number of points of the first set that were
        left out because of the limit.
    """
    if len(first) * len(second) <= _DENSE:
        i, j = np.nonzero(np.abs(first[:, None, :] - second[None, :, :]).max(axis=2) <= radius)
        return i, j, 0
    origin = np.minimum(first.min(axis=0), second.min(axis=0)) - radius
    # Cells never so small that their number overflows the key.
    side = max(radius, float(np.ptp(np.concatenate([first, second]), axis=0).max()) * 1e-6)
    cell_first = ((first - origin) / side).astype(np.int64)
    cell_second = ((second - origin) / side).astype(np.int64)
    width = int(max(cell_first[:, 0].max(), cell_second[:, 0].max())) + 3
    key = cell_second[:, 1] * width + cell_second[:, 0]
    order = np.argsort(key, kind="stable")
    key = key[order]
    rows = (cell_first[:, 1, None] + np.array([-1, 0, 1])) * width + cell_first[:, 0, None]
    begin = np.searchsorted(key, rows - 1, side="left")
    length = np.searchsorted(key, rows + 1, side="right") - begin
    total = np.cumsum(length.sum(axis=1))
    kept = int(np.searchsorted(total, limit, side="right"))
    i, j = _expand(begin[:kept], length[:kept])
    j = order[j]
    near = np.abs(first[i] - second[j]).max(axis=1) <= radius
    return i[near], j[near], len(first) - kept


def _expand(begin: IndexArray, length: IndexArray) -> tuple[IndexArray, IndexArray]:
    flat = length.ravel()
    i = np.repeat(np.arange(len(begin)), length.sum(axis=1))
    ends = np.cumsum(flat)
    j = np.arange(ends[-1] if len(ends) else 0) + np.repeat(begin.ravel() - (ends - flat), flat)
    return i, j
