# SPDX-License-Identifier: Apache-2.0
"""The user's words about targets and channels as the model that a filter of two channels works with."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from bearing_tracker.fusion import FILTERS, Belief, Motion
from bearing_tracker.fusion.azimuth_channels import azimuth_channel, azimuth_pair
from bearing_tracker.fusion.chain import chain_after, shares_and_memory
from bearing_tracker.fusion.guidance import (
    decay_of_approach,
    guidance_covariance,
    guidance_motion,
)
from bearing_tracker.fusion.surveillance import surveillance_motion

if TYPE_CHECKING:
    from bearing_tracker.fusion_parameters import FusionParameters

FloatArray = npt.NDArray[np.float64]
Rows = npt.NDArray[np.void]

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
        covariance[:, 0, 0], covariance[:, 1, 1] = std**2, self._rate_variance()
        active, passive = (np.array(shares) for shares, _ in self._chains)
        return self.filter.start(mean, covariance, active, passive)

    def motion(self, seconds: FloatArray, targets: Rows) -> Motion:
        """Let time pass.

        Args:
            seconds: not negative, shape (n,).
            targets: their time, range, closing speed and axis, dtype TARGET, shape (n,).

        Returns:
            Motion of the states and of both channels' chains.
        """
        guided = self._parameters.model == "guidance"
        motion = self._guided(seconds, targets) if guided else self._surveyed(seconds, targets)
        active, passive = (chain_after(shares, memory, seconds) for shares, memory in self._chains)
        return Motion(motion.transition, motion.noise, motion.axis, active, passive)

    def _surveyed(self, seconds: FloatArray, targets: Rows) -> Motion:
        parameters, distance = self._parameters, targets["range"]
        distance = np.where(np.isnan(distance), parameters.unknown_range, distance)
        return surveillance_motion(
            seconds,
            np.maximum(distance, parameters.minimum_range),
            parameters.acceleration,
            parameters.acceleration_time,
            parameters.speed,
        )

    def _guided(self, seconds: FloatArray, targets: Rows) -> Motion:
        parameters, closing = self._parameters, targets["closing_speed"]
        # The range goes on falling while the radar does not see the target.
        since = targets["time"] - targets["ranged"]
        distance = np.maximum(targets["range"] - closing * since, parameters.minimum_range)
        decay = decay_of_approach(distance, closing, parameters.unknown_decay)
        return guidance_motion(
            seconds, parameters.swing_frequency, decay, parameters.swing_std, targets["axis"]
        )

    def _rate_variance(self) -> float:
        parameters = self._parameters
        if parameters.model == "surveillance":
            return parameters.rate_std**2
        swing = parameters.swing_frequency, parameters.unknown_decay, parameters.swing_std
        return float(guidance_covariance(*swing)[1, 1])
