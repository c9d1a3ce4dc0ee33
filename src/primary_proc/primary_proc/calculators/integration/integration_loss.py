# SPDX-License-Identifier: Apache-2.0
"""Signal that the sums over a rectangular burst need, and what one loses against another."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from scipy.optimize import brentq

from primary_proc.calculators.integration.binary_integration import required_snr_db
from primary_proc.calculators.integration.burst_weights import level_probabilities, level_weights
from primary_proc.calculators.integration.envelope_sums import FloatArray, envelope_sum_law
from primary_proc.calculators.integration.second_threshold import best_threshold
from primary_proc.calculators.integration.window_law import sum_law

_LEAST, _MOST = 0.3, 8.0
_RESOLUTION = 400.0


def linear_sum_snr_db(pulses: int, false_alarm: float, detection: float) -> float:
    """Signal that the unquantised sum of envelopes needs, the ideal integrator of strong signals.

    Source: Kuzmin 1967, § 1.3.3 and figure 3.4.

    Args:
        pulses: N_0 equal pulses of a steady target.
        false_alarm: probability in noise.
        detection: wanted probability.

    Returns:
        Power a^2 / 2 over the mean noise power in dB.
    """

    def scores(envelope: FloatArray) -> FloatArray:
        return np.tile(envelope, (pulses, 1))

    threshold = envelope_sum_law(scores, np.zeros(pulses)).threshold(false_alarm)

    def excess(amplitude: float) -> float:
        law = envelope_sum_law(scores, np.full(pulses, amplitude))
        return law.exceedance(threshold) - detection

    return _decibels(float(brentq(excess, _LEAST, _MOST, xtol=1e-6)))


def level_sum_snr_db(
    pulses: int, thresholds: npt.ArrayLike, false_alarm: float, detection: float
) -> float:
    """Signal that the log-likelihood sum over quantised envelopes needs.

    Source: Kuzmin 1967, (3.9)-(3.11); the weights are those of the signal that is needed. Between two values of the sum
    the threshold is drawn, as if the values lay close.

    Args:
        pulses: N_0 equal pulses of a steady target.
        thresholds: of the envelope in units of the noise's sigma, rising, shape (k,).
        false_alarm: probability in noise.
        detection: wanted probability.

    Returns:
        Power a^2 / 2 over the mean noise power in dB.
    """
    noise = level_probabilities(thresholds, 0.0)

    def excess(amplitude: float) -> float:
        weight = level_weights(thresholds, amplitude)
        whole = np.rint((weight - weight[0]) / (weight[-1] - weight[0]) * _RESOLUTION)
        scores = np.tile(whole, (pulses, 1))
        signal = level_probabilities(thresholds, amplitude)
        beyond, found = (np.cumsum(sum_law(scores, p)[::-1]) for p in (noise, signal))
        return float(np.interp(false_alarm, beyond, found)) - detection

    return _decibels(float(brentq(excess, _LEAST, _MOST, xtol=1e-6)))


def integration_loss_db(pulses: int, count: int, false_alarm: float, detection: float) -> float:
    """What counting ones loses against the unquantised sum of envelopes.

    Source: Kuzmin 1967, figure 3.4.

    Args:
        pulses: N_0 equal pulses of a steady target.
        count: second threshold.
        false_alarm: probability in noise.
        detection: wanted probability.

    Returns:
        dB.
    """
    counted = required_snr_db(pulses, count, false_alarm, detection)
    return counted - linear_sum_snr_db(pulses, false_alarm, detection)


def quantisation_loss_db(
    pulses: int, thresholds: npt.ArrayLike, false_alarm: float, detection: float
) -> float:
    """What the best count of ones loses against a sum over more levels.

    Source: Kuzmin 1967, § 3.1.2.

    Args:
        pulses: N_0 equal pulses of a steady target.
        thresholds: of the envelope in units of the noise's sigma, rising, shape (k,).
        false_alarm: probability in noise.
        detection: wanted probability.

    Returns:
        dB.
    """
    count = best_threshold(pulses, false_alarm, detection)
    counted = required_snr_db(pulses, count, false_alarm, detection)
    return counted - level_sum_snr_db(pulses, thresholds, false_alarm, detection)


def _decibels(amplitude: float) -> float:
    return float(20.0 * np.log10(amplitude / np.sqrt(2.0)))
