# SPDX-License-Identifier: Apache-2.0
"""Sliding windows over ones and zeros: the m-of-n counter and the weighted sum of ones."""

from __future__ import annotations

import math

import numpy as np
from scipy.optimize import brentq

from primary_proc.calculators.integration.burst_weights import binary_weights, whole_weights
from primary_proc.calculators.integration.second_threshold import kuzmin_threshold
from primary_proc.calculators.integration.window_law import start_rate
from primary_proc.calculators.pulse.burst_shape import burst_shape
from primary_proc.calculators.pulse.single_pulse import threshold_for
from primary_proc.methods.requirements import Requirements
from primary_proc.methods.window import FloatArray, Window
from primary_proc.methods.window_method import Fit, WindowMethod

_LEAST = 1e-9
_NOTHING = 1e-300
_FULLEST = 0.7
_WEIGHT_BITS = 3
_FIRST_GUESS = 0.05


class CountMethod(WindowMethod):
    """Ones among the last N_0 positions against a count (Kuzmin 1967, (3.8)); the first threshold sets the rate."""

    def fit(self, requirements: Requirements) -> Fit:
        """Take N_0 equal weights; see `WindowMethod.fit`.

        Args:
            requirements: what is asked.

        Returns:
            What sets the first threshold.

        Raises:
            ValueError: the count is more than the window holds.
        """
        taps = np.ones(round(requirements.pulses))
        count = requirements.second_threshold or kuzmin_threshold(requirements.pulses)
        return lambda starts: _at_rate(taps, count, starts)


class WeightedCountMethod(WindowMethod):
    """Ones weighted by their log-likelihood ratio (3.7), in whole numbers of three bits."""

    def __init__(self, *, first_peak: bool = False) -> None:
        """Choose how the centre of a burst is found.

        Args:
            first_peak: as the first peak of the sum, which is the processor of § 3.1.6.
        """
        self.first_peak = first_peak

    def fit(self, requirements: Requirements) -> Fit:
        """Take the weights of the wanted signal; see `WindowMethod.fit`.

        Args:
            requirements: what is asked; a second threshold counts ones of full weight.

        Returns:
            What sets the first threshold, and the weights that go with it.
        """

        def at_rate(starts: float) -> Window:
            noise = _FIRST_GUESS
            for _ in range(2):
                taps = beam_weights(noise, requirements)
                full = requirements.second_threshold
                level = full * taps.max() if full else _typical_threshold(taps)
                window = _at_rate(taps, level, starts)
                noise = float(window.level_chances[1])
            return window

        return at_rate


def beam_weights(noise: float, requirements: Requirements) -> FloatArray:
    """Log-likelihood weights of the ones of a burst as whole numbers, without the zeros at both ends.

    Args:
        noise: probability p_N of a one in noise.
        requirements: of which the beam and the signal matter.

    Returns:
        Shape (pulses,).
    """
    amplitude = math.sqrt(2.0) * 10.0 ** (requirements.snr_db / 20.0)
    shape = burst_shape(requirements.pattern, requirements.pulses)
    weights = binary_weights(noise, amplitude * shape, requirements.target)
    return np.trim_zeros(whole_weights(np.maximum(weights, 0.0), _WEIGHT_BITS))


def _typical_threshold(taps: FloatArray) -> float:
    """(3.17) for as many pulses as the weights are worth, each of the weight that counts."""
    worth = taps.sum() ** 2 / np.square(taps).sum()
    return round(1.5 * math.sqrt(worth) * np.square(taps).sum() / taps.sum())


def _at_rate(taps: FloatArray, threshold: float, starts: float) -> Window:
    """Find the first threshold that gives a false-start probability."""
    if threshold > taps.sum():
        raise ValueError(
            f"a second threshold of {threshold:g} is over {taps.sum():g}, the most that a burst of "
            f"{len(taps)} pulses gives"
        )
    scores = np.outer(taps, [0.0, 1.0])

    def rate(noise: float) -> float:
        return max(start_rate(scores, [1.0 - noise, noise]).at(threshold), _NOTHING)

    bounds = _LEAST, _FULLEST * threshold / taps.sum()
    lowest, highest = (rate(bound) for bound in bounds)
    if not lowest < starts < highest:
        raise ValueError(
            f"a false-start probability of {starts:.3g} is out of reach of {threshold:g} ones in {len(taps)} pulses: "
            f"they give {lowest:.3g} to {highest:.3g}"
        )
    low, high = (math.log(bound) for bound in bounds)
    noise = math.exp(
        brentq(lambda log: math.log(rate(math.exp(log)) / starts), low, high, xtol=1e-6)
    )
    table = np.array([[0.0, 1.0]])
    return Window(threshold_for([noise]), table, taps[None], threshold, rate(noise))
