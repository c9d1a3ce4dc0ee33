# SPDX-License-Identifier: Apache-2.0
"""How the noise level that a CFAR normaliser finds varies, for each kind of normaliser.

All laws are for independent cells of exponentially distributed noise power of mean one (square-law detection of
Gaussian noise). What a threshold does follows from one function of the law: noise exceeds a multiple T of the level Z
with the probability E exp(-T Z), and an echo whose power is exponential, S times that of the noise in the mean, with
E exp(-T Z / (1 + S)).
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.special import gammaln

FloatArray = npt.NDArray[np.float64]

_LOG_LEVELS = (-45.0, 7.0)
_STEPS = tuple(2.0**-power for power in range(5, 13))
_CONVERGED = 1e-8
_NEGLIGIBLE = 1e-18


class LevelLaw(ABC):
    """Distribution of a noise level, in units of the mean noise power."""

    @property
    @abstractmethod
    def mean(self) -> float:
        """Mean of the level."""

    @abstractmethod
    def log_exceedance(self, multiplier: npt.ArrayLike) -> FloatArray:
        """Logarithm of the probability that noise exceeds a multiple of the level: ln E exp(-T Z).

        Args:
            multiplier: T >= 0, any shape.

        Returns:
            Same shape; finite however small the probability is.
        """

    @abstractmethod
    def quadrature(self) -> tuple[FloatArray, FloatArray]:
        """Levels and their weights, for means over the law.

        Returns:
            Levels and weights, both of shape (nodes,); the weights have the sum one.
        """


@dataclass(frozen=True, slots=True)
class KnownLevel(LevelLaw):
    """The level is known: one."""

    @property
    def mean(self) -> float:
        """One."""
        return 1.0

    def log_exceedance(self, multiplier: npt.ArrayLike) -> FloatArray:
        """Exponential; see `LevelLaw.log_exceedance`.

        Args:
            multiplier: T >= 0, any shape.

        Returns:
            Same shape.
        """
        return -np.asarray(multiplier, dtype=float)

    def quadrature(self) -> tuple[FloatArray, FloatArray]:
        """One level; see `LevelLaw.quadrature`.

        Returns:
            Levels and weights, shape (1,).
        """
        return np.ones(1), np.ones(1)


class EstimatedLevel(LevelLaw):
    """A level with a smooth density."""

    @abstractmethod
    def density(self, level: npt.ArrayLike) -> FloatArray:
        """Probability density of the level.

        Args:
            level: positive, any shape.

        Returns:
            Same shape.
        """

    def quadrature(self) -> tuple[FloatArray, FloatArray]:
        """Equal steps of the logarithm, exact to rounding once they are shorter than the density is wide.

        See `LevelLaw.quadrature`.

        Returns:
            Levels and weights, both of shape (nodes,).
        """
        for step in _STEPS:
            level = np.exp(np.arange(*_LOG_LEVELS, step))
            weight = self.density(level) * level * step
            total = weight.sum()
            if abs(total - 1.0) < _CONVERGED:
                break
        kept = weight > _NEGLIGIBLE
        return level[kept], weight[kept] / total


@dataclass(frozen=True, slots=True)
class AverageLevel(EstimatedLevel):
    """Mean of N cells (Finn and Johnson 1968): P_fa = (1 + T / N)^-N.

    Attributes:
        cells: N; a number that is not whole gives the gamma law of as many degrees.
    """

    cells: float

    @property
    def mean(self) -> float:
        """One."""
        return 1.0

    def log_exceedance(self, multiplier: npt.ArrayLike) -> FloatArray:
        """Of a gamma law; see `LevelLaw.log_exceedance`.

        Args:
            multiplier: T >= 0, any shape.

        Returns:
            Same shape.
        """
        return -self.cells * np.log1p(np.asarray(multiplier, dtype=float) / self.cells)

    def density(self, level: npt.ArrayLike) -> FloatArray:
        """Gamma; see `EstimatedLevel.density`.

        Args:
            level: positive, any shape.

        Returns:
            Same shape.
        """
        level = np.asarray(level, dtype=float)
        count = self.cells
        log = count * np.log(count) + (count - 1) * np.log(level) - count * level - gammaln(count)
        return np.exp(log)


@dataclass(frozen=True, slots=True)
class OrderedLevel(EstimatedLevel):
    """The k-th smallest of N cells (H. Rohling, IEEE Trans. AES 19, 1983): P_fa = prod_{i<k} (N - i) / (N - i + T).

    Attributes:
        cells: N.
        order: k, 1 for the smallest.
    """

    cells: int
    order: int

    @property
    def mean(self) -> float:
        """Sum of 1 / (N - i) for i < k."""
        return float((1.0 / self._left()).sum())

    def log_exceedance(self, multiplier: npt.ArrayLike) -> FloatArray:
        """The gaps between ordered exponential values are independent; see `LevelLaw.log_exceedance`.

        Args:
            multiplier: T >= 0, any shape.

        Returns:
            Same shape.
        """
        share = np.asarray(multiplier, dtype=float)[..., None] / self._left()
        return -np.log1p(share).sum(axis=-1)

    def density(self, level: npt.ArrayLike) -> FloatArray:
        """Of k - 1 smaller cells, N - k greater ones and one between; see `EstimatedLevel.density`.

        Args:
            level: positive, any shape.

        Returns:
            Same shape.
        """
        level = np.asarray(level, dtype=float)
        smaller, greater = self.order - 1, self.cells - self.order
        choices = gammaln(self.cells + 1) - gammaln(smaller + 1) - gammaln(greater + 1)
        log = choices + smaller * np.log(-np.expm1(-level)) - (greater + 1) * level
        return np.exp(log)

    def _left(self) -> FloatArray:
        """Cells that are not yet passed by, before each of the k gaps."""
        return self.cells - np.arange(self.order, dtype=float)
