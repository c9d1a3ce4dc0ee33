# SPDX-License-Identifier: Apache-2.0
"""The quasi-optimal filter of a discrete-continuous Markov process seen through two channels.

Source: A. N. Detkov, Optimal complexing of measuring devices under counteraction of the environment (in Russian),
Journal of Communications Technology and Electronics (Radiotekhnika i Elektronika) 67, 2022, (6)-(25).

Motion and process noise do not depend on the hypothesis, so (6)-(21) is an interacting-multiple-model filter whose
models differ in how they measure (H. A. P. Blom, Y. Bar-Shalom, IEEE Trans. Automatic Control 33, 1988); only the rule
of the output (24) is another.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from bearing_tracker.fusion import decision
from bearing_tracker.fusion.belief import Belief
from bearing_tracker.fusion.hypotheses import Hypotheses, log_chain, predict_probability
from bearing_tracker.fusion.interface import (
    NO_LOSS_OF_ERROR,
    ChannelPair,
    Estimate,
    Loss,
    Motion,
    Output,
    Reading,
)
from bearing_tracker.fusion.passage import begin, move
from bearing_tracker.fusion.restarts import Restart, mixed
from bearing_tracker.fusion.tangent import off_tangent, on_tangent
from bearing_tracker.fusion.update import blocks, take_in

FloatArray = npt.NDArray[np.float64]


class DcmpFilter:
    """A Kalman filter for each pair of channel states, all restarted from each other before each step.

    Attributes:
        channels: that it was made for.
    """

    def __init__(self, channels: ChannelPair, restart: Restart = mixed) -> None:
        """Make the filter.

        Args:
            channels: through which targets are seen.
            restart: where the hypotheses start a step from.
        """
        self.channels = channels
        self._restart = restart
        self._blocks = blocks(channels, np.arange(channels.hypotheses))

    def start(
        self,
        mean: FloatArray,
        covariance: FloatArray,
        active: FloatArray | None = None,
        passive: FloatArray | None = None,
    ) -> Belief:
        """Begin; see ChannelFilter.start.

        Args:
            mean: of the state, shape (n, nx).
            covariance: of the state, shape (nx, nx) or (n, nx, nx).
            active: probabilities of the active channel's states; None for equal ones.
            passive: probabilities of the passive channel's states; None for equal ones.

        Returns:
            The belief in each target.

        Raises:
            ValueError: shapes disagree.
        """
        return begin(self.channels, mean, covariance, active, passive)

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
        state = on_tangent(self.channels, belief, motion.axis)
        predicted, origin = predict_probability(
            state.log_probability, log_chain(self.channels, motion)
        )
        mean, covariance = self._restart(state, origin)
        state = move(
            Hypotheses(state.reference, mean, covariance, predicted), motion, self.channels
        )
        for block, reading in zip(self._blocks, (active, passive), strict=True):
            state = take_in(state, block, reading)
        return off_tangent(self.channels, state)

    def estimate(
        self, belief: Belief, output: Output = "mmse", loss: Loss = NO_LOSS_OF_ERROR
    ) -> Estimate:
        """Make one answer of the hypotheses; see ChannelFilter.estimate.

        Args:
            belief: at some time.
            output: `mmse` or `map`.
            loss: that rule (24) weighs.

        Returns:
            State, covariance and the channels' states.
        """
        return decision.estimate(self.channels, belief, output, loss)
