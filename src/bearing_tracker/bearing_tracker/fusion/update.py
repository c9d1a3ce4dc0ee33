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
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from bearing_tracker.fusion.interface import Reading
from bearing_tracker.fusion.small_matrices import (
    apply,
    cholesky,
    congruence,
    product,
    solve_lower,
    solve_lower_transposed,
)
from bearing_tracker.fusion.tangent import wrapped

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class Block:
    """A channel as the hypotheses see it.

    Attributes:
        observation: h under each hypothesis, shape (M, ny, nx) or (n, M, ny, nx).
        noise: G under each hypothesis, shape (M, ny, ny) or (n, M, ny, ny).
        undisturbed: h of the undisturbed state, shape (ny, nx); it tells where the reference direction is read.
        angles: which components of a reading are angles, shape (ny,).
    """

    observation: FloatArray
    noise: FloatArray
    undisturbed: FloatArray
    angles: BoolArray


@dataclass(frozen=True, slots=True)
class Hypotheses:
    """States on the tangent at a reference direction.

    Attributes:
        reference: direction where the state is an angle, else zero, shape (n, nx).
        mean: deviation from it, shape (n, M, nx).
        covariance: shape (n, M, nx, nx).
        log_probability: not normalised, shape (n, M).
    """

    reference: FloatArray
    mean: FloatArray
    covariance: FloatArray
    log_probability: FloatArray


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
    value = np.where(reported[:, None], reading.value, 0.0)
    if not np.isfinite(value).all():
        raise ValueError("a reading is not finite")
    covariance = _of_reported(reading)
    noise = congruence(block.noise, covariance)
    here = wrapped(value - apply(block.undisturbed, state.reference), block.angles)
    innovation = wrapped(here[:, None] - apply(block.observation, state.mean), block.angles)

    cross = product(block.observation, state.covariance)
    factor = cholesky(np.einsum("...ij,...kj->...ik", cross, block.observation) + noise)
    white = solve_lower(factor, innovation[..., None])[..., 0]
    gain = np.swapaxes(solve_lower_transposed(factor, solve_lower(factor, cross)), -1, -2)
    keep = np.eye(state.mean.shape[-1]) - product(gain, block.observation)
    after = congruence(keep, state.covariance) + congruence(gain, noise)
    diagonal = np.einsum("...ii->...i", factor)
    log_likelihood = -0.5 * (white * white).sum(axis=-1) - np.log(diagonal).sum(axis=-1)

    mean = state.mean + apply(gain, innovation)
    after = 0.5 * (after + np.swapaxes(after, -1, -2))
    log_probability = state.log_probability + log_likelihood
    if not reported.all():
        mean = np.where(reported[:, None, None], mean, state.mean)
        after = np.where(reported[:, None, None, None], after, state.covariance)
        log_probability = np.where(reported[:, None], log_probability, state.log_probability)
    return Hypotheses(state.reference, mean, after, log_probability)


def _of_reported(reading: Reading) -> FloatArray:
    """Covariances with the hypotheses' axis, and harmless ones where there is no reading."""
    if reading.covariance.ndim == 2:
        return reading.covariance
    unit = np.eye(reading.covariance.shape[-1])
    covariance = np.where(reading.reported[:, None, None], reading.covariance, unit)
    return np.asfortranarray(covariance)[:, None]
