# SPDX-License-Identifier: Apache-2.0
"""Least standard deviation of the azimuth that the amplitudes of a burst allow (Kuzmin 1967, § 1.4.3; P. Swerling).

All bounds are in units of phi, the half width that (1.27) counts N_0 pulses in.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from scipy.integrate import trapezoid
from scipy.special import i0e, i1e

from primary_proc.calculators.pulse.burst_slope import FloatArray, pattern_slope
from radar_common.antenna_pattern import PATTERNS

_NODES = 200
_SPREAD = 9.0
_FINE = 20001


def rice_information(amplitude: npt.ArrayLike) -> FloatArray:
    """Fisher information of one envelope about its amplitude: mean of (x I_1(ax) / I_0(ax) - a)^2 under (1.34).

    Args:
        amplitude: a, any shape.

    Returns:
        Between 0 and 1, which is that of the Gaussian form (1.69), same shape.
    """
    a = np.asarray(amplitude, dtype=float)[..., None]
    node, weight = np.polynomial.legendre.leggauss(_NODES)
    low, high = np.maximum(a - _SPREAD, 0.0), a + _SPREAD
    x = low + (high - low) * (node + 1.0) / 2.0
    density = x * np.exp(-0.5 * (x - a) ** 2) * i0e(a * x)
    score = x * i1e(a * x) / i0e(a * x) - a
    return (density * score**2) @ weight * (high - low)[..., 0] / 2.0


def unquantised_bound(
    pattern: str,
    pulses: float,
    strength: npt.ArrayLike,
    fluctuation: str = "steady",
    *,
    model: str = "exact",
) -> FloatArray:
    """Cramér-Rao bound from the amplitudes of all pulses that the pattern covers, one of them at the axis.

    Source: Kuzmin 1967, (1.68) with the Rice law for "exact" and its Gaussian form (1.69)-(1.70) for "gaussian"; (1.40)
    for fast targets, where both are the same.

    Args:
        pattern: antenna pattern's name.
        pulses: N_0.
        strength: a_0 of a steady target, k_0 of a fast one, shape (...).
        fluctuation: "steady" or "fast".
        model: "exact" or "gaussian".

    Returns:
        Standard deviation in phi, shape (...).

    Raises:
        ValueError: a name is unknown.
    """
    if fluctuation not in ("steady", "fast") or model not in ("exact", "gaussian"):
        raise ValueError(f"no bound for a {fluctuation} target in the {model} model")
    reach = np.floor(PATTERNS[pattern].extent * pulses / 2.0)
    alpha = np.arange(-reach, reach + 1.0) / (pulses / 2.0)
    peak = np.asarray(strength, dtype=float)[..., None]
    slope = peak * pattern_slope(pattern, alpha)
    amplitude = peak * PATTERNS[pattern](alpha)
    if fluctuation == "fast":
        # The power 1 + k^2 of a Rayleigh envelope has the information (1 + k^2)^-2.
        information = (2.0 * amplitude * slope / (1.0 + amplitude**2)) ** 2
    else:
        information = slope**2
        if model == "exact":
            information = information * rice_information(amplitude)
    return np.asarray(1.0 / np.sqrt(information.sum(axis=-1)))


def swerling_bound(
    pattern: str,
    pulses: float,
    strength: npt.ArrayLike,
    fluctuation: str = "steady",
    *,
    printed: bool = False,
) -> FloatArray:
    """Bound of many pulses in a beam, as an integral over the pattern.

    Source: Kuzmin 1967, (1.76) for steady and (1.77) for fast targets, after P. Swerling. They hold if g stands for the
    power pattern, a_0^2 for the power ratio S_0^2 / 2 sigma^2, and k_0 for the power ratio k_0^2 of (1.39).

    Args:
        pattern: antenna pattern's name, an amplitude pattern as everywhere.
        pulses: N_0.
        strength: a_0 or k_0, shape (...).
        fluctuation: "steady" or "fast".
        printed: whether to take the formula literally, a_0 and k_0 being the book's amplitude ratios; only the power
            pattern is put in its place.

    Returns:
        Standard deviation in phi, shape (...).

    Raises:
        ValueError: the fluctuation is neither.
    """
    alpha = np.linspace(-1.0, 1.0, _FINE) * PATTERNS[pattern].extent
    g, slope = PATTERNS[pattern](alpha), pattern_slope(pattern, alpha)
    peak = np.asarray(strength, dtype=float)
    if fluctuation == "steady":
        # With g_P = g^2 the integrand g_P'^2 / g_P is 4 g'^2.
        integral = trapezoid(4.0 * slope**2, alpha)
        ratio = peak if printed else peak / np.sqrt(2.0)
        return np.asarray(2.0 / (np.sqrt(pulses) * ratio * np.sqrt(integral)))
    if fluctuation != "fast":
        raise ValueError(f"fluctuation {fluctuation!r} is neither steady nor fast")
    ratio = (peak if printed else peak**2)[..., None]
    power_slope = 2.0 * g * slope
    integral = trapezoid(0.5 * (power_slope / (1.0 + ratio * g**2)) ** 2, alpha, axis=-1)
    return np.asarray(1.0 / (ratio[..., 0] * np.sqrt(pulses * integral)))
