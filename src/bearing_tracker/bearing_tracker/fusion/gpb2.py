# SPDX-License-Identifier: Apache-2.0
"""The pseudo-Bayesian estimator of the second order: every pair of previous and present hypothesis is followed.

Source: C.-B. Chang, M. Athans, State estimation for discrete systems with switching parameters, IEEE Trans. Aerospace
and Electronic Systems 14, 1978.
"""

from __future__ import annotations

import numpy as np

from bearing_tracker.fusion.belief import Belief
from bearing_tracker.fusion.dcmp import DcmpFilter
from bearing_tracker.fusion.hypotheses import Hypotheses, log_chain, log_sum, moments
from bearing_tracker.fusion.interface import ChannelPair, Motion, Reading
from bearing_tracker.fusion.passage import move
from bearing_tracker.fusion.tangent import off_tangent, on_tangent
from bearing_tracker.fusion.update import blocks, take_in


class Gpb2Filter(DcmpFilter):
    """M * M Kalman filters a step, merged by their present hypothesis after the readings instead of before.

    Attributes:
        channels: that it was made for.
    """

    def __init__(self, channels: ChannelPair) -> None:
        """Make the filter.

        Args:
            channels: through which targets are seen.
        """
        super().__init__(channels)
        size = channels.hypotheses
        self._previous = np.repeat(np.arange(size), size)
        self._branches = blocks(channels, np.tile(np.arange(size), size))

    def step(
        self,
        belief: Belief,
        motion: Motion,
        active: Reading | None = None,
        passive: Reading | None = None,
    ) -> Belief:
        """Move on and take readings in; see ChannelFilter.step.

        Args:
            belief: at the previous time.
            motion: from then to now.
            active: what the active channel reported.
            passive: what the passive channel reported.

        Returns:
            The belief now.

        Raises:
            ValueError: a reading is not finite or its covariance not positive definite.
        """
        before = on_tangent(self.channels, belief, motion.axis)
        components, size, targets = before.mean.shape
        paths = before.log_probability[:, None] + log_chain(self.channels, motion)
        state = move(
            Hypotheses(
                before.reference,
                before.mean[:, self._previous],
                before.covariance[:, :, self._previous],
                paths.reshape(size * size, targets),
            ),
            motion,
            self.channels,
        )
        for block, reading in zip(self._branches, (active, passive), strict=True):
            state = take_in(state, block, reading)
        paths = state.log_probability.reshape(size, size, targets)
        total = log_sum(paths)
        unreachable = ~np.isfinite(total)
        paths = np.where(unreachable, -np.log(size), paths)
        mean, covariance = moments(
            np.exp(paths - np.where(unreachable, 0.0, total)),
            state.mean.reshape(components, size, size, targets),
            state.covariance.reshape(components, components, size, size, targets),
        )
        return off_tangent(self.channels, Hypotheses(state.reference, mean, covariance, total))
