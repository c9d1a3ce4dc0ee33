# SPDX-License-Identifier: Apache-2.0
"""Threshold of binary quantisation: by a probability in noise, by the average risk, or by the information kept."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from scipy.optimize import brentq, minimize_scalar
from scipy.special import i0e, ndtri, xlogy

from primary_proc.calculators.pulse.amplitude_laws import pulse_law
from primary_proc.calculators.pulse.gauss_rule import gauss_rule
from primary_proc.calculators.pulse.single_pulse import threshold_for

FloatArray = npt.NDArray[np.float64]

_GRID = 401
_NODES = 200
_BITS = 1.0 / np.log(2.0)


def neyman_pearson_threshold(noise_probability: npt.ArrayLike, law: str = "envelope") -> FloatArray:
    """Threshold that noise exceeds with a given probability.

    Source: Kuzmin 1967, (2.36); the normal law's quantile for a synchronous detector.

    Args:
        noise_probability: p_N in (0, 1), any shape.
        law: one of `amplitude_laws.PULSE_LAWS`.

    Returns:
        x_0 in units of the noise's sigma, same shape.

    Raises:
        ValueError: there is no law of that name.
    """
    pulse_law(law, 0.0)
    if law == "synchronous":
        return np.asarray(-ndtri(np.asarray(noise_probability, dtype=float)))
    return threshold_for(noise_probability)


def average_risk(
    threshold: npt.ArrayLike,
    signal: float,
    *,
    law: str = "envelope",
    prior: float = 0.5,
    miss_cost: float = 1.0,
    false_cost: float = 1.0,
) -> FloatArray:
    """Mean cost of deciding on one pulse by a threshold.

    Source: Kuzmin 1967, (2.33) with the probabilities of (1.45), two of which are lost in print.

    Args:
        threshold: x_0, any shape.
        signal: a, or k for the law "fluctuating".
        law: one of `amplitude_laws.PULSE_LAWS`.
        prior: probability P_S that there is a signal.
        miss_cost: C_1.
        false_cost: C_2, of a false detection.

    Returns:
        R, same shape.

    Raises:
        ValueError: there is no law of that name.
    """
    found = pulse_law(law, signal).exceedance(threshold)
    false = pulse_law(law, 0.0).exceedance(threshold)
    return np.asarray(miss_cost * prior * (1.0 - found) + false_cost * (1.0 - prior) * false)


def least_risk_threshold(
    signal: float,
    *,
    law: str = "envelope",
    prior: float = 0.5,
    miss_cost: float = 1.0,
    false_cost: float = 1.0,
) -> float:
    """Threshold of the least average risk: where both densities, weighed with costs and priors, are equal.

    Source: Kuzmin 1967, (2.34) and (2.35), for any costs and priors by (1.47)-(1.48).

    Args:
        signal: a > 0, or k for the law "fluctuating".
        law: one of `amplitude_laws.PULSE_LAWS`.
        prior: probability P_S in (0, 1) that there is a signal.
        miss_cost: C_1 > 0.
        false_cost: C_2 > 0, of a false detection.

    Returns:
        x_0; zero for an envelope where deciding for a signal is always best.

    Raises:
        ValueError: there is no law of that name, or a value is out of its range.
    """
    pulse_law(law, signal)
    if not (signal > 0.0 and 0.0 < prior < 1.0 and miss_cost > 0.0 and false_cost > 0.0):
        raise ValueError("signal and costs must be positive, the prior between 0 and 1")
    odds = float(np.log((1.0 - prior) * false_cost / (prior * miss_cost)))
    if law == "synchronous":
        return signal / 2.0 + odds / signal
    if law == "fluctuating":
        power = signal**2
        square = 2.0 * (1.0 + power) / power * (odds + np.log1p(power))
        return float(np.sqrt(max(square, 0.0)))
    wanted = odds + signal**2 / 2.0
    if wanted <= 0.0:
        return 0.0

    def excess(x: float) -> float:
        return float(signal * x + np.log(i0e(signal * x))) - wanted

    # ln I_0(z) lies between z - ln(1 + z) and z^2 / 4, so the root lies within these.
    return float(brentq(excess, 0.0, (2.0 * wanted + 3.0) / signal, xtol=1e-12))


def information(
    threshold: npt.ArrayLike, signal: float, *, law: str = "envelope", prior: float = 0.5
) -> FloatArray:
    """Information about the presence of a signal that one binary sample carries.

    Source: Kuzmin 1967, (2.28)-(2.30).

    Args:
        threshold: x_0, any shape.
        signal: a, or k for the law "fluctuating".
        law: one of `amplitude_laws.PULSE_LAWS`.
        prior: probability P_S that there is a signal.

    Returns:
        Bits, same shape.

    Raises:
        ValueError: there is no law of that name.
    """
    found = pulse_law(law, signal).exceedance(threshold)
    false = pulse_law(law, 0.0).exceedance(threshold)
    one = prior * found + (1.0 - prior) * false
    spread = _entropy(one) - prior * _entropy(found) - (1.0 - prior) * _entropy(false)
    return np.asarray(spread * _BITS)


def most_information_threshold(
    signal: float, *, law: str = "envelope", prior: float = 0.5
) -> float:
    """Threshold at which a binary sample carries the most information.

    Source: Kuzmin 1967, (2.31)-(2.32); the maximum itself is sought, not the root of its slope.

    Args:
        signal: a > 0, or k for the law "fluctuating".
        law: one of `amplitude_laws.PULSE_LAWS`.
        prior: probability P_S in (0, 1) that there is a signal.

    Returns:
        x_0.

    Raises:
        ValueError: there is no law of that name, or a value is out of its range.
    """
    if not (signal > 0.0 and 0.0 < prior < 1.0):
        raise ValueError("the signal must be positive, the prior between 0 and 1")
    with_signal, noise = pulse_law(law, signal), pulse_law(law, 0.0)
    grid = np.linspace(noise.support[0], with_signal.support[1], _GRID)
    best = int(np.argmax(information(grid, signal, law=law, prior=prior)))

    around = (grid[max(best - 1, 0)], grid[min(best + 1, _GRID - 1)])

    def lost(threshold: float) -> float:
        return -float(information(threshold, signal, law=law, prior=prior))

    # The root of the slope (2.32) would be sharper, but it is everywhere where one bit tells a strong signal surely.
    return float(minimize_scalar(lost, bounds=around, method="bounded", options={"xatol": 1e-9}).x)


def whole_information(signal: float, *, law: str = "envelope", prior: float = 0.5) -> float:
    """Information about the presence of a signal that one unquantised sample carries.

    Args:
        signal: a, or k for the law "fluctuating".
        law: one of `amplitude_laws.PULSE_LAWS`.
        prior: probability P_S that there is a signal.

    Returns:
        Bits.

    Raises:
        ValueError: there is no law of that name.
    """
    with_signal, noise = pulse_law(law, signal), pulse_law(law, 0.0)
    x, weight = gauss_rule(noise.support[0], with_signal.support[1], _NODES)
    one, other = with_signal.density(x), noise.density(x)
    both = prior * one + (1.0 - prior) * other
    each = prior * xlogy(one, one) + (1.0 - prior) * xlogy(other, other) - xlogy(both, both)
    return float(np.sum(each * weight) * _BITS)


def information_kept(signal: float, *, law: str = "envelope", prior: float = 0.5) -> float:
    """Share of the information of a sample that is left by the best binary quantisation.

    Source: Kuzmin 1967, § 2.3.4, who has it near one from a = 2 on.

    Args:
        signal: a > 0, or k for the law "fluctuating".
        law: one of `amplitude_laws.PULSE_LAWS`.
        prior: probability P_S in (0, 1) that there is a signal.

    Returns:
        Share.

    Raises:
        ValueError: there is no law of that name, or a value is out of its range.
    """
    best = most_information_threshold(signal, law=law, prior=prior)
    kept = information(best, signal, law=law, prior=prior)
    return float(kept) / whole_information(signal, law=law, prior=prior)


def _entropy(probability: FloatArray) -> FloatArray:
    rest = 1.0 - probability
    return np.asarray(-xlogy(probability, probability) - xlogy(rest, rest))
