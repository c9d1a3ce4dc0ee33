# SPDX-License-Identifier: Apache-2.0
"""Joint probabilistic data association: confirmed tracks move by all plots of their gates, each with its probability.

Who got a plot, for the life of tracks and for what is published, has been decided one to one before. Tentative tracks
take no part, as confirmed ones come first; components too large for the sum keep their one plot.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from secondary_proc.association.interface import FloatArray, IndexArray
from secondary_proc.association.joint_events import joint_probabilities
from secondary_proc.association.mixture import Mixture, mix, scatter_of_state
from secondary_proc.motion import predict_position_covariance

if TYPE_CHECKING:
    from secondary_proc.gates import Gated
    from secondary_proc.plots import Plots
    from secondary_proc.track_store import Columns

WEIGHING_SMOOTHERS = ("kalman", "imm", "polynomial")
"""Those that heed a plot's covariance, by which alone they learn how sure a plot is."""


class Contest:
    """The plots of one slice of time that compete for confirmed tracks, and how they move them."""

    def __init__(
        self,
        gated: Gated,
        gain: FloatArray,
        confirmed: npt.NDArray[np.bool_],
        chosen: IndexArray,
        plots: Plots,
    ) -> None:
        """Sum over joint events.

        Args:
            gated: pairs of track and plot, n of them.
            gain: logarithm of the ratio of likelihoods of each pair over leaving both alone, shape (n,).
            confirmed: whether its track is confirmed, shape (n,).
            chosen: indices of the pairs that were chosen one to one, shape (k,).
            plots: of the slice.
        """
        own = confirmed.nonzero()[0]
        probability = joint_probabilities(gated.track[own], gated.plot[own], gain[own])
        place = np.full(int(gated.track.max(initial=-1)) + 1, -1)
        place[gated.track[chosen]] = np.arange(len(chosen))
        row = place[gated.track[own]]
        summed = (row >= 0) & np.isfinite(probability)
        self._rows, self._short = np.unique(row[summed], return_inverse=True)
        self._probability = probability[summed]
        self._plots = plots[gated.plot[own[summed]]]
        self._mixture: Mixture | None = None

    def soften(self, tracks: Columns, taken: Plots, quiet_density: float) -> Plots:
        """Let each plot stand for all of its track's gate.

        Args:
            tracks: those that were given a plot, before it moves them, k of them.
            taken: their plots, k of them.
            quiet_density: power spectral density of the acceleration between manoeuvres, m^2/s^3.

        Returns:
            The same plots, their positions and covariances those of the mixtures.
        """
        rows, time = self._rows, taken.time
        seconds = time[rows] - tracks.time[rows]
        velocity = tracks.state[rows, 2:]
        # All at the moment of the plot that was chosen: others lie a little earlier or later on the target's way.
        late = time[rows[self._short]] - self._plots.time
        self._mixture = mix(
            self._short,
            self._probability,
            self._plots.position + late[:, None] * velocity[self._short],
            self._plots.covariance,
            tracks.state[rows, :2] + seconds[:, None] * velocity,
            predict_position_covariance(tracks.covariance[rows], seconds, quiet_density),
        )
        position, covariance = taken.position.copy(), taken.covariance.copy()
        position[rows], covariance[rows] = self._mixture.position, self._mixture.covariance
        return taken.moved(position, covariance)

    def widen(self, tracks: Columns) -> None:
        """Account for plots that disagree.

        Args:
            tracks: the same after the smoother took the plots of `soften`; changed.
        """
        if self._mixture is None or not len(self._rows):
            return
        more = scatter_of_state(tracks.covariance[self._rows], self._mixture)
        tracks.covariance[self._rows] += more
        if "covariance" in (tracks.memory.dtype.names or ()):
            # A smoother of several models has a covariance for each, of states that begin with these four numbers.
            tracks.memory["covariance"][self._rows, :, :4, :4] += more[:, None]
