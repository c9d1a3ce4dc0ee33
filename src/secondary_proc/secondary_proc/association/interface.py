# SPDX-License-Identifier: Apache-2.0
"""What the tracker asks of a rule that gives plots to tracks."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
import numpy.typing as npt


@dataclass(frozen=True, slots=True)
class GateGraph:
    """Which plots lie in which gates: one row an edge.

    Attributes:
        track: number of the track, shape (n,).
        plot: number of the plot, shape (n,).
        gain: by how much the edge raises the likelihood over leaving both alone, positive, shape (n,).
    """

    track: npt.NDArray[np.intp]
    plot: npt.NDArray[np.intp]
    gain: npt.NDArray[np.float64]


class Association(Protocol):
    """Chooses among the edges of a gate graph."""

    def __call__(self, graph: GateGraph) -> npt.NDArray[np.intp]:
        """Choose edges so that no track and no plot is used twice.

        Args:
            graph: edges with positive gains.

        Returns:
            Indices of the chosen edges, ascending.
        """
        ...
