# SPDX-License-Identifier: Apache-2.0
"""The prior of range cut into bins: a Gaussian density for each of them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from bearing_tracker.emitters.belief import Prior

FloatArray = npt.NDArray[np.float64]

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(12)
_TAIL = 3.0


class RangeBins(NamedTuple):
    """Bins of range.

    Attributes:
        probability: shape (n, B), of sum one.
        mean: metres, shape (n, B).
        std: metres, shape (n, B).
    """

    probability: FloatArray
    mean: FloatArray
    std: FloatArray


def range_bins(prior: Prior, bins: int) -> RangeBins:
    """Cut the prior at ranges of one ratio, so that every bin is equally wide against its distance.

    Source: Peach 1995, Bearings-only tracking using a set of range-parameterised extended Kalman filters.

    Args:
        prior: of n emitters.
        bins: number B of them.

    Returns:
        Probability, mean and standard deviation in each, of the density between the limits: Gaussian where the prior
        has a mean range, else uniform in the logarithm of range. A Gaussian one is cut at three deviations.
    """
    vague = np.isnan(prior.range_mean)
    mean = np.where(vague, prior.range_low, prior.range_mean)
    std = np.where(vague, prior.range_high - prior.range_low, prior.range_std)
    low = np.where(vague, prior.range_low, np.maximum(prior.range_low, mean - _TAIL * std))
    high = np.where(vague, prior.range_high, np.minimum(prior.range_high, mean + _TAIL * std))

    step = np.log(high / low) / bins
    middle = np.log(low)[:, np.newaxis] + step[:, np.newaxis] * (np.arange(bins) + 0.5)
    ranges = np.exp(middle[..., np.newaxis] + 0.5 * step[:, np.newaxis, np.newaxis] * _NODES)
    scaled = (ranges - mean[:, np.newaxis, np.newaxis]) / std[:, np.newaxis, np.newaxis]
    # Density by the logarithm of range: that of range times range.
    density = np.where(
        vague[:, np.newaxis, np.newaxis], 1.0, ranges * np.exp(-0.5 * np.square(scaled))
    )
    mass = density * _WEIGHTS
    total = mass.sum(axis=-1)
    bin_mean = (mass * ranges).sum(axis=-1) / total
    variance = (mass * (ranges - bin_mean[..., np.newaxis]) ** 2).sum(axis=-1) / total
    return RangeBins(total / total.sum(axis=-1, keepdims=True), bin_mean, np.sqrt(variance))


def whole_range(prior: Prior) -> RangeBins:
    """Mean and deviation of the whole prior, as one bin.

    Args:
        prior: of n emitters.

    Returns:
        One bin each.
    """
    return merged(range_bins(prior, 8))


def merged(bins: RangeBins) -> RangeBins:
    """Put all bins together.

    Args:
        bins: of n emitters.

    Returns:
        One bin each, with the moments of all.
    """
    mean = (bins.probability * bins.mean).sum(axis=-1, keepdims=True)
    spread = bins.std**2 + (bins.mean - mean) ** 2
    variance = (bins.probability * spread).sum(axis=-1, keepdims=True)
    return RangeBins(np.ones_like(mean), mean, np.sqrt(variance))
