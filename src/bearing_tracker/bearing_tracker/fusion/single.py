# SPDX-License-Identifier: Apache-2.0
"""One channel without the other."""

from __future__ import annotations

from typing import Literal

from bearing_tracker.fusion.belief import Belief
from bearing_tracker.fusion.dcmp import DcmpFilter
from bearing_tracker.fusion.interface import ChannelPair, Motion, Reading


class SingleChannelFilter(DcmpFilter):
    """The filter of the paper, to which one channel never reports; of that channel it knows what its chain says.

    Attributes:
        channels: that it was made for.
    """

    def __init__(self, channels: ChannelPair, heard: Literal["active", "passive"]) -> None:
        """Make the filter.

        Args:
            channels: through which targets are seen.
            heard: the channel that reports.
        """
        super().__init__(channels)
        self._heard = heard

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
        if self._heard == "active":
            return super().step(belief, motion, active=active)
        return super().step(belief, motion, passive=passive)
