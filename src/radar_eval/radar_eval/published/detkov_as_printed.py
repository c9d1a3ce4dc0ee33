# SPDX-License-Identifier: Apache-2.0
"""The filter of Detkov 2022 with (17)-(20) as they are printed: no process noise in the innovation's covariance."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from bearing_tracker.fusion import Belief, ChannelPair, Motion, Reading
from bearing_tracker.fusion.dcmp import DcmpFilter
from bearing_tracker.fusion.hypotheses import Hypotheses, log_chain, predict_probability
from bearing_tracker.fusion.passage import move
from bearing_tracker.fusion.restarts import mixed
from bearing_tracker.fusion.small_matrices import (
    apply,
    cholesky,
    congruence,
    product,
    solve_lower,
    solve_lower_transposed,
)
from bearing_tracker.fusion.tangent import off_tangent, on_tangent
from bearing_tracker.fusion.update import blocks

FloatArray = npt.NDArray[np.float64]


class AsPrintedFilter(DcmpFilter):
    """Both channels at once, by (8)-(11) and (16)-(21), for plain numbers and one motion for all targets.

    (9) then subtracts more than was learnt. Where process noise dominates the covariances stop being any.

    Attributes:
        channels: that it was made for.
    """

    def __init__(self, channels: ChannelPair) -> None:
        """Make the filter.

        Args:
            channels: through which targets are seen.
        """
        super().__init__(channels)
        self._seen = blocks(channels, np.arange(channels.hypotheses))

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
            motion: from then to now, one for all.
            active: what the active channel reported.
            passive: what the passive channel reported.

        Returns:
            The belief now.
        """
        before = on_tangent(self.channels, belief)
        predicted, origin = predict_probability(
            before.log_probability, log_chain(self.channels, motion)
        )
        start = Hypotheses(before.reference, *mixed(before, origin), predicted)
        state = move(start, motion, self.channels)
        observation, variance, value = self._stacked(active, passive)
        known = state.covariance - motion.noise[:, :, None, None]
        factor = cholesky(congruence(observation, known) + variance)
        cross = product(observation, state.covariance)
        gain = solve_lower_transposed(factor, solve_lower(factor, cross)).swapaxes(0, 1)
        innovation = value - apply(observation, state.mean)
        white = solve_lower(factor, innovation[:, None])[:, 0]
        exponent = -0.5 * (white**2).sum(axis=0) - np.log(factor[0, 0] * factor[1, 1])
        after = Hypotheses(
            state.reference,
            state.mean + apply(gain, innovation),
            state.covariance - product(gain, cross),
            predicted + exponent,
        )
        return off_tangent(self.channels, after)

    def _stacked(
        self, active: Reading | None, passive: Reading | None
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Stack h, the noise and the readings of both; what was not reported is zero with unit noise."""
        given = [
            (block, reading)
            for block, reading in zip(self._seen, (active, passive), strict=True)
            if reading is not None
        ]
        observation = np.concatenate([block.observation * r.reported for block, r in given])
        variance = np.zeros((len(given), *observation.shape[:1], *observation.shape[2:]))
        for row, (block, reading) in enumerate(given):
            loud = block.noise[0, 0] ** 2 * reading.covariance[0, 0]
            variance[row, row] = np.where(reading.reported, loud, 1.0)
        value = np.concatenate([np.where(r.reported, r.value.T, 0.0) for _, r in given])
        return observation, variance, value[:, None]
