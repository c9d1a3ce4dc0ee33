# SPDX-License-Identifier: Apache-2.0
"""The one-to-one assignment with the greatest sum of gains, over a sparse graph of possible pairs."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from scipy.sparse import csr_array
from scipy.sparse.csgraph import min_weight_full_bipartite_matching

FloatArray = npt.NDArray[np.float64]
IndexArray = npt.NDArray[np.intp]


def assign(left: IndexArray, right: IndexArray, gain: FloatArray) -> IndexArray:
    """Choose pairs so that the sum of their gains is greatest.

    Pairs without a rival are taken as they are. The rest goes to one sparse assignment, in which connected components
    of the graph do not meet; a private dummy partner for each on the left lets it stay alone. Source: Jonker and
    Volgenant 1987, as scipy implements it for sparse graphs.

    Args:
        left: number of the one side of each possible pair, say of a track, shape (k,).
        right: number of the other side, say of a plot, shape (k,); no pair stands twice.
        gain: what it is worth to take the pair, positive, shape (k,).

    Returns:
        Indices of the chosen pairs, ascending; nothing on either side stands in two of them.
    """
    if not len(left):
        return np.zeros(0, np.intp)
    on_left, on_right = np.bincount(left), np.bincount(right)
    if on_left.max() == on_right.max() == 1:
        return np.arange(len(left))
    alone = (on_left[left] == 1) & (on_right[right] == 1)
    contested = np.flatnonzero(~alone)
    chosen = contested[_solve(left[contested], right[contested], gain[contested])]
    return np.sort(np.concatenate([np.flatnonzero(alone), chosen]))


def _solve(left: IndexArray, right: IndexArray, gain: FloatArray) -> IndexArray:
    lefts, row = np.unique(left, return_inverse=True)
    rights, column = np.unique(right, return_inverse=True)
    count = len(lefts)
    # The solver takes stored weights only, and none of them may be zero; to stay alone costs more than any pair.
    highest = float(gain.max()) + 1.0
    weights = csr_array(
        (
            np.concatenate([highest - gain, np.full(count, highest)]),
            # The solver of SciPy 1.11 takes 32-bit indices only.
            (
                np.concatenate([row, np.arange(count)]).astype(np.int32),
                np.concatenate([column, len(rights) + np.arange(count)]).astype(np.int32),
            ),
        ),
        shape=(count, len(rights) + count),
    )
    rows, columns = min_weight_full_bipartite_matching(weights)
    real = columns < len(rights)
    key = row * len(rights) + column
    order = np.argsort(key)
    wanted = rows[real] * len(rights) + columns[real]
    return order[np.searchsorted(key[order], wanted)]
