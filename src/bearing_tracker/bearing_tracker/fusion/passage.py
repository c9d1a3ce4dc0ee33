# SPDX-License-Identifier: Apache-2.0
"""The parts of a step that all filters share: to begin and to move on."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from bearing_tracker.fusion.belief import Belief
from bearing_tracker.fusion.hypotheses import Hypotheses, log_sum
from bearing_tracker.fusion.interface import ChannelPair, Motion
from bearing_tracker.fusion.small_matrices import apply, congruence
from bearing_tracker.fusion.tangent import wrapped

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
    marginals = [
        np.broadcast_to(
            np.full(channel.states, 1.0 / channel.states) if given is None else given,
            (targets, channel.states),
        )
        for channel, given in ((channels.active, active), (channels.passive, passive))
    ]
    size = channels.hypotheses
    with np.errstate(divide="ignore"):
        log_probability = np.log(np.einsum("nj,nm->jmn", *marginals).reshape(size, targets))
    angles = wrapped(mean.T, channels.angles)[:, None]
    square = np.broadcast_to(covariance, (targets, components, components)).T[:, :, None]
    return Belief(
        np.broadcast_to(angles, (components, size, targets)).T,
        np.broadcast_to(square, (components, components, size, targets)).T,
        log_probability.T,
    )


def move(state: Hypotheses, motion: Motion, channels: ChannelPair) -> Hypotheses:
    """Move every hypothesis on, (12) and (13); without an axis the reference direction goes along.

    Args:
        state: at the previous time; states that all hypotheses share may stand once, M = 1.
        motion: from then to now.
        channels: that tell which components are angles.

    Returns:
        Predicted states; the probabilities are left alone.
    """
    transition, noise = _components_first(motion.transition), _components_first(motion.noise)
    mean = apply(transition, state.mean)
    covariance = congruence(transition, state.covariance) + noise
    reference = state.reference
    if motion.axis is None and channels.angles.any():
        weights = np.exp(state.log_probability - log_sum(state.log_probability))
        shift = (weights * mean).sum(axis=1) * channels.angles[:, None]
        mean, reference = mean - shift[:, None], reference + shift
    return Hypotheses(reference, mean, covariance, state.log_probability)


def _components_first(matrix: FloatArray) -> FloatArray:
    """Shape (nx, nx, 1, 1) of one matrix for all targets, (nx, nx, 1, n) of one per target."""
    if matrix.ndim == 2:
        return matrix[:, :, None, None]
    return np.ascontiguousarray(np.moveaxis(matrix, 0, -1))[:, :, None]
