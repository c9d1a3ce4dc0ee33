# SPDX-License-Identifier: Apache-2.0
"""One channel's readings taken in under every hypothesis.

Detkov 2022 updates with both channels at once, by the blocks (10), (11) of the gain. The noises of the two channels are
independent, so one channel after the other gives the same state, covariance and likelihood, without the inverse of the
joint matrix. The product of both steps obeys the corrected equations:

- (11) prints its first term as -R h1' S1^-1 R22^-1 R21; the inverse of a block matrix has -R h1' S1^-1 R12 R22^-1, and
  only that conforms where the channels have different numbers of components.
- (17)-(20) omit h_p Gamma Gamma' h_q', the share of the process noise in the covariance of the innovation, which (9)
  and (13) contain; here it is h R~ h' with all of R~.
- (21) transposes the right-hand innovation, which would make the exponent a matrix; it is nu' R^-1 nu.
- (4)-(6) normalise by f(y|Y) and average f(y|x) over the posterior, which holds y already; the likelihood here
  averages it over the prediction.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from bearing_tracker.fusion.hypotheses import Hypotheses
from bearing_tracker.fusion.interface import Channel, ChannelPair, Reading
from bearing_tracker.fusion.small_matrices import (
    apply,
    cholesky,
    congruence,
    product,
    product_transposed,
    solve_lower,
    solve_lower_transposed,
    symmetrised,
)
from bearing_tracker.fusion.tangent import wrapped

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]
IntArray = npt.NDArray[np.intp]


@dataclass(frozen=True, slots=True)
class Block:
    """A channel as the hypotheses see it.

    Attributes:
        observation: h under each hypothesis, shape (ny, nx, M, 1) or (ny, nx, M, n).
        noise: G under each hypothesis, shape (ny, ny, M, 1) or (ny, ny, M, n).
        undisturbed: h of the undisturbed state, shape (ny, nx, 1); it tells where the reference direction is read.
        angles: which components of a reading are angles, shape (ny,).
    """

    observation: FloatArray
    noise: FloatArray
    undisturbed: FloatArray
    angles: BoolArray


def seen_in(channel: Channel, states: IntArray) -> Block:
    """Write a channel out for given states of it.

    Args:
        channel: active or passive.
        states: of it under each hypothesis, shape (M, 1) or (M, n).

    Returns:
        The channel in those states.
    """
    return Block(
        np.ascontiguousarray(np.moveaxis(channel.observation[states], (-2, -1), (0, 1))),
        np.ascontiguousarray(np.moveaxis(channel.noise[states], (-2, -1), (0, 1))),
        channel.observation[0][:, :, None],
        channel.angles,
    )


def blocks(channels: ChannelPair, hypotheses: IntArray) -> tuple[Block, Block]:
    """Write both channels out for given hypotheses.

    Args:
        channels: active and passive.
        hypotheses: numbers j * M2 + m of pairs of states, shape (k,).

    Returns:
        What these hypotheses say of the active and of the passive channel.
    """
    active, passive = np.divmod(hypotheses[:, None], channels.passive.states)
    return seen_in(channels.active, active), seen_in(channels.passive, passive)


def take_in(state: Hypotheses, block: Block, reading: Reading | None) -> Hypotheses:
    """Improve states and probabilities by readings, (6), (8), (9), (21).

    The covariance is Joseph's form of (9). Of targets without a reading nothing changes under any hypothesis. Without
    signal, h = 0, the state stays, but how far the reading lies from the reference still speaks for or against that.

    Args:
        state: before the readings.
        block: the channel.
        reading: what it reported; None if of no target.

    Returns:
        After the readings.

    Raises:
        ValueError: a reading is not finite or its covariance not positive definite.
    """
    if reading is None or not reading.reported.any():
        return state
    reported = reading.reported
    value = np.where(reported, reading.value.T, 0.0)
    if not np.isfinite(value).all():
        raise ValueError("a reading is not finite")
    noise = congruence(block.noise, _covariance(reading))
    here = wrapped(value - apply(block.undisturbed, state.reference), block.angles)
    innovation = wrapped(here[:, None] - apply(block.observation, state.mean), block.angles)

    cross = product(block.observation, state.covariance)
    factor = cholesky(product_transposed(cross, block.observation) + noise)
    white = solve_lower(factor, innovation[:, None])[:, 0]
    gain = solve_lower_transposed(factor, solve_lower(factor, cross)).swapaxes(0, 1)
    keep = np.eye(len(state.mean))[:, :, None, None] - product(gain, block.observation)
    after = symmetrised(congruence(keep, state.covariance) + congruence(gain, noise))
    diagonal = np.stack([factor[row, row] for row in range(len(factor))])
    log_likelihood = -0.5 * (white * white).sum(axis=0) - np.log(diagonal).sum(axis=0)

    mean = state.mean + apply(gain, innovation)
    log_probability = state.log_probability + log_likelihood
    if not reported.all():
        mean = np.where(reported, mean, state.mean)
        after = np.where(reported, after, state.covariance)
        log_probability = np.where(reported, log_probability, state.log_probability)
    return Hypotheses(state.reference, mean, after, log_probability)


def _covariance(reading: Reading) -> FloatArray:
    """Covariances, components first, and harmless ones where there is no reading."""
    covariance = reading.covariance
    if covariance.ndim == 2:
        return covariance[:, :, None, None]
    unit = np.eye(covariance.shape[-1])[:, :, None]
    return np.where(reading.reported, covariance.T, unit)[:, :, None]
