# SPDX-License-Identifier: Apache-2.0
"""Filters that do not ask in which state the channels are: one believes in no disturbance, one is told the truth."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from bearing_tracker.fusion.belief import Belief
from bearing_tracker.fusion.dcmp import DcmpFilter
from bearing_tracker.fusion.interface import ChannelPair, Motion, Reading
from bearing_tracker.fusion.passage import moved, off_tangent, on_tangent, seen_in
from bearing_tracker.fusion.tangent import best
from bearing_tracker.fusion.update import Hypotheses, take_in

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
            ValueError: a reading does not tell the channel's true state to the filter that is told it.
        """
        rows, certain = np.arange(len(belief)), best(belief)
        state = on_tangent(
            self.channels,
            Belief(
                belief.mean[rows, certain][:, None],
                belief.covariance[rows, certain][:, None],
                np.zeros((len(belief), 1)),
            ),
            motion,
        )
        state = moved(state, motion, self.channels)
        passives = self.channels.passive.states
        known = (certain // passives, certain % passives)
        states = []
        for channel, reading, previous in zip(
            (self.channels.active, self.channels.passive), (active, passive), known, strict=True
        ):
            now = self._state(reading, previous)
            state = take_in(state, seen_in(channel, now[:, None]), reading)
            states.append(now)
        one_hot = np.full(belief.log_probability.shape, -np.inf)
        one_hot[rows, states[0] * passives + states[1]] = 0.0
        size = self.channels.hypotheses
        whole = Hypotheses(
            state.reference,
            np.repeat(state.mean, size, axis=1),
            np.repeat(state.covariance, size, axis=1),
            one_hot,
        )
        return off_tangent(self.channels, whole)

    def _state(self, reading: Reading | None, previous: IntArray) -> IntArray:
        if not self._truth:
            return np.zeros_like(previous)
        if reading is None:
            return previous
        if reading.state is None:
            raise ValueError("the oracle must be told the channels' states with the readings")
        return np.where(reading.reported, reading.state, previous)
