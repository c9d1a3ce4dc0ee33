# SPDX-License-Identifier: Apache-2.0
"""Where each hypothesis starts a step from: the one thing in which the compared filters of M hypotheses differ."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from bearing_tracker.fusion.hypotheses import Hypotheses, moments

FloatArray = npt.NDArray[np.float64]

Restart = Callable[[Hypotheses, FloatArray], tuple[FloatArray, FloatArray]]
"""Of the hypotheses and the probabilities c of their origins, (previous, present, n): mean and covariance to start."""


def mixed(state: Hypotheses, origin: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Each hypothesis from the mixture of those it may come from, (12) and (13) of Detkov 2022.

    (5) is printed without 1 / P~, so that the density would not integrate to one; (12) and (13) contain it, in c.

    Args:
        state: before the step.
        origin: c, shape (M, M, n).

    Returns:
        Mean, shape (nx, M, n), and covariance, shape (nx, nx, M, n).
    """
    return moments(origin, state.mean[:, :, None], state.covariance[:, :, :, None])


def merged(state: Hypotheses, origin: FloatArray) -> tuple[FloatArray, FloatArray]:
    """All from the mixture of all: the pseudo-Bayesian estimator of the first order (GPB1).

    Source: G. A. Ackerson, K. S. Fu, IEEE Trans. Automatic Control 15, 1970.

    Args:
        state: before the step.
        origin: not used; who comes from where is forgotten.

    Returns:
        Mean, shape (nx, 1, n), and covariance, shape (nx, nx, 1, n), the same for all hypotheses.
    """
    weights = np.exp(state.log_probability)[:, None]
    return moments(weights, state.mean[:, :, None], state.covariance[:, :, :, None])


def separate(state: Hypotheses, origin: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Each from itself alone: a bank of Kalman filters without mixing.

    Args:
        state: before the step.
        origin: not used.

    Returns:
        Mean, shape (nx, M, n), and covariance, shape (nx, nx, M, n).
    """
    return state.mean, state.covariance


def reassigned(state: Hypotheses, origin: FloatArray) -> tuple[FloatArray, FloatArray]:
    """All from the most probable one: hard reassignment of the conditional density's parameters.

    Args:
        state: before the step.
        origin: not used.

    Returns:
        Mean, shape (nx, 1, n), and covariance, shape (nx, nx, 1, n), the same for all hypotheses.
    """
    best, targets = state.log_probability.argmax(axis=0), np.arange(state.mean.shape[-1])
    return state.mean[:, best, targets][:, None], state.covariance[:, :, best, targets][:, :, None]
