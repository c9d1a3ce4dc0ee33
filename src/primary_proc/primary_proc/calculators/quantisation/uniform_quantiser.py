# SPDX-License-Identifier: Apache-2.0
"""The uniform quantiser: its moments, Sheppard's corrections and the widest step that leaves them right."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from scipy.optimize import brentq

from primary_proc.calculators.pulse.amplitude_laws import AmplitudeLaw
from primary_proc.calculators.pulse.gauss_rule import gauss_rule

FloatArray = npt.NDArray[np.float64]

_NODES = 400


def quantised(amplitude: npt.ArrayLike, step: float, offset: float = 0.0) -> FloatArray:
    """Put amplitudes into the middle of their intervals.

    Source: Kuzmin 1967, (2.14).

    Args:
        amplitude: any shape.
        step: h, distance of thresholds.
        offset: one of the thresholds.

    Returns:
        Same shape.
    """
    level = np.floor((np.asarray(amplitude, dtype=float) - offset) / step)
    return np.asarray(offset + (level + 0.5) * step)


def grouped_moments(law: AmplitudeLaw, step: float, offset: float = 0.0) -> tuple[float, float]:
    """Mean and variance of a quantised amplitude.

    Args:
        law: of the amplitude.
        step: h, distance of thresholds.
        offset: one of the thresholds.

    Returns:
        Mean and variance.
    """
    low, high = law.support
    first, last = np.floor((low - offset) / step), np.ceil((high - offset) / step)
    edges = offset + step * np.arange(first, last + 1.0)
    share = -np.diff(law.exceedance(edges))
    middle = (edges[:-1] + edges[1:]) / 2.0
    mean = float(share @ middle / share.sum())
    return mean, float(share @ np.square(middle - mean) / share.sum())


def sheppard_variance(grouped_variance: float, step: float) -> float:
    """Variance of an amplitude from that of its quantised values, which is larger.

    Source: Kuzmin 1967, (2.15): the mean needs no correction, the variance that of a uniform law.

    Args:
        grouped_variance: of the quantised values.
        step: h.

    Returns:
        Grouped variance less h^2 / 12.
    """
    return grouped_variance - step**2 / 12.0


def characteristic_function(
    law: AmplitudeLaw, frequency: npt.ArrayLike
) -> npt.NDArray[np.complex128]:
    """Spectrum of a density.

    Source: Kuzmin 1967, (2.16). For this variable f the inverse (2.17) has no factor 1 / 2 pi, which is printed there.

    Args:
        law: of the amplitude.
        frequency: f in cycles per unit of the amplitude, any shape.

    Returns:
        phi(f), complex, same shape.
    """
    amplitude, weight = gauss_rule(*law.support, _NODES)
    mass = law.density(amplitude) * weight
    turns = np.multiply.outer(np.asarray(frequency, dtype=float), amplitude)
    return np.asarray(np.sum(np.exp(-2j * np.pi * turns) * mass, axis=-1))


def widest_step(law: AmplitudeLaw, negligible: float) -> float:
    """Widest step at which a density is sampled finely enough to be recovered.

    Source: Kuzmin 1967, § 2.2.2, after B. Widrow: h = 1 / (2 f_max).

    Args:
        law: of the amplitude, whose spectrum falls steadily.
        negligible: size of the spectrum at f_max, in (0, 1).

    Returns:
        h.
    """

    def excess(frequency: float) -> float:
        return float(abs(characteristic_function(law, frequency))) - negligible

    return 0.5 / float(brentq(excess, 0.0, _NODES / 4.0 / (law.support[1] - law.support[0])))
