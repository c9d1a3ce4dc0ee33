# SPDX-License-Identifier: Apache-2.0
"""The user's words about targets and channels as the model that a filter of two channels works with."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from bearing_tracker.fusion import FILTERS, Belief, Motion
from bearing_tracker.fusion.azimuth_channels import azimuth_channel, azimuth_pair
from bearing_tracker.fusion.chain import chain_after, shares_and_memory
from bearing_tracker.fusion.surveillance import surveillance_motion

if TYPE_CHECKING:
    from bearing_tracker.fusion_parameters import FusionParameters

FloatArray = npt.NDArray[np.float64]

_SECOND = 1.0


class FusionModel:
    """State (azimuth, rate); an active channel clear or jammed, a passive one heard or silent.

    Jamming multiplies the error of the active channel. A silent channel reports directions that have nothing to do
    with the target.
    """

    def __init__(self, parameters: FusionParameters) -> None:
        """Build the filter.

        Args:
            parameters: of the fusion.
        """
        self._parameters = parameters
        self._chains = (
            shares_and_memory(parameters.clear_time, parameters.jammed_time),
            shares_and_memory(parameters.heard_time, parameters.silent_time),
        )
        (active, active_memory), (passive, passive_memory) = self._chains
        # Chains of a second stand here for the shape only: every motion brings those of its own length.
        self.filter = FILTERS[parameters.filter](
            azimuth_pair(
                azimuth_channel(
                    chain_after(active, active_memory, _SECOND),
                    (1.0, parameters.jammed_factor**2),
                    (1.0, 1.0),
                ),
                azimuth_channel(
                    chain_after(passive, passive_memory, _SECOND),
                    (1.0, parameters.silent_factor**2),
                    (1.0, 0.0),
                ),
            )
        )

    @property
    def usual_disturbance(self) -> tuple[float, float]:
        """Share of time that the active and the passive channel are disturbed by design."""
        return self._chains[0][0][1], self._chains[1][0][1]

    def active_clear(self, clear: FloatArray, seconds: FloatArray) -> FloatArray:
        """Probability that the active channel is clear a while later.

        Args:
            clear: probability now, shape (n,).
            seconds: shape (n,).

        Returns:
            Shape (n,).
        """
        shares, memory = self._chains[0]
        return shares[0] + (clear - shares[0]) * np.exp(-seconds / memory)

    def start(self, azimuth: FloatArray, std: FloatArray) -> Belief:
        """Begin with one bearing of each target.

        Args:
            azimuth: radians in [-pi, pi), shape (n,).
            std: radians, shape (n,).

        Returns:
            The belief at its time.
        """
        mean = np.stack([azimuth, np.zeros(len(azimuth))], axis=1)
        covariance = np.zeros((len(azimuth), 2, 2))
        covariance[:, 0, 0], covariance[:, 1, 1] = std**2, self._parameters.rate_std**2
        active, passive = (np.array(shares) for shares, _ in self._chains)
        return self.filter.start(mean, covariance, active, passive)

    def motion(self, seconds: FloatArray, distance: FloatArray) -> Motion:
        """Let time pass.

        Args:
            seconds: not negative, shape (n,).
            distance: metres, shape (n,); NaN where it is not known.

        Returns:
            Motion of the states and of both channels' chains.
        """
        parameters = self._parameters
        distance = np.where(np.isnan(distance), parameters.unknown_range, distance)
        motion = surveillance_motion(
            seconds,
            np.maximum(distance, parameters.minimum_range),
            parameters.acceleration,
            parameters.acceleration_time,
            parameters.speed,
        )
        active, passive = (chain_after(shares, memory, seconds) for shares, memory in self._chains)
        return Motion(motion.transition, motion.noise, None, active, passive)
