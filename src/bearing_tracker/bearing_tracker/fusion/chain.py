# SPDX-License-Identifier: Apache-2.0
"""Markov chains of a channel's states over steps of any length.

A chain that draws its state anew at random times, each state as often as its share of time, has a transition matrix
that follows any step: over t + s it is that over t times that over s. With two states every chain is of this kind.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]


def chain_after(shares: npt.ArrayLike, memory: float, seconds: npt.ArrayLike) -> FloatArray:
    """Transition matrix over a step.

    Args:
        shares: share of time of each state, shape (states,), sum one.
        memory: seconds after which a state is drawn anew on average, which can be the same one again.
        seconds: length of the step, a number or shape (n,).

    Returns:
        Probabilities from row to column, shape (states, states) or (n, states, states).

    Raises:
        ValueError: shares are no probabilities, the memory is not positive or time runs back.
    """
    share = np.asarray(shares, dtype=np.float64)
    length = np.asarray(seconds, dtype=np.float64)
    if share.ndim != 1 or (share < 0.0).any() or not np.isclose(share.sum(), 1.0):
        raise ValueError(f"shares of time are at least zero and sum to one, got {share}")
    if not memory > 0.0 or not (length >= 0.0).all():
        raise ValueError("memory must be positive and no step negative")
    stays = np.exp(-length / memory)[..., None, None]
    return stays * np.eye(len(share)) + (1.0 - stays) * share


def shares_and_memory(undisturbed: float, disturbed: float) -> tuple[tuple[float, float], float]:
    """Describe a chain of two states by how long it stays in them.

    Args:
        undisturbed: seconds on average.
        disturbed: seconds on average.

    Returns:
        (shares of time, memory in seconds) for chain_after.

    Raises:
        ValueError: a time is not positive.
    """
    if not (undisturbed > 0.0 and disturbed > 0.0):
        raise ValueError("the mean times undisturbed and disturbed must be positive")
    total = undisturbed + disturbed
    return (undisturbed / total, disturbed / total), undisturbed * disturbed / total
