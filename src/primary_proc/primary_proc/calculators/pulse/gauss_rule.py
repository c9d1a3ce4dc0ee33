# SPDX-License-Identifier: Apache-2.0
"""Gauss and Legendre's rule of integration over an interval, its nodes computed once."""

from __future__ import annotations

from functools import cache

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]


def gauss_rule(low: float, high: float, nodes: int) -> tuple[FloatArray, FloatArray]:
    """Nodes and weights.

    Args:
        low: lower end of the interval.
        high: upper end.
        nodes: number of them; the rule is exact for polynomials of twice that degree.

    Returns:
        Nodes and weights, each of shape (nodes,).
    """
    node, weight = _standard(nodes)
    half = (high - low) / 2.0
    return low + half * (node + 1.0), half * weight


@cache
def _standard(nodes: int) -> tuple[FloatArray, FloatArray]:
    node, weight = np.polynomial.legendre.leggauss(nodes)
    return node, weight
