# SPDX-License-Identifier: Apache-2.0
"""How the noise level varies that is the greater of a clutter map's and of the mean of reference cells."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.special import gammainc, gammaincc, gammaincinv, logsumexp

from primary_proc.calculators.cfar.cfar_laws import LevelLaw

FloatArray = npt.NDArray[np.float64]

_NODES = 48


def map_false_alarm(multiplier: npt.ArrayLike, weights: npt.ArrayLike) -> FloatArray:
    """Probability that noise exceeds a multiple of a clutter map's level alone.

    Source: R. Nitzberg, Clutter map CFAR analysis, IEEE Trans. AES 22, 1986: P_fa = prod_l 1 / (1 + T w_l).

    Args:
        multiplier: T >= 0, any shape.
        weights: w_l of the independent samples of noise power in the level, shape (n,).

    Returns:
        Same shape as the multiplier.
    """
    share = np.asarray(multiplier, dtype=float)[..., None] * np.asarray(weights, dtype=float)
    return np.exp(-np.log1p(share).sum(axis=-1))


def map_variance(weight: float, samples: float, turns: float, first: float) -> float:
    """Variance of the map's level in noise, over its mean squared; the sum of the squares of the weights w_l.

    The level begins with the mean of independent samples around the cell and takes over the share `weight` of each
    turn's mean.

    Args:
        weight: of the latest turn, in (0, 1].
        samples: independent samples of the cell in a turn.
        turns: learned so far; infinite for a map that has settled.
        first: independent samples that the level began with.

    Returns:
        Variance; its inverse is the number of equally weighted samples that would do as well.
    """
    kept = (1.0 - weight) ** (2.0 * turns) if turns else 1.0
    return weight / (2.0 - weight) * (1.0 - kept) / samples + kept / first


@dataclass(frozen=True, slots=True)
class MapLevel(LevelLaw):
    """The greater of a map's level and of the mean of N reference cells.

    The map's level is a weighted sum of many samples. It is taken for a gamma variable of the same variance; against
    the product of Nitzberg (1986) this moves p_N by less than 1 % from four samples a turn and a weight of 0.2 on
    downwards.

    Attributes:
        cells: N.
        variance: of the map's level over its mean squared.
    """

    cells: int
    variance: float

    @property
    def mean(self) -> float:
        """By quadrature, above one."""
        level, weight = self.quadrature()
        return float(level @ weight)

    def log_exceedance(self, multiplier: npt.ArrayLike) -> FloatArray:
        """Closed for the reference cells, by quadrature over the map; see `LevelLaw.log_exceedance`.

        Args:
            multiplier: T >= 0, any shape.

        Returns:
            Same shape.
        """
        multiplier = np.asarray(multiplier, dtype=float)[..., None]
        known, weight = self._known()
        count = self.cells
        map_decides = np.log(gammainc(count, count * known)) - multiplier * known
        with np.errstate(divide="ignore"):
            still = np.log(gammaincc(count, (count + multiplier) * known))
        cells_decide = still - count * np.log1p(multiplier / count)
        return logsumexp(np.logaddexp(map_decides, cells_decide), b=weight, axis=-1)

    def quadrature(self) -> tuple[FloatArray, FloatArray]:
        """All pairs of nodes of both levels; see `LevelLaw.quadrature`.

        Returns:
            Levels and weights, both of shape (nodes,).
        """
        known, weight = self._known()
        share, other = _unit_nodes()
        mean = gammaincinv(self.cells, share) / self.cells
        return np.maximum.outer(known, mean).ravel(), np.outer(weight, other).ravel()

    def _known(self) -> tuple[FloatArray, FloatArray]:
        """Levels of the map and their weights."""
        share, weight = _unit_nodes()
        shape = 1.0 / self.variance
        return np.asarray(gammaincinv(shape, share) / shape), weight


def _unit_nodes() -> tuple[FloatArray, FloatArray]:
    node, weight = np.polynomial.legendre.leggauss(_NODES)
    return np.asarray(0.5 * (node + 1.0)), np.asarray(0.5 * weight)
