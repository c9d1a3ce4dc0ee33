# SPDX-License-Identifier: Apache-2.0
"""Runs of neighbours, so that what holds for some pulses is done on slices instead of copies."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt


def runs(chosen: npt.NDArray[np.bool_]) -> list[tuple[int, int]]:
    """Find the runs of neighbours that are chosen.

    Args:
        chosen: shape (n,).

    Returns:
        First index, and the one after the last, of each run.
    """
    padded = np.zeros(len(chosen) + 2, dtype=bool)
    padded[1:-1] = chosen
    edges = np.flatnonzero(padded[1:] != padded[:-1])
    return [(int(begin), int(end)) for begin, end in edges.reshape(-1, 2)]
