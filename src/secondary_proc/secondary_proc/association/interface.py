# SPDX-License-Identifier: Apache-2.0
"""What the tracker asks of a rule that gives plots to tracks."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]
IndexArray = npt.NDArray[np.intp]


@dataclass(frozen=True, slots=True)
class GateGraph:
    """Which plots lie in which gates: one row an edge.

    Attributes:
        track: number of the track, shape (n,).
        plot: number of the plot, shape (n,).
        gain: by how much the edge raises the logarithm of the likelihood over leaving both alone, positive, shape (n,).
        distance_squared: of the plot from the prediction, normalised by the covariance of their difference, shape (n,).
        first: whether the track is served before those that are not, shape (n,).
    """

    track: IndexArray
    plot: IndexArray
    gain: FloatArray
    distance_squared: FloatArray
    first: npt.NDArray[np.bool_]


class Association(Protocol):
    """Chooses among the edges of a gate graph."""

    def __call__(self, graph: GateGraph) -> IndexArray:
        """Choose edges so that no track and no plot is used twice.

        Args:
            graph: edges with positive gains.

        Returns:
            Indices of the chosen edges, ascending.
        """
        ...
