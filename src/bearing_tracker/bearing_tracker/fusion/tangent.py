# SPDX-License-Identifier: Apache-2.0
"""Angles as deviations from one reference direction per target, so that linear algebra may be done with them.

Hypotheses of one target lie near each other; on the tangent of the circle at a direction among them a mean is a mean,
also across north.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from bearing_tracker.fusion.belief import Belief
from bearing_tracker.fusion.hypotheses import Hypotheses, log_sum
from bearing_tracker.fusion.interface import ChannelPair
from radar_common.frames import wrap_pi

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]


def wrapped(values: FloatArray, angles: BoolArray) -> FloatArray:
    """Bring angles to [-pi, pi) and leave everything else.

    Args:
        values: components first, shape (k, ...).
        angles: which components are angles, shape (k,).

    Returns:
        Shape as values.
    """
    if not angles.any():
        return values
    if angles.all():
        return wrap_pi(values)
    result = values.copy()
    for component in np.flatnonzero(angles):
        result[component] = wrap_pi(values[component])
    return result


def on_tangent(channels: ChannelPair, belief: Belief, axis: FloatArray | None = None) -> Hypotheses:
    """Express a belief by deviations from a direction.

    Args:
        channels: that tell which components are angles.
        belief: in n targets.
        axis: that direction, shape (n, nx); None for that of the most probable hypothesis.

    Returns:
        The same states.
    """
    mean = np.ascontiguousarray(belief.mean.T)
    log_probability = np.ascontiguousarray(belief.log_probability.T)
    if axis is None:
        best = log_probability.argmax(axis=0)
        reference = mean[:, best, np.arange(len(belief))] * channels.angles[:, None]
    else:
        reference = np.ascontiguousarray(axis.T)
    apart = wrapped(mean - reference[:, None], channels.angles)
    covariance = np.ascontiguousarray(belief.covariance.T)
    return Hypotheses(reference, apart, covariance, log_probability)


def off_tangent(channels: ChannelPair, state: Hypotheses) -> Belief:
    """Come back to directions, and to probabilities that sum to one.

    Args:
        channels: that tell which components are angles.
        state: on the tangent; what all hypotheses share may stand once.

    Returns:
        The belief.
    """
    mean = wrapped(state.mean + state.reference[:, None], channels.angles)
    square, shape = state.covariance.shape[:2], state.log_probability.shape
    return Belief(
        np.broadcast_to(mean, (len(mean), *shape)).T,
        np.broadcast_to(state.covariance, (*square, *shape)).T,
        (state.log_probability - log_sum(state.log_probability)).T,
    )
