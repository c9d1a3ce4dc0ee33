# SPDX-License-Identifier: Apache-2.0
"""Laws of clutter as compound Gaussian: complex normal speckle times the root of a slowly varying texture.

Each law is the quantile function of its texture tau, of mean one, in terms of a standard normal variable: a correlated
normal field goes in, a correlated texture with exactly this distribution comes out.

    rayleigh    tau = 1
    k           tau gamma distributed with shape v; the envelope is K distributed (Jakeman and Pusey 1976; Ward 1981)
    weibull     1 / tau positive stable with index c / 2. Its Laplace transform exp(-s^(c/2)) is the mean of
                exp(-s / tau), which is the probability that an exponential power times tau exceeds s: the envelope is
                Weibull distributed with shape c <= 2.
"""

from __future__ import annotations

import math

import numpy as np
from scipy.special import gammainccinv, gammaincinv, ndtr, ndtri

from radar_common.frames import FloatArray

LAWS = ("rayleigh", "k", "weibull")

_NODES = 2000
_LEVELS = 300
_TAIL = 1e-9
_LARGEST_EXPONENT = 700.0


def texture_quantile(law: str, shape: float, normal: FloatArray) -> FloatArray:
    """Texture at quantiles given as values of a standard normal variable.

    Args:
        law: one of LAWS.
        shape: v of the K law, c of the Weibull law (2 is Rayleigh).
        normal: standard normal values, shape (n,).

    Returns:
        tau, of mean one over the distribution, shape (n,).
    """
    if law == "rayleigh" or (law == "weibull" and shape >= 2.0):
        return np.ones_like(normal)
    if law == "k":
        # Each tail from its own side: 1 - p has no digits left far out.
        upper = gammainccinv(shape, ndtr(-np.maximum(normal, 0.0)))
        lower = gammaincinv(shape, ndtr(np.minimum(normal, 0.0)))
        return np.asarray(np.where(normal > 0.0, upper, lower) / shape)
    return _weibull_texture(shape / 2.0, normal)


def _weibull_texture(index: float, normal: FloatArray) -> FloatArray:
    """Invert the distribution of 1 / S, S positive stable.

    With U uniform on (0, pi) and W exponential, S = (A(U) / W)^((1 - a) / a) (Kanter 1975), so that
    P(1 / S <= t) is one less the mean of exp(-A(U) t^(a / (1 - a))) over U.
    """
    # A grows without bound towards pi, where small textures come from: nodes are dense there.
    node = (np.arange(_NODES) + 0.5) / _NODES
    angle = np.pi * (1.0 - node**3)
    weight = 3.0 * np.square(node) / _NODES
    power = index / (1.0 - index)
    log_a = (
        np.log(np.sin((1.0 - index) * angle))
        + power * np.log(np.sin(index * angle))
        - (1.0 + power) * np.log(np.sin(np.pi * node**3))
    )
    smallest = math.log(1.0 - index) + power * math.log(index)
    # The law's lower tail is t^a / Gamma(1 - a); its upper one ends where even the smallest A leaves nothing.
    lowest = math.log(_TAIL * math.gamma(1.0 - index)) / index
    highest = (math.log(-2.0 * math.log(_TAIL)) - smallest) / power
    level = np.unique(
        [
            np.linspace(lowest, highest, _LEVELS),
            highest - np.geomspace(1e-3, highest - lowest, _LEVELS),
        ]
    )
    below, above = np.empty_like(level), np.empty_like(level)
    for place, log_texture in enumerate(level):
        exponent = np.exp(np.minimum(log_a + power * log_texture, _LARGEST_EXPONENT))
        below[place] = weight @ -np.expm1(-exponent)
        above[place] = weight @ np.exp(-exponent)
    known = np.where(below < 0.5, ndtri(np.minimum(below, 0.5)), -ndtri(np.minimum(above, 0.5)))
    rising = np.isfinite(known) & (np.diff(known, prepend=-np.inf) > 0.0)
    return np.exp(np.interp(normal, known[rising], level[rising])) / math.gamma(1.0 + 1.0 / index)
