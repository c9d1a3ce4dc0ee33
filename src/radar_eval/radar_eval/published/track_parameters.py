# SPDX-License-Identifier: Apache-2.0
"""Smoothing and extrapolation by speed and course (Kuzmin 1967, § 4.6, (4.113)-(4.136), figures 4.17-4.24)."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from radar_eval.published.flowchart_drift import flowchart_drift
from radar_eval.published.plot_pairs import plot_pairs
from radar_eval.published.result import Row
from secondary_proc.calculators.exponential_smoothing import (
    exponential_lag,
    exponential_variance,
    exponential_weights,
    optimal_zeta,
    turn_intensity,
    two_scan_detection,
)
from secondary_proc.calculators.line_estimator import line_position_variance
from secondary_proc.calculators.weighted_mean import (
    combine,
    least_squares_ratio,
    mean_prediction_variance,
    mean_velocity_variance,
)

_EXACT = 1e-9
# n: (4.115), (4.116), (4.117), (4.65).
_MEANS = {
    2: (1.4142, 1.0, 2.2361, 2.2361),
    3: (0.7071, 1.0, 1.5811, 1.5275),
    4: (0.4714, 0.9487, 1.3744, 1.2247),
    5: (0.3536, 0.8944, 1.2748, 1.0488),
    6: (0.2828, 0.8452, 1.2166, 0.9309),
    8: (0.2020, 0.7638, 1.1518, 0.7792),
    10: (0.1571, 0.7006, 1.1167, 0.6831),
}
_EXPONENTIAL = {0.1: 0.736364, 0.5: 0.166667, 0.9: 0.005263}
_OPTIMA = {
    0.001: 0.797, 0.005: 0.703, 0.01: 0.651, 0.02: 0.590, 0.05: 0.497, 0.1: 0.415, 0.2: 0.323,
    0.3: 0.264, 0.5: 0.185, 0.8405: 0.100, 1.0: 0.071, 1.5: 0.0, 3.0: 0.0,
}  # fmt: skip
_INTENSITIES = {0.4: 0.1124, 0.5: 0.0486, 0.6: 0.0180}
_LONG = 4000


def track_parameters() -> Iterator[Row]:
    """Compute errors of both ways of smoothing, of pairs of plots and of predictions.

    Yields:
        The tables of § 4.6 and the drift of the flowchart.
    """
    yield from _means()
    yield from _exponential()
    yield from _optima()
    yield from plot_pairs()
    yield from flowchart_drift()


def _means() -> Iterator[Row]:
    for n, (velocity, ratio, prediction, optimal) in _MEANS.items():
        for name, expected, ours in (
            ("rms velocity (4.115)", velocity, np.sqrt(mean_velocity_variance(n))),
            ("least squares over it (4.116)", ratio, least_squares_ratio(n)),
            ("rms prediction (4.117)", prediction, np.sqrt(mean_prediction_variance(n))),
            ("rms least-squares prediction", optimal, np.sqrt(line_position_variance(n, 1))),
        ):
            label = f"mean of speeds, {n} plots, {name}, figure 4.18"
            yield Row(label, None, expected, float(ours), 5.1e-5)
    for n in (3, 6, 10):
        # Plot 1 to n as unit vectors: the mean's weights come out beside its claimed variance.
        weights, claimed = np.eye(n)[1] - np.eye(n)[0], np.asarray(2.0)
        for i in range(2, n):
            weights, claimed = combine(weights, claimed, np.eye(n)[i] - np.eye(n)[i - 1], 2.0)
        label = f"{n} plots: variance of the mean by (4.114)"
        yield Row(label, None, 2.0 / (n - 1), float(claimed), _EXACT)
        finding = "the errors of successive speeds are not independent; (4.114) claims n - 1 times too much"
        label = f"{n} plots: true variance of the mean"
        yield Row(label, None, 2.0 / (n - 1) ** 2, float(weights @ weights), _EXACT, finding)


def _exponential() -> Iterator[Row]:
    # A course is the difference of two plots: the correlation follows from their weights.
    first, second = np.array([-1.0, 1.0, 0.0]), np.array([0.0, -1.0, 1.0])
    ours = float(first @ second / (first @ first))
    yield Row("correlation of successive courses (4.123)", -0.5, -0.5, ours, _EXACT)
    for zeta, expected in _EXPONENTIAL.items():
        ours = float(exponential_variance(zeta))
        yield Row(f"zeta = {zeta:g}: random error (4.124)", None, expected, ours, 1e-6)
        eta = exponential_weights(zeta, _LONG)
        summed = float(eta @ eta - eta[1:] @ eta[:-1])
        yield Row(f"zeta = {zeta:g}: random error by its sum", None, expected, summed, 1e-6)
        lag = float(eta @ np.arange(1.0, _LONG + 1))
        label = f"zeta = {zeta:g}: lag of the prediction in a steady turn (4.125)"
        yield Row(label, None, lag, float(exponential_lag(zeta)), 1e-6)
    finding = "0.68 is the probability that straight flight is not taken for a manoeuvre"
    ours = 1.0 - float(two_scan_detection(0.0))
    yield Row("confidence of the two-scan detector", 0.68, 0.6827, ours, 5.1e-5, finding)
    weights = (np.array([0.0, 0.0, -1.0, 1.0]) - np.array([-1.0, 1.0, 0.0, 0.0])) / 2.0
    label = "variance of the mean change of two scans over that of a course"
    yield Row(label, 0.5, 0.5, float(weights @ weights / 2.0), _EXACT)


def _optima() -> Iterator[Row]:
    for intensity, expected in _OPTIMA.items():
        label = f"psi^2 = {intensity:g}: best zeta, figure 4.22"
        yield Row(label, None, expected, optimal_zeta(intensity), 6e-4)
    for zeta, expected in _INTENSITIES.items():
        label = f"psi^2 that zeta = {zeta:g} is best for ('0.4 to 0.6 without manoeuvre')"
        yield Row(label, None, expected, float(turn_intensity(zeta)), 5.1e-5)
    ours = optimal_zeta(float(turn_intensity(0.1)))
    label = "zeta recommended in a manoeuvre, at psi^2 = 0.84"
    yield Row(label, 0.1, 0.1, ours, 1e-6)
