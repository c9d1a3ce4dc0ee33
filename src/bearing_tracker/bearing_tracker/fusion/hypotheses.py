# SPDX-License-Identifier: Apache-2.0
"""Probabilities of the hypotheses and the moments of their mixtures."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from bearing_tracker.fusion.interface import ChannelPair, Motion
from bearing_tracker.fusion.small_matrices import symmetrised

FloatArray = npt.NDArray[np.float64]


def log_sum(exponents: FloatArray, axis: int) -> FloatArray:
    """Logarithm of a sum of exponentials, shifted by the largest.

    Args:
        exponents: any shape; minus infinity for a zero.
        axis: along which to add.

    Returns:
        Without that axis.
    """
    largest = exponents.max(axis=axis, keepdims=True)
    largest = np.where(np.isfinite(largest), largest, 0.0)
    with np.errstate(divide="ignore"):
        total = np.log(np.exp(exponents - largest).sum(axis=axis))
    return total + np.squeeze(largest, axis)


def log_chain(channels: ChannelPair, motion: Motion) -> FloatArray:
    """Transitions of the pair of chains, which do not influence each other.

    Args:
        channels: whose own chains serve where the motion brings none.
        motion: of this step.

    Returns:
        log pi^a_ij pi^b_nm from hypothesis (i, n) to (j, m), shape (M, M) or (n, M, M).
    """
    active = channels.active.transition if motion.active_chain is None else motion.active_chain
    passive = channels.passive.transition if motion.passive_chain is None else motion.passive_chain
    joint = np.einsum("...ij,...nm->...injm", active, passive)
    size = channels.hypotheses
    with np.errstate(divide="ignore"):
        return np.log(joint.reshape(*joint.shape[:-4], size, size))


def predict_probability(
    log_probability: FloatArray, chain: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Probability of each hypothesis before its readings, (7), and where it came from.

    Args:
        log_probability: before the step, shape (n, M).
        chain: log_chain of the step.

    Returns:
        (log P~ of each hypothesis, shape (n, M); probability c of the previous hypothesis given the present one,
        shape (n, previous, present)). A hypothesis that cannot be reached comes from all, as probable as they are.
    """
    paths = log_probability[:, :, None] + chain
    predicted = log_sum(paths, axis=1)
    unreachable = ~np.isfinite(predicted)
    if unreachable.any():
        paths = np.where(unreachable[:, None, :], log_probability[:, :, None], paths)
    origin = np.exp(paths - np.where(unreachable, 0.0, predicted)[:, None, :])
    return predicted, origin


def spread(
    weights: FloatArray, mean: FloatArray, covariance: FloatArray, centre: FloatArray
) -> FloatArray:
    """Second moments of mixtures about given points.

    Args:
        weights: of h components in g mixtures, sum over h is one, shape (n, h, g).
        mean: of the components, shape (n, h, g, nx) or (n, h, 1, nx).
        covariance: of the components, shape (n, h, g, nx, nx) or (n, h, 1, nx, nx).
        centre: of each mixture, shape (n, g, nx).

    Returns:
        sum_h w {P_h + (x_h - c)(x_h - c)'}, shape (n, g, nx, nx).
    """
    apart = mean - centre[:, None]
    weighted = weights[..., None] * apart
    within = weights[..., None, None] * covariance
    return symmetrised(within.sum(axis=1) + np.einsum("nhgi,nhgj->ngij", weighted, apart))


def moments(
    weights: FloatArray, mean: FloatArray, covariance: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Mean and covariance of mixtures, (12) and (13) of Detkov 2022 before the motion.

    Args:
        weights: as for spread.
        mean: as for spread.
        covariance: as for spread.

    Returns:
        (mean, shape (n, g, nx); covariance, shape (n, g, nx, nx)).
    """
    centre = (weights[..., None] * mean).sum(axis=1)
    return centre, spread(weights, mean, covariance, centre)
