# SPDX-License-Identifier: Apache-2.0
"""The parts of a step that all filters share: begin, go onto the tangent, move, come back."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from bearing_tracker.fusion.belief import Belief
from bearing_tracker.fusion.hypotheses import log_sum
from bearing_tracker.fusion.interface import Channel, ChannelPair, Motion
from bearing_tracker.fusion.small_matrices import apply, congruence
from bearing_tracker.fusion.tangent import directions, wrapped
from bearing_tracker.fusion.update import Block, Hypotheses

FloatArray = npt.NDArray[np.float64]


def begin(
    channels: ChannelPair,
    mean: FloatArray,
    covariance: FloatArray,
    active: FloatArray | None,
    passive: FloatArray | None,
) -> Belief:
    """Give every hypothesis the same state.

    Args:
        channels: that make the hypotheses.
        mean: of the state, shape (n, nx).
        covariance: of the state, shape (nx, nx) or (n, nx, nx).
        active: probabilities of the active channel's states, shape (M1,) or (n, M1); None for equal ones.
        passive: probabilities of the passive channel's states, shape (M2,) or (n, M2); None for equal ones.

    Returns:
        The belief in each target.

    Raises:
        ValueError: shapes disagree.
    """
    targets, components = mean.shape
    if components != len(channels.angles):
        raise ValueError(f"the channels see {len(channels.angles)} components, not {components}")
    size = channels.hypotheses
    marginals = [
        np.broadcast_to(
            np.full(channel.states, 1.0 / channel.states) if given is None else given,
            (targets, channel.states),
        )
        for channel, given in ((channels.active, active), (channels.passive, passive))
    ]
    joint = np.einsum("nj,nm->njm", *marginals).reshape(targets, size)
    square = (targets, size, components, components)
    with np.errstate(divide="ignore"):
        log_probability = np.log(joint)
    full = covariance if covariance.ndim == 2 else covariance[:, None]
    angles = wrapped(mean, channels.angles)[:, None]
    return Belief(
        np.asfortranarray(np.broadcast_to(angles, square[:3])),
        np.asfortranarray(np.broadcast_to(full, square)),
        np.asfortranarray(log_probability),
    )


def blocks(channels: ChannelPair) -> tuple[Block, Block]:
    """Write each channel out for the M pairs of states, of which number j * M2 + m is (j, m).

    Args:
        channels: active and passive.

    Returns:
        What each hypothesis says of the active and of the passive channel.
    """
    active, passive = channels.active, channels.passive
    pairs = np.arange(channels.hypotheses)
    return (
        seen_in(active, pairs // passive.states),
        seen_in(passive, pairs % passive.states),
    )


def seen_in(channel: Channel, states: npt.NDArray[np.intp]) -> Block:
    """Write a channel out for given states of it.

    Args:
        channel: active or passive.
        states: of it, any shape.

    Returns:
        Observation and noise, each with the shape of the states before their own.
    """
    return Block(
        np.asfortranarray(channel.observation[states]),
        np.asfortranarray(channel.noise[states]),
        channel.observation[0],
        channel.angles,
    )


def on_tangent(channels: ChannelPair, belief: Belief, motion: Motion) -> Hypotheses:
    """Express a belief by deviations from the axis of the motion, or from a direction among the hypotheses.

    Args:
        channels: that tell which components are angles.
        belief: in n targets.
        motion: whose axis is taken if it has one.

    Returns:
        The same state.
    """
    reference = directions(belief, channels.angles) if motion.axis is None else motion.axis
    return Hypotheses(
        reference,
        wrapped(np.asfortranarray(belief.mean) - reference[:, None], channels.angles),
        np.asfortranarray(belief.covariance),
        np.asfortranarray(belief.log_probability),
    )


def moved(state: Hypotheses, motion: Motion, channels: ChannelPair) -> Hypotheses:
    """Move every hypothesis on, (12) and (13); without an axis the reference direction goes along.

    Args:
        state: at the previous time.
        motion: from then to now.
        channels: that tell which components are angles.

    Returns:
        Predicted states; the probabilities are left alone.
    """
    transition, noise = _by_hypothesis(motion.transition), _by_hypothesis(motion.noise)
    mean = apply(transition, state.mean)
    covariance = congruence(transition, state.covariance) + noise
    reference = state.reference
    if motion.axis is None and channels.angles.any():
        weights = np.exp(state.log_probability - log_sum(state.log_probability, axis=1)[:, None])
        shift = np.where(channels.angles, (weights[..., None] * mean).sum(axis=1), 0.0)
        mean, reference = mean - shift[:, None], reference + shift
    return Hypotheses(reference, mean, covariance, state.log_probability)


def off_tangent(channels: ChannelPair, state: Hypotheses) -> Belief:
    """Come back to directions and to probabilities that sum to one.

    Args:
        channels: that tell which components are angles.
        state: on the tangent.

    Returns:
        The belief.
    """
    total = log_sum(state.log_probability, axis=1)
    return Belief(
        wrapped(state.mean + state.reference[:, None], channels.angles),
        state.covariance,
        state.log_probability - total[:, None],
    )


def _by_hypothesis(matrix: FloatArray) -> FloatArray:
    return matrix if matrix.ndim == 2 else np.asfortranarray(matrix)[:, None]
