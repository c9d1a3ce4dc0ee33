# SPDX-License-Identifier: Apache-2.0
"""Laws of one pulse's amplitude behind an envelope or a synchronous detector, in units of the noise's sigma."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.special import ive, ndtr

from primary_proc.calculators.pulse.single_pulse import fluctuating_probability, steady_probability

FloatArray = npt.NDArray[np.float64]

# Beyond nine sigma a normal law holds 1e-19, less than a sum of doubles can show.
_FARTHEST = 9.0


@dataclass(frozen=True, slots=True)
class AmplitudeLaw:
    """Distribution of an amplitude.

    Attributes:
        density: w(x), any shape to same shape.
        exceedance: probability of more than x, any shape to same shape.
        support: interval outside of which the probability is negligible.
    """

    density: Callable[[npt.ArrayLike], FloatArray]
    exceedance: Callable[[npt.ArrayLike], FloatArray]
    support: tuple[float, float]


def rice_density(amplitude: npt.ArrayLike, signal: npt.ArrayLike) -> FloatArray:
    """Density of the envelope of a steady signal in noise; of noise alone for a signal of zero.

    Source: Kuzmin 1967, (1.34), (1.35).

    Args:
        amplitude: x >= 0, any shape.
        signal: a, voltage of the target over the noise's sigma; broadcast with x.

    Returns:
        w(x | a), of the broadcast shape.
    """
    x, a = np.asarray(amplitude, dtype=float), np.asarray(signal, dtype=float)
    return np.asarray(x * np.exp(-np.square(x - a) / 2.0) * ive(0, a * x))


def rayleigh_density(amplitude: npt.ArrayLike, signal: npt.ArrayLike = 0.0) -> FloatArray:
    """Density of the envelope of a signal in noise that fluctuates from pulse to pulse.

    Source: Kuzmin 1967, (1.39) with k^2 the mean signal power over the mean noise power, and (1.35) for k = 0.

    Args:
        amplitude: x >= 0, any shape.
        signal: k, broadcast with x.

    Returns:
        w(x | k), of the broadcast shape.
    """
    x = np.asarray(amplitude, dtype=float)
    power = 1.0 + np.square(np.asarray(signal, dtype=float))
    return np.asarray(x / power * np.exp(-np.square(x) / (2.0 * power)))


def strong_signal_density(
    amplitude: npt.ArrayLike, signal: npt.ArrayLike, *, corrected: bool = True
) -> FloatArray:
    """Approximate density of the envelope of a strong steady signal: normal around a, times a slow factor.

    Source: Kuzmin 1967, (1.36).

    Args:
        amplitude: x > 0, any shape.
        signal: a > 0, broadcast with x.
        corrected: whether to keep the factor, which the book drops for a of 3 to 5 and more.

    Returns:
        w(x | a), of the broadcast shape.
    """
    x, a = np.asarray(amplitude, dtype=float), np.asarray(signal, dtype=float)
    normal = np.exp(-np.square(x - a) / 2.0) / np.sqrt(2.0 * np.pi)
    if not corrected:
        return np.asarray(normal)
    return np.asarray(normal * np.sqrt(x / a) * (1.0 + 1.0 / (8.0 * a * x)))


def envelope_law(signal: float) -> AmplitudeLaw:
    """Envelope of a steady signal in noise.

    Args:
        signal: a.

    Returns:
        Rice's law (1.34), Rayleigh's (1.35) for a = 0.
    """
    return AmplitudeLaw(
        lambda x: rice_density(x, signal),
        lambda x: steady_probability(np.maximum(x, 0.0), signal),
        (0.0, signal + _FARTHEST),
    )


def fluctuating_law(signal: float) -> AmplitudeLaw:
    """Envelope of a signal that fluctuates from pulse to pulse.

    Args:
        signal: k.

    Returns:
        Rayleigh's law with the power 1 + k^2 (1.39).
    """
    return AmplitudeLaw(
        lambda x: rayleigh_density(x, signal),
        lambda x: fluctuating_probability(np.maximum(x, 0.0), signal),
        (0.0, _FARTHEST * float(np.sqrt(1.0 + signal**2))),
    )


def synchronous_law(signal: float) -> AmplitudeLaw:
    """Voltage behind a synchronous detector, one quadrature in phase with the signal.

    Args:
        signal: a.

    Returns:
        The normal law with mean a and deviation one.
    """
    return AmplitudeLaw(
        lambda x: np.exp(-np.square(np.asarray(x) - signal) / 2.0) / np.sqrt(2.0 * np.pi),
        lambda x: ndtr(signal - np.asarray(x, dtype=float)),
        (signal - _FARTHEST, signal + _FARTHEST),
    )


PULSE_LAWS: dict[str, Callable[[float], AmplitudeLaw]] = {
    "envelope": envelope_law,
    "fluctuating": fluctuating_law,
    "synchronous": synchronous_law,
}
"""Laws of one pulse by name, each a function of the signal; a signal of zero is noise alone."""


def pulse_law(name: str, signal: float) -> AmplitudeLaw:
    """Find the law of one pulse.

    Args:
        name: one of PULSE_LAWS.
        signal: a for a steady signal, k for a fluctuating one; 0 for noise.

    Returns:
        The law.

    Raises:
        ValueError: there is no law of that name.
    """
    if name not in PULSE_LAWS:
        raise ValueError(f"pulse law {name!r} is none of {', '.join(PULSE_LAWS)}")
    return PULSE_LAWS[name](signal)
