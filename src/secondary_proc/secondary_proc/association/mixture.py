# SPDX-License-Identifier: Apache-2.0
"""One plot that stands for several, each of which may be a track's own, and none perhaps.

Probabilistic data association moves a track by the weighted sum of its innovations (Bar-Shalom and Fortmann 1988,
§ 6.4). A Kalman filter does exactly that when it is given the mean of the plots with a covariance that grows with the
probability that none of them is right, so that no filter has to know of several plots. What the plots' scatter adds to
the covariance of the state afterwards is `scatter`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from secondary_proc.association.interface import FloatArray, IndexArray
from secondary_proc.motion import inverse_2x2

_LEAST = 1e-6


@dataclass(frozen=True, slots=True)
class Mixture:
    """Plots that stand for several, one row a track.

    Attributes:
        position: their mean, metres, shape (k, 2).
        covariance: of its error, m^2, shape (k, 2, 2).
        scatter: of the innovations about their weighted sum, m^2, shape (k, 2, 2).
        share: probability that one of the plots is right, shape (k,).
    """

    position: FloatArray
    covariance: FloatArray
    scatter: FloatArray
    share: FloatArray


def mix(
    row: IndexArray,
    probability: FloatArray,
    position: FloatArray,
    covariance: FloatArray,
    predicted: FloatArray,
    predicted_covariance: FloatArray,
) -> Mixture:
    """Mix the plots of each track.

    Args:
        row: of the track, 0 to k - 1, each at least once, shape (n,).
        probability: that the plot is the track's own, their sum at most one, shape (n,).
        position: of the plot, metres, shape (n, 2).
        covariance: of its error, m^2, shape (n, 2, 2).
        predicted: position of the track, metres, shape (k, 2).
        predicted_covariance: of its error, m^2, shape (k, 2, 2).

    Returns:
        One plot for each track.
    """
    count = len(predicted)
    share = np.clip(_sum(row, probability, count), _LEAST, 1.0)
    weight = probability / share[row]
    mean = _sum(row, weight[:, None] * position, count)
    error = _sum(row, weight[:, None, None] * covariance, count)
    apart = position - mean[row]
    between = _sum(row, weight[:, None, None] * _square(apart), count)
    each = share[:, None, None]
    innovation = mean - predicted
    return Mixture(
        position=mean,
        covariance=error + (1.0 - each) / each * (predicted_covariance + error),
        scatter=each * between + each * (1.0 - each) * _square(innovation),
        share=share,
    )


def scatter_of_state(covariance: FloatArray, mixture: Mixture) -> FloatArray:
    """What the disagreement of the innovations adds to a state's covariance.

    Args:
        covariance: of (x, y, vx, vy) after a Kalman filter took the mixture for a plot, shape (k, 4, 4).
        mixture: what it took.

    Returns:
        K S K' with the gain K that a plot surely the track's own would have had and the scatter S, shape (k, 4, 4).
    """
    inverse, _ = inverse_2x2(mixture.covariance)
    # A Kalman gain is P H' R^-1 with the covariance after the update.
    gain = covariance[:, :, :2] @ inverse / mixture.share[:, None, None]
    return gain @ mixture.scatter @ gain.transpose(0, 2, 1)


def _square(vector: FloatArray) -> FloatArray:
    return vector[:, :, None] * vector[:, None, :]


def _sum(row: IndexArray, values: FloatArray, count: int) -> FloatArray:
    out = np.zeros((count, *values.shape[1:]))
    np.add.at(out, row, values)
    return out
