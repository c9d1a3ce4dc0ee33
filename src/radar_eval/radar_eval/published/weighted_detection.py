# SPDX-License-Identifier: Apache-2.0
"""Weighted and counted ones of a burst (Kuzmin 1967, § 3.1): laws, thresholds, losses and word length."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from primary_proc.calculators.integration.binary_integration import (
    count_probability,
    one_probability,
    required_snr_db,
    weighted_sum_probability,
)
from primary_proc.calculators.integration.burst_weights import binary_weights, weight_bits
from primary_proc.calculators.integration.integration_loss import (
    integration_loss_db,
    quantisation_loss_db,
)
from primary_proc.calculators.integration.second_threshold import best_threshold, kuzmin_threshold
from primary_proc.calculators.pulse.burst_shape import burst_shape
from primary_proc.calculators.pulse.single_pulse import steady_probability, threshold_for
from radar_common.antenna_pattern import PATTERNS
from radar_eval.published.result import Row, to_digits

_FALSE_ALARM = 1e-5
_DETECTION = (0.5, 0.9)
# Second threshold: p_N, x_0, then a of a steady and k_0 of a fast target for both detection probabilities.
_REQUIRED = {
    1: (6.25e-7, 5.345, 3.506, 4.131, 1.876, 2.472),
    2: (0.00029, 4.037, 2.616, 3.13, 1.606, 2.102),
    3: (0.00264, 3.446, 2.286, 2.756, 1.51, 1.982),
    4: (0.00879, 3.077, 2.121, 2.567, 1.473, 1.943),
    5: (0.01939, 2.808, 2.028, 2.46, 1.466, 1.946),
    6: (0.03449, 2.595, 1.974, 2.398, 1.477, 1.977),
    7: (0.05406, 2.416, 1.944, 2.364, 1.502, 2.029),
    8: (0.07806, 2.258, 1.932, 2.352, 1.54, 2.104),
    10: (0.1396, 1.984, 1.949, 2.379, 1.659, 2.335),
    12: (0.22112, 1.737, 2.02, 2.478, 1.866, 2.761),
    16: (0.48697, 1.2, 2.629, 3.432, 3.951, 10.405),
}
_QUANTISATION = {10: (1.13, 1.21), 16: (1.12, 1.17), 20: (1.1, 1.15)}
_INTEGRATION = {10: (1.24, 1.29), 12: (1.34, 1.38), 16: (1.34, 1.38), 20: (1.32, 1.36)}
_SHAPE = {1.0: 0.393, 2.0: 0.462, 3.0: 0.476, 5.0: 0.408, 10.0: 0.31}
_THIRD = 6e-4
_HUNDREDTH_DB = 0.0101


def weighted_detection() -> Iterator[Row]:
    """Compute what the weighted and the counted ones do.

    Yields:
        Shape of the weights, the normal approximations, figure 3.3 as a table, the losses, the word length.
    """
    yield from _weights()
    yield from _normal_approximation()
    yield from _second_threshold()
    yield from _losses()
    label = "§ 3.1.6: bits of a weight for an error of 10 %"
    yield Row(label, 3.0, 3.0, float(weight_bits(0.1)), 0.0)


def _weights() -> Iterator[Row]:
    noise = float(np.exp(-2.0))
    shape = PATTERNS["sinc2"](np.array([0.0, 0.4]))
    for amplitude, expected in _SHAPE.items():
        weights = binary_weights(noise, amplitude * shape)
        # At a_0 = 10 a zero has a probability of 3e-16, of which floating point keeps one digit.
        tolerance = 3e-3 if amplitude == 10.0 else _THIRD
        label = f"(3.7), sinc^2, x_0 = 2, a_0 = {amplitude:g}: eta(0.4) / eta(0)"
        yield Row(label, None, expected, float(weights[1] / weights[0]), tolerance)
        if amplitude in (1.0, 10.0):
            scale, digits = (0.85, to_digits(0.85)) if amplitude == 1.0 else (37.7, 0.3)
            label = f"(3.7), sinc^2, x_0 = 2, a_0 = {amplitude:g}: eta(0)"
            yield Row(label, None, scale, float(weights[0]), digits)


def _normal_approximation() -> Iterator[Row]:
    noise = float(np.exp(-2.0))
    weights = binary_weights(noise, 2.0 * burst_shape("sinc2", 16))
    finding = (
        "(3.15): a threshold lies in the tail, where the sum of ones is far from normal; "
        "too small by one to three orders of magnitude"
    )
    for threshold, formula, exact in ((8.4, 4.7e-5, 1.0e-3), (11.18, 1.2e-8, 1.0e-5)):
        ours, book = (
            weighted_sum_probability(weights, noise, threshold, model)
            for model in ("exact", "kuzmin")
        )
        at = f"(3.15), N_0 = 16, sinc^2, a_0 = 2, x_0 = 2, threshold {threshold:g}"
        yield Row(f"{at}: P_fa", formula, exact, ours, 0.03 * exact, finding)
        yield Row(f"{at}: P_fa by the formula", None, formula, book, 0.04 * formula)
    one = float(steady_probability(2.0, 1.5))
    finding = "(3.16) takes a sum of whole numbers for a smooth one: 20 to 50 % off for rectangular bursts"
    book = weighted_sum_probability(np.ones(16), one, 7.0, "kuzmin")
    at = "(3.16), N_0 = 16, rectangular, x_0 = 2, a_0 = 1.5"
    yield Row(f"{at}: P_d by the formula, threshold 7", None, 0.455, book, _THIRD)
    for label, count, expected in (("more than 7", 8, 0.354), ("7 or more", 7, 0.551)):
        ours = float(count_probability(count, 16, one))
        yield Row(f"{at}: P_d, {label} ones", 0.455, expected, ours, _THIRD, finding)
    for pattern in ("sinc2", "gaussian"):
        signal = steady_probability(2.0, 2.5 * burst_shape(pattern, 16))
        weights = binary_weights(noise, 2.5 * burst_shape(pattern, 16))
        middle = 0.8 * float((signal * weights).sum())
        exact, book = (
            weighted_sum_probability(weights, signal, middle, model)
            for model in ("exact", "kuzmin")
        )
        label = f"(3.16), N_0 = 16, {pattern}, a_0 = 2.5: P_d by the formula over the exact one"
        yield Row(
            label, 1.25, 1.0, book / exact, 0.1,
            "the book warns of 20 to 30 % at 10 to 20 pulses; weights smooth the sum, and a few per cent are left",
        )  # fmt: skip


def _second_threshold() -> Iterator[Row]:
    for pulses, expected in ((16, 6.0), (11, 5.0)):
        ours = float(kuzmin_threshold(pulses))
        yield Row(f"(3.17): second threshold, N_0 = {pulses}", expected, expected, ours, 0.0)
    for count, (noise, threshold, *needed) in _REQUIRED.items():
        at = f"figure 3.3, N_0 = 16, P_fa = 1e-5, second threshold {count}"
        p_n = one_probability(count, 16, _FALSE_ALARM)
        yield Row(f"{at}: p_N", None, noise, p_n, to_digits(noise))
        yield Row(f"{at}: x_0", None, threshold, float(threshold_for(p_n)), _THIRD)
        targets = (("steady", "a"), ("fast", "k_0"))
        cases = [(t, symbol, d) for t, symbol in targets for d in _DETECTION]
        for (target, symbol, detection), expected in zip(cases, needed, strict=True):
            snr_db = required_snr_db(16, count, _FALSE_ALARM, detection, target)
            ours = 10.0 ** (snr_db / 20.0) * (np.sqrt(2.0) if target == "steady" else 1.0)
            label = f"{at}: {symbol} of a {target} target for P_d = {detection:g}"
            yield Row(label, None, expected, float(ours), _THIRD)
    for target, best in (("steady", 8), ("fast", 4)):
        ours = best_threshold(16, _FALSE_ALARM, 0.9, target)
        at = f"figure 3.3, N_0 = 16, P_fa = 1e-5, P_d = 0.9, {target} target"
        yield Row(
            f"{at}: best second threshold", 6.0, float(best), float(ours), 0.0,
            "(3.17) lies between the optima of steady and of fast targets; the minimum is broad",
        )  # fmt: skip
        cost = _cost_of_kuzmin(16, target)
        yield Row(f"{at}: (3.17) costs no more than 0.2 dB (1 = yes)", 1.0, 1.0, cost <= 0.2, 0.0)
    for pulses in (50, 100):
        cost = _cost_of_kuzmin(pulses, "steady")
        label = f"(3.17), N_0 = {pulses}, P_fa = 1e-5: costs 0.4 to 0.6 dB (1 = yes)"
        yield Row(label, None, 1.0, float(0.35 <= cost <= 0.65), 0.0)


def _cost_of_kuzmin(pulses: int, target: str) -> float:
    best = best_threshold(pulses, _FALSE_ALARM, 0.9, target)
    counted, least = (
        required_snr_db(pulses, count, _FALSE_ALARM, 0.9, target)
        for count in (kuzmin_threshold(pulses), best)
    )
    return counted - least


def _losses() -> Iterator[Row]:
    levels = np.linspace(0.6, 4.2, 10)
    finding = "slightly above the book's 1 dB against ten thresholds"
    for pulses, values in _QUANTISATION.items():
        for detection, expected in zip(_DETECTION, values, strict=True):
            ours = quantisation_loss_db(pulses, levels, _FALSE_ALARM, detection)
            label = (
                f"§ 3.1.2, N_0 = {pulses}, P_d = {detection:g}: binary against 10 thresholds, dB"
            )
            yield Row(label, 1.0, expected, ours, _HUNDREDTH_DB, finding)
    for pulses, values in _INTEGRATION.items():
        count = kuzmin_threshold(pulses)
        for detection, expected in zip(_DETECTION, values, strict=True):
            ours = integration_loss_db(pulses, count, _FALSE_ALARM, detection)
            label = (
                f"figure 3.4, N_0 = {pulses}, P_d = {detection:g}: loss of counting, 1 to 1.5 dB"
            )
            yield Row(label, None, expected, ours, _HUNDREDTH_DB)
