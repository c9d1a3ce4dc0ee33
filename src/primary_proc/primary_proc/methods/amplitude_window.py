# SPDX-License-Identifier: Apache-2.0
"""Sliding windows over the envelope itself: the likelihood ratio and the sums that stand in for it."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from scipy.special import i0e

from primary_proc.calculators.integration.window_law import start_rate
from primary_proc.calculators.pulse.burst_shape import burst_shape
from primary_proc.detectors.window_detector import LARGEST_SUM
from primary_proc.methods.requirements import Requirements
from primary_proc.methods.window import FloatArray, Window, coarse_levels, score_table
from primary_proc.methods.window_method import Fit, WindowMethod
from primary_proc.quantisers.amplitude_quantiser import ENVELOPE_STEPS, STEPS_PER_SIGMA

Scores = Callable[[FloatArray, Requirements], FloatArray]
"""What an envelope, shape (steps,), adds to the sum at each place of a register, shape (pulses, steps)."""

_LARGEST_TAP = 127.0
_FILLED = 0.99
# Stronger pulses count as 21 dB over the mean noise power: they are detected anyway, and weak ones keep their digits.
_STRONGEST = 16.0
_EDGES = np.arange(1, ENVELOPE_STEPS) / STEPS_PER_SIGMA


def likelihood_scores(envelope: FloatArray, requirements: Requirements) -> FloatArray:
    """Log-likelihood ratio of a steady target, ln I_0(a_k x) (Kuzmin 1967, (1.50)).

    Args:
        envelope: over the noise's sigma, shape (steps,).
        requirements: of which the beam and the signal matter.

    Returns:
        Shape (pulses, steps).
    """
    product = _amplitude(requirements)[:, None] * envelope
    return np.log(i0e(product)) + product


def linear_scores(envelope: FloatArray, requirements: Requirements) -> FloatArray:
    """g_k x, what (1.50) becomes for strong signals (Kuzmin 1967, § 1.3.3).

    Args:
        envelope: over the noise's sigma, shape (steps,).
        requirements: of which the beam matters.

    Returns:
        Shape (pulses, steps).
    """
    return np.outer(_shape(requirements), envelope)


def square_scores(envelope: FloatArray, requirements: Requirements) -> FloatArray:
    """g_k^2 x^2, what (1.50) becomes for weak signals (Kuzmin 1967, § 1.3.3).

    Args:
        envelope: over the noise's sigma, shape (steps,).
        requirements: of which the beam matters.

    Returns:
        Shape (pulses, steps).
    """
    return np.outer(_shape(requirements) ** 2, envelope**2)


def fast_scores(envelope: FloatArray, requirements: Requirements) -> FloatArray:
    """k^2 x^2 / 2 (1 + k^2), the log-likelihood ratio of a fast-fluctuating target, from (1.38) and (1.40).

    Args:
        envelope: over the noise's sigma, shape (steps,).
        requirements: of which the beam and the signal matter.

    Returns:
        Shape (pulses, steps).
    """
    ratio = _amplitude(requirements) ** 2 / 2.0
    return np.outer(ratio / (2.0 * (1.0 + ratio)), envelope**2)


class AmplitudeMethod(WindowMethod):
    """A sum of functions of the envelopes of the last N_0 pulses; the second threshold sets the rate."""

    def __init__(self, scores: Scores, channels: int = 1) -> None:
        """Choose the function.

        Args:
            scores: what an envelope adds at each place of the register.
            channels: products of a weight and a function of the envelope that make it up; one where it is a product.
        """
        self._scores, self._channels = scores, channels

    def fit(self, requirements: Requirements) -> Fit:
        """Round the function to whole numbers; see `WindowMethod.fit`.

        Args:
            requirements: what is asked.

        Returns:
            What sets the threshold.
        """
        envelope = (np.arange(ENVELOPE_STEPS) + 0.5) / STEPS_PER_SIGMA
        scores = self._scores(np.minimum(envelope, _STRONGEST), requirements)
        taps, table = whole_channels(scores - scores[:, :1], self._channels)
        return threshold_fit(_EDGES, table, taps)


def threshold_fit(edges: FloatArray, table: FloatArray, taps: FloatArray) -> Fit:
    """What finds the threshold of the sum while levels and weights stay.

    Args:
        edges: thresholds of the envelope, shape (levels - 1,).
        table: whole scores, shape (channels, levels).
        taps: whole weights, shape (channels, pulses).

    Returns:
        From a false-start probability to a window.
    """
    chance, scores = coarse_levels(edges, score_table(taps, table))
    rate = start_rate(scores, chance)

    def at_rate(starts: float) -> Window:
        threshold = rate.threshold_for(starts)
        return Window(edges, table, taps, threshold, rate.at(threshold))

    return at_rate


def whole_channels(scores: FloatArray, channels: int) -> tuple[FloatArray, FloatArray]:
    """Write a function of place and envelope as a sum of products of whole weights and whole scores.

    Args:
        scores: zero in the first column, shape (pulses, steps).
        channels: number of products.

    Returns:
        (taps, table): shapes (channels, pulses) and (channels, steps), scaled such that no sum loses a digit; places at
        both ends that do not count are left out.
    """
    left = np.linalg.svd(scores, full_matrices=False)[0].T[:channels]
    taps = np.rint(
        left / left[np.arange(channels), np.abs(left).argmax(axis=1)][:, None] * _LARGEST_TAP
    )
    inside = np.flatnonzero(taps.any(axis=0))
    seen = slice(inside[0], inside[-1] + 1)
    taps = taps[:, seen]
    table = np.linalg.lstsq(taps.T, scores[seen], rcond=None)[0]
    largest = float(np.abs(taps).sum(axis=1) @ np.abs(table).max(axis=1))
    return taps, np.floor(table * (_FILLED * LARGEST_SUM / largest) + 0.5)


def _shape(requirements: Requirements) -> FloatArray:
    return burst_shape(requirements.pattern, requirements.pulses)


def _amplitude(requirements: Requirements) -> FloatArray:
    return math.sqrt(2.0) * 10.0 ** (requirements.snr_db / 20.0) * _shape(requirements)
