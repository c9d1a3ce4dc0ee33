# SPDX-License-Identifier: Apache-2.0
"""Filters that do not ask in which state the channels are: one believes in no disturbance, one is told the truth."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from bearing_tracker.fusion.belief import Belief
from bearing_tracker.fusion.dcmp import DcmpFilter
from bearing_tracker.fusion.hypotheses import Hypotheses
from bearing_tracker.fusion.interface import ChannelPair, Motion, Reading
from bearing_tracker.fusion.passage import move
from bearing_tracker.fusion.tangent import off_tangent, on_tangent
from bearing_tracker.fusion.update import seen_in, take_in

IntArray = npt.NDArray[np.intp]


class ToldFilter(DcmpFilter):
    """One Kalman filter a target; the hypotheses all hold its state and one of them is certain.

    Attributes:
        channels: that it was made for.
    """

    def __init__(self, channels: ChannelPair, *, truth: bool) -> None:
        """Make the filter.

        Args:
            channels: through which targets are seen.
            truth: whether it reads the channels' true states from the readings, which bounds what any filter can do;
                else it takes both channels for undisturbed at all times.
        """
        super().__init__(channels)
        self._truth = truth

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
            ValueError: a reading is not finite or its covariance not positive definite,
                or it does not tell the true state to the filter that must be told.
        """
        rows, certain = np.arange(len(belief)), belief.log_probability.argmax(axis=1)
        one = Belief(
            belief.mean[rows, certain][:, None],
            belief.covariance[rows, certain][:, None],
            np.zeros((len(belief), 1)),
        )
        state = move(on_tangent(self.channels, one, motion.axis), motion, self.channels)
        passives = self.channels.passive.states
        channels = (self.channels.active, self.channels.passive)
        before = np.divmod(certain, passives)
        now = [self._state(*told) for told in zip((active, passive), before, strict=True)]
        for channel, reading, known in zip(channels, (active, passive), now, strict=True):
            state = take_in(state, seen_in(channel, known[None]), reading)
        certainty = np.full((self.channels.hypotheses, len(belief)), -np.inf)
        certainty[now[0] * passives + now[1], rows] = 0.0
        return off_tangent(
            self.channels,
            Hypotheses(state.reference, state.mean, state.covariance, certainty),
        )

    def _state(self, reading: Reading | None, previous: IntArray) -> IntArray:
        if not self._truth:
            return np.zeros_like(previous)
        if reading is None:
            return previous
        if reading.state is None:
            raise ValueError("the oracle must be told the channels' states with the readings")
        return np.where(reading.reported, reading.state, previous)
