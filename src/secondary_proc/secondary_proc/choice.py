# SPDX-License-Identifier: Apache-2.0
"""What speaks for each pair of track and plot in one slice of time, and which pairs are chosen."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from secondary_proc import score
from secondary_proc.association import ASSOCIATIONS, GateGraph
from secondary_proc.gates import Gated
from secondary_proc.parameters import TrackerParameters

FloatArray = npt.NDArray[np.float64]
IndexArray = npt.NDArray[np.intp]


@dataclass(slots=True)
class Pairs:
    """Pairs of track and plot, one row each.

    Attributes:
        gated: which plots lie in which gates.
        density: false plots per square metre at the plot, shape (n,).
        gain: of the score if the plot is the track's, shape (n,).
        weight: gain over a miss, shape (n,).
        confirmed: whether the track is, shape (n,).
    """

    gated: Gated
    density: FloatArray
    gain: FloatArray
    weight: FloatArray
    confirmed: npt.NDArray[np.bool_]

    @classmethod
    def judged(
        cls,
        gated: Gated,
        density: FloatArray,
        detection: FloatArray | float,
        confirmed: npt.NDArray[np.bool_],
    ) -> Pairs:
        """Weigh pairs.

        Args:
            gated: which plots lie in which gates.
            density: false plots per square metre at the plot, shape (n,).
            detection: probability of a plot per scan, one for all or shape (n,).
            confirmed: whether the track is, shape (n,).

        Returns:
            The pairs with their gains.
        """
        gain = score.hit(detection, gated.distance_squared, gated.determinant, density)
        return cls(gated, density, gain, gain - score.miss(detection), confirmed)

    def choose(self, parameters: TrackerParameters) -> IndexArray:
        """Give plots to tracks.

        Args:
            parameters: which rule, and how near a plot must be.

        Returns:
            Indices of the pairs chosen, no track and no plot twice, ascending.
        """
        gated = self.gated
        strangers = score.false_plots_nearer(
            gated.distance_squared, gated.determinant, self.density
        )
        # In a gate so wide that a false plot is likelier than the target's, a miss is the better guess.
        # After misses a gate is kilometres wide; there a plot must be nearer than chance would bring a false one.
        likely = (self.weight > 0.0) & (strangers < parameters.false_plots_nearer)
        rows = likely.nonzero()[0]
        graph = GateGraph(
            gated.track[rows],
            gated.plot[rows],
            self.weight[rows],
            gated.distance_squared[rows],
            self.confirmed[rows],
        )
        return rows[ASSOCIATIONS[parameters.association](graph)]

    def ready(self, edges: IndexArray, ripe: int, tracks: int) -> IndexArray:
        """Leave out tracks that only plots still to come can interest: they wait for their competitors.

        Args:
            edges: indices of the pairs chosen.
            ripe: number of plots that nothing can contest any more; they come first.
            tracks: number of all tracks.

        Returns:
            The indices that stay.
        """
        if not np.count_nonzero(self.gated.plot[edges] >= ripe):
            return edges
        urgent = np.zeros(tracks, bool)
        urgent[self.gated.track[self.gated.plot < ripe]] = True
        return edges[urgent[self.gated.track[edges]]]
