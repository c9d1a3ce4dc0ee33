# SPDX-License-Identifier: Apache-2.0
"""Mixtures of Gaussian densities: their moments, their probabilities, and their mixing between motion models."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]

_LEAST = 1e-30
_LOST, _REVIVED = 1e-6, 1e-5


def moments(
    weight: FloatArray, mean: FloatArray, covariance: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Mean and covariance of mixtures.

    Args:
        weight: of the components, of sum one, shape (..., C).
        mean: shape (..., C, D).
        covariance: shape (..., C, D, D).

    Returns:
        Shapes (..., D) and (..., D, D).
    """
    centre = (weight[..., np.newaxis, :] @ mean)[..., 0, :]
    apart = mean - centre[..., np.newaxis, :]
    flat = covariance.reshape(*weight.shape, mean.shape[-1] ** 2)
    within = (weight[..., np.newaxis, :] @ flat).reshape(*centre.shape, centre.shape[-1])
    between = np.swapaxes(weight[..., np.newaxis] * apart, -1, -2) @ apart
    return centre, within + between


def reweighted(weight: FloatArray, log_likelihood: FloatArray) -> FloatArray:
    """Weigh components by how well they foretold a bearing.

    Args:
        weight: before, shape (n, B, M).
        log_likelihood: of the bearing under each, shape (n, B, M).

    Returns:
        Probabilities after it, of sum one over B and M. None becomes zero, so that no component is lost for ever.
    """
    logarithm = np.log(weight) + log_likelihood
    logarithm -= logarithm.max(axis=(1, 2), keepdims=True)
    weight = np.maximum(np.exp(logarithm), _LEAST)
    return weight / weight.sum(axis=(1, 2), keepdims=True)


def revived(
    weight: FloatArray, mean: FloatArray, covariance: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Let bins that the bearings have ruled out take the place of the rest.

    A filter at a wrong range ends up anywhere, and would spoil the whole when bearings surprise it. In the place of the
    others it does no harm, and catches what they lose.

    Args:
        weight: of sum one over B and M, shape (n, B, M).
        mean: shape (n, B, M, D).
        covariance: shape (n, B, M, D, D).

    Returns:
        Weights, means and covariances, shapes as before.
    """
    lost = weight.sum(axis=2) < _LOST
    rows = np.flatnonzero(lost.any(axis=1))
    if not len(rows):
        return weight, mean, covariance
    where = lost[rows][:, :, np.newaxis]
    given = np.maximum(weight[rows], _LEAST)
    share = np.moveaxis(given / given.sum(axis=1, keepdims=True), 1, 2)
    centre, spread = moments(share, mean[rows].swapaxes(1, 2), covariance[rows].swapaxes(1, 2))
    of_models = _REVIVED * given.sum(axis=1, keepdims=True)
    weight, mean, covariance = weight.copy(), mean.copy(), covariance.copy()
    weight[rows] = np.where(where, of_models, weight[rows])
    weight[rows] /= weight[rows].sum(axis=(1, 2), keepdims=True)
    mean[rows] = np.where(where[..., np.newaxis], centre[:, np.newaxis], mean[rows])
    covariance[rows] = np.where(
        where[..., np.newaxis, np.newaxis], spread[:, np.newaxis], covariance[rows]
    )
    return weight, mean, covariance


def switching(seconds: FloatArray, quiet_time: float, manoeuvre_time: float) -> FloatArray:
    """Probabilities of passing between quiet flight and manoeuvre in some time.

    Args:
        seconds: shape (n,).
        quiet_time: mean time in quiet flight, seconds.
        manoeuvre_time: mean time in a manoeuvre, seconds.

    Returns:
        From the first index to the second, shape (n, 2, 2).
    """
    leave, come_back = 1.0 / quiet_time, 1.0 / manoeuvre_time
    at_rest = np.array([come_back, leave]) / (leave + come_back)
    kept = np.exp(-(leave + come_back) * seconds)[:, np.newaxis, np.newaxis]
    return kept * np.eye(2) + (1.0 - kept) * at_rest


def interacted(
    weight: FloatArray, mean: FloatArray, covariance: FloatArray, passing: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Mix the motion models of each bin, as an interacting multiple model filter does before it predicts.

    Source: Blom and Bar-Shalom 1988.

    Args:
        weight: shape (n, B, M).
        mean: shape (n, B, M, D).
        covariance: shape (n, B, M, D, D).
        passing: probabilities from model to model, shape (n, M, M).

    Returns:
        Weights, means and covariances of the bins' models, shapes as before.
    """
    joint = weight[..., np.newaxis] * passing[:, np.newaxis]
    later = np.maximum(joint.sum(axis=2), _LEAST)
    share = joint / later[:, :, np.newaxis]
    centre, spread = zip(
        *(moments(share[..., model], mean, covariance) for model in range(weight.shape[2])),
        strict=True,
    )
    return later, np.stack(centre, axis=2), np.stack(spread, axis=2)
