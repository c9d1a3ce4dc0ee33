# SPDX-License-Identifier: Apache-2.0
"""Least standard deviation of the azimuth that the bits of a burst allow (Kuzmin 1967, § 3.1.5).

All bounds are in azimuth steps. "kuzmin" gives the book's working formulas, misprints corrected; "exact" evaluates
(3.25) with the true derivative of the pattern.
"""

from __future__ import annotations

import itertools
import math

import numpy as np
import numpy.typing as npt
from scipy.special import ive

from primary_proc.calculators.pulse.burst_shape import burst_shape
from primary_proc.calculators.pulse.burst_slope import FloatArray, ones_and_slopes, pattern_slope
from primary_proc.calculators.pulse.single_pulse import fluctuating_probability

_MOST_ENUMERATED = 16


def bound_of_bits(
    probability: npt.ArrayLike, slope: npt.ArrayLike, zero: npt.ArrayLike | None = None
) -> FloatArray:
    """Cramér-Rao bound from independent bits.

    Source: Kuzmin 1967, (3.25).

    Args:
        probability: of a one on each position, shape (..., positions).
        slope: its derivative by the parameter, same shape.
        zero: of a zero, where it is known more finely than as one less the probability; same shape.

    Returns:
        Standard deviation in units of the parameter, shape (...); infinite where the bits tell nothing.
    """
    one = np.asarray(probability, dtype=float)
    square = np.square(slope)
    product = one * (1.0 - one if zero is None else np.asarray(zero))
    information = np.divide(square, product, out=np.zeros_like(square), where=product > 0.0)
    with np.errstate(divide="ignore"):
        return np.asarray(1.0 / np.sqrt(information.sum(axis=-1)))


def bound_by_enumeration(probability: npt.ArrayLike, slope: npt.ArrayLike) -> float:
    """The same bound from its definition, over all 2^N sequences of bits.

    Source: Kuzmin 1967, (3.24).

    Args:
        probability: of a one on each position, shape (positions,).
        slope: its derivative by the parameter, same shape.

    Returns:
        Standard deviation in units of the parameter.

    Raises:
        ValueError: more than 16 positions.
    """
    one, change = np.asarray(probability, dtype=float), np.asarray(slope, dtype=float)
    if len(one) > _MOST_ENUMERATED:
        raise ValueError(f"{len(one)} positions have too many sequences, at most 16 are enumerated")
    bits = np.array(list(itertools.product((0.0, 1.0), repeat=len(one))))
    chance = np.where(bits == 1.0, one, 1.0 - one).prod(axis=1)
    score = np.where(bits == 1.0, change / one, -change / (1.0 - one)).sum(axis=1)
    return float(1.0 / np.sqrt(chance @ score**2))


def quantised_bound(
    pattern: str,
    pulses: float,
    threshold: float,
    strength: npt.ArrayLike,
    fluctuation: str = "steady",
    *,
    offset: float = 0.0,
    model: str = "exact",
    book: bool = True,
) -> FloatArray:
    """Bound of a binary-quantised burst.

    Source: Kuzmin 1967, (3.25) for "exact"; (3.31), (3.32) with the factor 2 before the sum, and (3.35) for "kuzmin".

    Args:
        pattern: antenna pattern's name.
        pulses: N_0; "kuzmin" wants it odd.
        threshold: x_0 in units of the noise's sigma.
        strength: a_0 of a steady target, k_0 of a fast one, shape (...).
        fluctuation: "steady" or "fast".
        offset: displacement of the target from the middle position, in steps; for "exact" only.
        model: "exact" or "kuzmin".
        book: whether to take the N_0 positions of the book; otherwise as many as hold the whole pattern, which strong
            targets need. For "exact" only.

    Returns:
        Standard deviation in steps, shape (...).

    Raises:
        ValueError: a name is unknown, or the book has no form for the combination.
    """
    strength = np.asarray(strength, dtype=float)
    if model == "kuzmin":
        return _kuzmin_bound(pattern, pulses, threshold, strength, fluctuation)
    if model != "exact":
        raise ValueError(f"model {model!r} is neither exact nor kuzmin")
    shape = burst_shape(pattern, pulses, offset, book=book)
    half = pulses / 2.0
    alpha = (np.arange(len(shape)) - (len(shape) - 1) / 2.0 - offset) / half
    slope = -pattern_slope(pattern, alpha) / half
    bits = ones_and_slopes(threshold, strength[..., None], shape, slope, fluctuation)
    return bound_of_bits(bits.probability, bits.slope, bits.zero)


def _kuzmin_bound(
    pattern: str, pulses: float, threshold: float, strength: FloatArray, fluctuation: str
) -> FloatArray:
    """Working formulas with alpha = lambda / phi; the sinc^2 pattern by dg/d alpha = -(2 pi^2 / 3) alpha g."""
    slope = {"gaussian": 2.0, "sinc2": 2.0 * math.pi**2 / 3.0}
    known = (pattern, fluctuation) in {(p, "steady") for p in slope} | {("sinc2", "fast")}
    if not known or pulses % 2 != 1:
        raise ValueError(
            f"the book has no form for {pulses:g} pulses of {fluctuation} targets in a {pattern} beam"
        )
    half = pulses / 2.0
    position = np.arange(pulses) - (pulses - 1) / 2.0
    g = burst_shape(pattern, pulses)
    amplitude = strength[..., None] * g
    if fluctuation == "steady":
        bits = ones_and_slopes(threshold, strength[..., None], g, np.zeros_like(g))
        # The factor exp(x0^2 / 2) before the root is taken under the sum, where it keeps everything finite.
        bell = np.exp(-((threshold - amplitude) ** 2)) * ive(1, amplitude * threshold) ** 2
        terms = bell * position**2 * g**2 / (bits.probability * bits.zero)
        return half**2 / (slope[pattern] * threshold * strength) / np.sqrt(terms.sum(axis=-1))
    one = fluctuating_probability(threshold, amplitude)
    terms = one / (1.0 - one) * position**2 * g**4 / (1.0 + amplitude**2) ** 4
    return half**2 / (slope[pattern] * threshold**2 * strength**2) / np.sqrt(terms.sum(axis=-1))
