# SPDX-License-Identifier: Apache-2.0
"""Where each hypothesis starts a step from: the one thing in which the compared filters of M hypotheses differ."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from bearing_tracker.fusion.hypotheses import moments
from bearing_tracker.fusion.update import Hypotheses

FloatArray = npt.NDArray[np.float64]

Restart = Callable[[Hypotheses, FloatArray], tuple[FloatArray, FloatArray]]
"""Of the hypotheses and the probabilities c of their origins, (n, previous, present): mean and covariance to start."""


def mixed(state: Hypotheses, origin: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Each hypothesis from the mixture of those it may come from, (12) and (13) of Detkov 2022.

    Args:
        state: before the step.
        origin: c, shape (n, M, M).

    Returns:
        Mean, shape (n, M, nx), and covariance, shape (n, M, nx, nx).
    """
    return moments(origin, state.mean[:, :, None], state.covariance[:, :, None])


def merged(state: Hypotheses, origin: FloatArray) -> tuple[FloatArray, FloatArray]:
    """All from the mixture of all: the pseudo-Bayesian estimator of the first order (GPB1).

    Source: G. A. Ackerson, K. S. Fu, IEEE Trans. Automatic Control 15, 1970.

    Args:
        state: before the step.
        origin: not used; who comes from where is forgotten.

    Returns:
        Mean, shape (n, M, nx), and covariance, shape (n, M, nx, nx).
    """
    weights = np.exp(state.log_probability)[:, :, None]
    mean, covariance = moments(weights, state.mean[:, :, None], state.covariance[:, :, None])
    return _for_all(mean, state), _for_all(covariance, state)


def separate(state: Hypotheses, origin: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Each from itself alone: a bank of Kalman filters without mixing.

    Args:
        state: before the step.
        origin: not used.

    Returns:
        Mean, shape (n, M, nx), and covariance, shape (n, M, nx, nx).
    """
    return state.mean, state.covariance


def reassigned(state: Hypotheses, origin: FloatArray) -> tuple[FloatArray, FloatArray]:
    """All from the most probable one: hard reassignment of the conditional density's parameters.

    Args:
        state: before the step.
        origin: not used.

    Returns:
        Mean, shape (n, M, nx), and covariance, shape (n, M, nx, nx).
    """
    rows, best = np.arange(len(state.mean)), state.log_probability.argmax(axis=1)
    mean, covariance = state.mean[rows, best][:, None], state.covariance[rows, best][:, None]
    return _for_all(mean, state), _for_all(covariance, state)


def _for_all(one: FloatArray, state: Hypotheses) -> FloatArray:
    hypotheses = state.mean.shape[1]
    return np.broadcast_to(one, (one.shape[0], hypotheses, *one.shape[2:]))
