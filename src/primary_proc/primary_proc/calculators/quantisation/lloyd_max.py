# SPDX-License-Identifier: Apache-2.0
"""The quantiser of least mean squared error for an amplitude of any law, found by shooting on its first level."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.interpolate import CubicHermiteSpline
from scipy.optimize import brentq

FloatArray = npt.NDArray[np.float64]

MOST_LEVELS = 64

_PANELS = 4096
_PRECISION = 1e-14


@dataclass(frozen=True, slots=True)
class Levels:
    """A quantiser.

    Attributes:
        thresholds: U_1 < ... < U_m, shape (m,).
        outputs: value that stands for each of the m + 1 levels, shape (m + 1,).
        distortion: mean squared difference between amplitude and output.
    """

    thresholds: FloatArray
    outputs: FloatArray
    distortion: float


class PartialMoments:
    """Integrals of w(x), x w(x) and x^2 w(x) from the lower end of the support, the whole probability being one."""

    def __init__(
        self, density: Callable[[FloatArray], FloatArray], support: tuple[float, float]
    ) -> None:
        """Tabulate.

        Args:
            density: w, vectorised; need not be normalised.
            support: finite interval that holds all of the probability.
        """
        node, weight = np.polynomial.legendre.leggauss(4)
        edge = np.linspace(*support, _PANELS + 1)
        half = (edge[1] - edge[0]) / 2.0
        inner = edge[:-1, None] + half * (1.0 + node)
        mass, total = density(inner) * weight * half, 0.0
        values, slopes = [], []
        for power in range(3):
            value = np.append(0.0, np.cumsum(np.sum(mass * inner**power, axis=1)))
            total = total or float(value[-1])
            values.append(value / total)
            slopes.append(density(edge) * edge**power / total)
        # Value and slope are both exact at the edges, so the error between them falls with the fourth power.
        self._integral = CubicHermiteSpline(edge, np.transpose(values), np.transpose(slopes))

    def between(self, low: npt.ArrayLike, high: npt.ArrayLike) -> FloatArray:
        """Integrate over intervals.

        Args:
            low: lower ends, any shape, within the support.
            high: upper ends, same shape.

        Returns:
            Integrals of w, x w, x^2 w, shape (*shape, 3).
        """
        high, low = np.asarray(high, dtype=float), np.asarray(low, dtype=float)
        return np.subtract(self._integral(high), self._integral(low))


def lloyd_max(
    density: Callable[[FloatArray], FloatArray], support: tuple[float, float], levels: int
) -> Levels:
    """Find the quantiser of least mean squared error.

    A guess of the first output gives the first threshold by (2.13), that the second output by (2.12), and so on; the
    guess is right when the last output is the centroid of the last interval.

    Source: Kuzmin 1967, (2.8)-(2.13), after J. Max, IRE Trans. IT-6, 1960.

    Args:
        density: w of the amplitude, vectorised; need not be normalised.
        support: finite interval that holds all of the probability.
        levels: number of levels m + 1.

    Returns:
        The quantiser.

    Raises:
        ValueError: the number of levels is not in [1, 64].
    """
    if not 1 <= levels <= MOST_LEVELS:
        raise ValueError(f"levels must be in [1, {MOST_LEVELS}], got {levels}")
    moments = PartialMoments(density, support)
    low, high = support

    def excess(first: float) -> float:
        return _shoot(moments, support, first, levels)[1]

    mean = float(moments.between(low, high)[1])
    first = mean
    if levels > 1:
        first = float(brentq(excess, low, mean, xtol=_PRECISION, rtol=4.0 * _PRECISION))
    thresholds = _shoot(moments, support, first, levels)[0]
    return centroids(moments, support, thresholds)


def centroids(
    moments: PartialMoments, support: tuple[float, float], thresholds: npt.ArrayLike
) -> Levels:
    """Give the levels between thresholds the outputs of least mean squared error, (2.11).

    Args:
        moments: of the amplitude.
        support: of the amplitude.
        thresholds: increasing, within the support, shape (m,).

    Returns:
        The quantiser.
    """
    inner = np.asarray(thresholds, dtype=float)
    edges = np.concatenate([[support[0]], inner, [support[1]]])
    mass, first, second = moments.between(edges[:-1], edges[1:]).T
    outputs = first / mass
    return Levels(inner, outputs, float(np.sum(second - outputs * first)))


def _shoot(
    moments: PartialMoments, support: tuple[float, float], first: float, levels: int
) -> tuple[FloatArray, float]:
    """Thresholds that follow from the first output, and the excess of the last interval's moment about its output."""
    low, high = support
    output, thresholds = first, np.empty(levels - 1)
    for number in range(levels - 1):
        if output >= high or _about(moments, output, low, high) <= 0.0:
            # Already this interval reaches beyond the support: the first output was too large.
            return thresholds, -1.0
        end = brentq(
            lambda end, output=output, low=low: _about(moments, output, low, end),
            output,
            high,
            xtol=_PRECISION,
            rtol=4.0 * _PRECISION,
        )
        thresholds[number] = low = float(end)
        output = 2.0 * low - output
    return thresholds, _about(moments, output, low, high)


def _about(moments: PartialMoments, output: float, low: float, high: float) -> float:
    """Integral of (U - U') w over an interval, (2.13)."""
    mass, moment, _ = moments.between(low, high)
    return float(moment - output * mass)
