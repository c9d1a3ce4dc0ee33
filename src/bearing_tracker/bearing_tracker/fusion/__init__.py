# SPDX-License-Identifier: Apache-2.0
"""Filters of two angle channels, by the name that the parameter `filter` gives them."""

from __future__ import annotations

from collections.abc import Callable

from bearing_tracker.fusion.belief import Belief, join
from bearing_tracker.fusion.dcmp import DcmpFilter
from bearing_tracker.fusion.gpb2 import Gpb2Filter
from bearing_tracker.fusion.interface import (
    Channel,
    ChannelFilter,
    ChannelPair,
    Estimate,
    Loss,
    Motion,
    Output,
    Reading,
)
from bearing_tracker.fusion.restarts import merged, reassigned, separate
from bearing_tracker.fusion.single import SingleChannelFilter
from bearing_tracker.fusion.told import ToldFilter

FILTERS: dict[str, Callable[[ChannelPair], ChannelFilter]] = {
    "dcmp": DcmpFilter,
    "active": lambda channels: SingleChannelFilter(channels, "active"),
    "passive": lambda channels: SingleChannelFilter(channels, "passive"),
    "gpb1": lambda channels: DcmpFilter(channels, merged),
    "gpb2": Gpb2Filter,
    "bank": lambda channels: DcmpFilter(channels, separate),
    "reassignment": lambda channels: DcmpFilter(channels, reassigned),
    "kalman": lambda channels: ToldFilter(channels, truth=False),
    "oracle": lambda channels: ToldFilter(channels, truth=True),
}
"""Filters by name: that of the paper (the same as an interacting-multiple-model filter); it with one channel alone;
pseudo-Bayesian of order 1 and 2; a bank without mixing; all restarted from the most probable; one Kalman filter that
ignores disturbances; one that is told them (its readings must carry the true states)."""

__all__ = [
    "FILTERS",
    "Belief",
    "Channel",
    "ChannelFilter",
    "ChannelPair",
    "Estimate",
    "Loss",
    "Motion",
    "Output",
    "Reading",
    "join",
]
