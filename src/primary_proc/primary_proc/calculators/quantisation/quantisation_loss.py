# SPDX-License-Identifier: Apache-2.0
"""What quantisation of the envelope costs in signal-to-noise ratio, against a detector that sums powers unquantised."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from scipy.optimize import brentq
from scipy.stats import binom, chi2, ncx2

from primary_proc.calculators.pulse.single_pulse import steady_probability, threshold_for

FloatArray = npt.NDArray[np.float64]

_LARGEST_AMPLITUDE = 30.0


def weak_signal_loss_db(thresholds: npt.ArrayLike) -> float:
    """Loss of a quantiser for weak signals and many pulses, every level having its best weight.

    A weak signal's likelihood ratio is made of the power u = x^2 / 2, exponential in noise. Of the variance of u, which
    is one, a quantiser keeps the part between its levels; the ratio needed grows with the root of what is lost.

    Source: S. A. Kassam, IEEE Trans. COM-25, 1977; 0.94 dB for one threshold is the gain that Kuzmin 1967, § 2.3.4,
    gives as "not over 1 dB".

    Args:
        thresholds: increasing, in units of the noise's sigma, shape (m,).

    Returns:
        dB of signal-to-noise ratio.
    """
    power = np.square(np.asarray(thresholds, dtype=float)) / 2.0
    edge = np.concatenate([[0.0], power, [np.inf]])
    above = np.exp(-edge)
    # Beyond t, u has the mean 1 + t: the integral of (u - 1) exp(-u) is t exp(-t), which vanishes at both ends.
    score = np.concatenate([[0.0], power * np.exp(-power), [0.0]])
    kept = np.sum(np.square(np.diff(score)) / -np.diff(above))
    return float(-5.0 * np.log10(kept))


def power_sum_amplitude(pulses: int, false_alarm: float, detection: float) -> float:
    """Amplitude that a sum of unquantised powers of equal pulses needs.

    Args:
        pulses: N.
        false_alarm: probability in noise.
        detection: probability wanted, over false_alarm.

    Returns:
        a of a steady target.
    """
    level = chi2.isf(false_alarm, 2 * pulses)

    def excess(amplitude: float) -> float:
        return float(ncx2.sf(level, 2 * pulses, pulses * amplitude**2)) - detection

    return float(brentq(excess, 1e-3, _LARGEST_AMPLITUDE))


def binary_amplitude(pulses: int, false_alarm: float, detection: float) -> float:
    """Amplitude that the best counter of ones among equal pulses needs: best threshold and best number of ones.

    Args:
        pulses: N.
        false_alarm: probability in noise.
        detection: probability wanted, over false_alarm.

    Returns:
        a of a steady target.
    """

    def needed(ones: int) -> float:
        noise = brentq(lambda p: binom.sf(ones - 1, pulses, p) - false_alarm, 0.0, 1.0, xtol=1e-14)
        level = threshold_for(noise)

        def excess(amplitude: float) -> float:
            return float(
                binom.sf(ones - 1, pulses, steady_probability(level, amplitude)) - detection
            )

        return float(brentq(excess, 1e-3, _LARGEST_AMPLITUDE))

    # One minimum, near the ones that the best threshold for weak signals makes, and some scatter of their number.
    ones = min(pulses, round(0.2 * pulses + 1.7 * pulses**0.5))
    least = needed(ones)
    for step in (-1, 1):
        while 1 <= ones + step <= pulses and (other := needed(ones + step)) < least:
            ones, least = ones + step, other
    return least


def multilevel_gain_db(pulses: int, false_alarm: float, detection: float = 0.5) -> float:
    """Most that any number of levels can gain over binary quantisation.

    Source: Kuzmin 1967, § 2.3.4.

    Args:
        pulses: N, all of one amplitude.
        false_alarm: probability in noise.
        detection: probability wanted.

    Returns:
        dB of signal-to-noise ratio.
    """
    binary = binary_amplitude(pulses, false_alarm, detection)
    return float(20.0 * np.log10(binary / power_sum_amplitude(pulses, false_alarm, detection)))
