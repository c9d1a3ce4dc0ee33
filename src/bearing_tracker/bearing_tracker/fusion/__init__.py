# SPDX-License-Identifier: Apache-2.0
"""Filters of two angle channels, by the name that the parameter `filter` gives them."""

from __future__ import annotations

from bearing_tracker.fusion.belief import Belief, join
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

__all__ = [
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
