# SPDX-License-Identifier: Apache-2.0
"""What a filter of two channels believes of many targets."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Belief:
    """State of each target under each hypothesis about the channels, and the hypotheses' probabilities.

    Arrays lie in memory with the targets' axis innermost, which is what makes one call for a thousand targets quick.

    Attributes:
        mean: of the state, angles in [-pi, pi), shape (n, M, nx).
        covariance: of the state, shape (n, M, nx, nx).
        log_probability: natural logarithm of the hypothesis' probability, shape (n, M); sums to one in exp.
    """

    mean: FloatArray
    covariance: FloatArray
    log_probability: FloatArray

    def __len__(self) -> int:
        """Number n of targets."""
        return len(self.mean)

    def take(self, rows: npt.NDArray[Any]) -> Belief:
        """Pick targets.

        Args:
            rows: numbers of targets or a mask of shape (n,).

        Returns:
            The belief in them alone.
        """
        return Belief(self.mean[rows], self.covariance[rows], self.log_probability[rows])

    def put(self, rows: npt.NDArray[Any], part: Belief) -> Belief:
        """Exchange some targets, say those that a step moved on.

        Args:
            rows: numbers of targets or a mask of shape (n,).
            part: the new belief in them.

        Returns:
            The belief in all targets.
        """
        mean = self.mean.copy(order="K")
        covariance = self.covariance.copy(order="K")
        log_probability = self.log_probability.copy(order="K")
        mean[rows], covariance[rows] = part.mean, part.covariance
        log_probability[rows] = part.log_probability
        return Belief(mean, covariance, log_probability)


def join(parts: Sequence[Belief]) -> Belief:
    """Put targets one after the other.

    Args:
        parts: beliefs with the same hypotheses, at least one.

    Returns:
        The belief in all of them.
    """
    return Belief(
        np.concatenate([part.mean.T for part in parts], axis=-1).T,
        np.concatenate([part.covariance.T for part in parts], axis=-1).T,
        np.concatenate([part.log_probability.T for part in parts], axis=-1).T,
    )
