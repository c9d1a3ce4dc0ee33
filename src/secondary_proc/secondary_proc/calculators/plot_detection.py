# SPDX-License-Identifier: Apache-2.0
"""Probability of a plot against range, for a burst that is summed behind a square-law detector.

Source: Kuzmin 1967, § 4.3.5, (4.29)-(4.34). Range d is over the range at which the ratio of (4.29) is one; the power
of a pulse over the mean noise power is kappa / d^4. The book's three formulas imply three different kappa (1/4, 1/2
and 1), so it is an argument here.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from scipy.stats import chi2, ncx2, norm

from secondary_proc.calculators.rule_chain import FloatArray

TARGETS = ("steady", "fast")


def farthest_range(
    power: float, gain: float, wavelength: float, area: float, sensitivity: float
) -> float:
    """Range at which the power received equals the receiver's sensitivity.

    Source: (4.29), with the (4 pi)^3 of the radar equation.

    Args:
        power: of the pulse, watts.
        gain: of the antenna, not in decibels.
        wavelength: metres.
        area: radar cross-section of the target, square metres.
        sensitivity: power received that the ratio is one at, watts.

    Returns:
        Metres.
    """
    return float(
        (power * gain**2 * wavelength**2 * area / ((4 * np.pi) ** 3 * sensitivity)) ** 0.25
    )


def burst_threshold(false_alarm: float, pulses: int) -> float:
    """Threshold x_0 of the root of the sum of squared envelopes.

    Source: (4.30), inverted.

    Args:
        false_alarm: probability P_fa.
        pulses: N_0.

    Returns:
        x_0 in units of the noise's sigma.
    """
    return float(np.sqrt(chi2.isf(false_alarm, 2 * pulses)))


def plot_detection(
    distance: npt.ArrayLike,
    pulses: int,
    false_alarm: float,
    target: str = "steady",
    ratio: float = 0.5,
) -> FloatArray:
    """Probability of a plot, exact.

    Source: (4.31) and (4.32) without their approximations; (4.34).

    Args:
        distance: d over the farthest range, positive, any shape.
        pulses: N_0.
        false_alarm: probability P_fa of a plot in noise.
        target: "steady", or "fast" for an envelope that fluctuates from pulse to pulse.
        ratio: kappa, mean power of a pulse over that of the noise at d = 1.

    Returns:
        Probability, same shape.

    Raises:
        ValueError: there is no such target.
    """
    squared = burst_threshold(false_alarm, pulses) ** 2
    power = ratio / np.asarray(distance, dtype=float) ** 4
    if target == "steady":
        return np.asarray(ncx2.sf(squared, 2 * pulses, 2 * pulses * power))
    if target == "fast":
        return np.asarray(chi2.sf(squared / (1.0 + power), 2 * pulses))
    raise ValueError(f"no target {target!r}; there are {', '.join(TARGETS)}")


def strong_signal_detection(
    distance: npt.ArrayLike, pulses: int, false_alarm: float, ratio: float = 0.5
) -> FloatArray:
    """Probability for a steady target by the normal law of the root, good for few pulses.

    Source: (4.31), (4.33a).

    Args:
        distance: d, any shape.
        pulses: N_0.
        false_alarm: probability P_fa.
        ratio: kappa.

    Returns:
        Probability, same shape.
    """
    amplitude = np.sqrt(2 * pulses * ratio) / np.asarray(distance, dtype=float) ** 2
    shift = (2 * pulses - 1) / (2 * amplitude)
    return np.asarray(norm.sf(burst_threshold(false_alarm, pulses) - amplitude - shift))


def many_pulse_detection(
    distance: npt.ArrayLike, pulses: int, false_alarm: float, ratio: float = 0.5
) -> FloatArray:
    """Probability for a steady target by the normal law of the sum, good for many pulses.

    Source: (4.32), (4.33b) with x_0^2 / 2 where x_0 is printed.

    Args:
        distance: d, any shape.
        pulses: N_0.
        false_alarm: probability P_fa.
        ratio: kappa.

    Returns:
        Probability, same shape.
    """
    power = ratio / np.asarray(distance, dtype=float) ** 4
    half = burst_threshold(false_alarm, pulses) ** 2 / 2.0
    return np.asarray(
        norm.sf((half - pulses * (1.0 + power)) / np.sqrt(pulses * (1.0 + 2.0 * power)))
    )
