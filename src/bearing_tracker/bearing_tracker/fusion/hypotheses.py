# SPDX-License-Identifier: Apache-2.0
"""Hypotheses within a step: their states, their probabilities and the moments of their mixtures.

Components come first and targets last, as for small_matrices.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from bearing_tracker.fusion.interface import ChannelPair, Motion
from bearing_tracker.fusion.small_matrices import symmetrised

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Hypotheses:
    """States on the tangent at a reference direction.

    Attributes:
        reference: direction where the state is an angle, else zero, shape (nx, n).
        mean: deviation from it, shape (nx, M, n).
        covariance: shape (nx, nx, M, n).
        log_probability: not normalised, shape (M, n).
    """

    reference: FloatArray
    mean: FloatArray
    covariance: FloatArray
    log_probability: FloatArray


def log_sum(exponents: FloatArray) -> FloatArray:
    """Logarithm of a sum of exponentials over the first axis, shifted by the largest.

    Args:
        exponents: shape (k, ...); minus infinity for a zero.

    Returns:
        Shape (...).
    """
    largest = exponents.max(axis=0)
    largest = np.where(np.isfinite(largest), largest, 0.0)
    with np.errstate(divide="ignore"):
        return np.log(np.exp(exponents - largest).sum(axis=0)) + largest


def log_chain(channels: ChannelPair, motion: Motion) -> FloatArray:
    """Transitions of the pair of chains, which do not influence each other.

    Args:
        channels: whose own chains serve where the motion brings none.
        motion: of this step.

    Returns:
        log pi^a_ij pi^b_nm from hypothesis (i, n) to (j, m), shape (M, M, 1) or (M, M, n).
    """
    active = channels.active.transition if motion.active_chain is None else motion.active_chain
    passive = channels.passive.transition if motion.passive_chain is None else motion.passive_chain
    joint = np.einsum("...ij,...nm->injm...", active, passive, order="C")
    size = channels.hypotheses
    with np.errstate(divide="ignore"):
        return np.log(joint.reshape(size, size, -1))


def predict_probability(
    log_probability: FloatArray, chain: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Probability of each hypothesis before its readings, (7), and where it came from.

    Args:
        log_probability: before the step, shape (M, n).
        chain: log_chain of the step.

    Returns:
        (log P~ of each hypothesis, shape (M, n); probability c of the previous hypothesis given the present one,
        shape (previous, present, n)). A hypothesis that cannot be reached comes from all, as probable as they are.
    """
    paths = log_probability[:, None] + chain
    predicted = log_sum(paths)
    unreachable = ~np.isfinite(predicted)
    if unreachable.any():
        paths = np.where(unreachable, log_probability[:, None], paths)
    return predicted, np.exp(paths - np.where(unreachable, 0.0, predicted))


def spread(
    weights: FloatArray, mean: FloatArray, covariance: FloatArray, centre: FloatArray
) -> FloatArray:
    """Second moments of mixtures about given points.

    Args:
        weights: of h components in g mixtures, sum over h is one, shape (h, g, n).
        mean: of the components, shape (nx, h, g, n) or (nx, h, 1, n).
        covariance: of the components, shape (nx, nx, h, g, n) or (nx, nx, h, 1, n).
        centre: of each mixture, shape (nx, g, n).

    Returns:
        sum_h w {P_h + (x_h - c)(x_h - c)'}, shape (nx, nx, g, n).
    """
    apart = mean - centre[:, None]
    between = np.einsum("ihgn,jhgn->ijgn", weights * apart, apart)
    wide = np.broadcast_to(covariance, (*covariance.shape[:2], *weights.shape))
    return symmetrised(np.einsum("hgn,ijhgn->ijgn", weights, wide) + between)


def moments(
    weights: FloatArray, mean: FloatArray, covariance: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Mean and covariance of mixtures, (12) and (13) of Detkov 2022 before the motion.

    Args:
        weights: as for spread.
        mean: as for spread.
        covariance: as for spread.

    Returns:
        (mean, shape (nx, g, n); covariance, shape (nx, nx, g, n)).
    """
    centre = (weights * mean).sum(axis=1)
    return centre, spread(weights, mean, covariance, centre)
