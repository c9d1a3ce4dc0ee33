# SPDX-License-Identifier: Apache-2.0
"""How surely the plots that confirmed tracks take are their own: by design, and by what their gates hold.

By design only the density of false plots and the size of the gate count (Kuzmin 1967, (4.149), with a finite gate and
a target that may be missed). What the gates hold tells after the fact: the plot taken against all others of its gate
and against none being right. Both means agree where density, errors and detection probability are as assumed.
"""

from __future__ import annotations

import numpy as np

from secondary_proc.association.interface import FloatArray, IndexArray
from secondary_proc.calculators.plot_selection import selection_outcome

_MEMORY = 2000.0
"""Plots after which an old one counts a third."""


class SelectionWatch:
    """Two running means over plots taken."""

    def __init__(self, sigmas: float, detection: float) -> None:
        """Start without plots.

        Args:
            sigmas: half axis of the gates in standard deviations.
            detection: probability of a target's plot in a scan.
        """
        self._sigmas = sigmas
        self._detection = detection
        self._sums = np.zeros(3)

    def observe(
        self,
        track: IndexArray,
        gain: FloatArray,
        density: FloatArray,
        determinant: FloatArray,
        taken: IndexArray,
    ) -> None:
        """Look at the gates of one slice of time.

        Args:
            track: of each pair of track and plot, shape (n,).
            gain: logarithm of the likelihood ratio of the pair over a miss, shape (n,).
            density: false plots per square metre, shape (n,).
            determinant: of the covariance of the predicted difference, m^4, shape (n,).
            taken: indices of the pairs that were chosen, of confirmed tracks, shape (k,).
        """
        if not len(taken):
            return
        ratio = np.exp(np.minimum(gain, 50.0))
        all_of_gate = np.bincount(track, ratio)[track[taken]]
        outcome = selection_outcome(
            density[taken], np.sqrt(determinant[taken]), self._sigmas, self._detection
        )
        self._sums *= np.exp(-len(taken) / _MEMORY)
        self._sums += (
            len(taken),
            (outcome.correct / (1.0 - outcome.none)).sum(),
            (ratio[taken] / (1.0 + all_of_gate)).sum(),
        )

    @property
    def shares(self) -> tuple[float, float] | None:
        """Share of the plots taken that are their track's own, (expected, observed); None before the first."""
        plots, expected, observed = self._sums
        return (float(expected / plots), float(observed / plots)) if plots else None
