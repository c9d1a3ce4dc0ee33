# SPDX-License-Identifier: Apache-2.0
"""Channels that measure the azimuth of a state (azimuth, rate)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from bearing_tracker.fusion.interface import Channel, ChannelPair


def azimuth_channel(
    transition: npt.ArrayLike,
    variance: Sequence[float],
    signal: Sequence[float],
    *,
    circular: bool = True,
) -> Channel:
    """Make a channel from what a disturbance does to its signal and to its noise, as in (26) of Detkov 2022.

    Args:
        transition: Markov matrix of the states, shape (states, states).
        variance: factor a_j on the variance of the noise in each state; 100 for a jammed one.
        signal: factor b_m on the azimuth in each state; 0 where the reading is noise about the axis alone.
        circular: whether readings are angles around the circle; False for plain numbers.

    Returns:
        The channel.

    Raises:
        ValueError: the numbers of states disagree or a factor of the variance is not positive.
    """
    factors, signals = np.asarray(variance, dtype=np.float64), np.asarray(signal, dtype=np.float64)
    if factors.shape != signals.shape or not (factors > 0.0).all():
        raise ValueError("each state needs a positive factor of the variance and one of the signal")
    observation = np.zeros((len(signals), 1, 2))
    observation[:, 0, 0] = signals
    return Channel(
        np.asarray(transition, dtype=np.float64),
        observation,
        np.sqrt(factors)[:, None, None],
        np.array([circular]),
    )


def azimuth_pair(active: Channel, passive: Channel, *, circular: bool = True) -> ChannelPair:
    """Put two channels of one azimuth together.

    Args:
        active: the radar.
        passive: the direction finder.
        circular: whether the azimuth is an angle around the circle.

    Returns:
        The pair.
    """
    return ChannelPair(active, passive, np.array([circular, False]))
