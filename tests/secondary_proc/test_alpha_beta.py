# SPDX-License-Identifier: Apache-2.0
"""The growing memory is least squares, and the bound is the optimum against manoeuvres."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import minimize

from secondary_proc.calculators.alpha_beta_gains import (
    GAIN_RULES,
    growing_coefficients,
    manoeuvre_intensity,
    optimal_alpha,
    optimal_coefficients,
    steady_coefficients,
)
from secondary_proc.smoothing import Measured
from secondary_proc.smoothing.alpha_beta import AlphaBetaSmoother

PERIOD = 4.0


def smooth(smoother, positions, azimuth=0.7, error=30.0):
    """Run one track through plots at equal intervals; the first two open it."""
    state = np.r_[positions[1], (positions[1] - positions[0]) / PERIOD][None]
    covariance = np.eye(4)[None] * error**2
    memory = np.zeros(1, smoother.memory)
    for number, position in enumerate(positions[2:], start=3):
        smoothed = smoother.update(
            Measured(
                state,
                covariance,
                memory,
                np.array([number]),
                np.array([PERIOD]),
                position[None],
                np.eye(2)[None] * error**2,
                np.array([azimuth]),
            )
        )
        state, covariance, memory = smoothed.state, smoothed.covariance, smoothed.memory
    return state[0], covariance[0]


@pytest.mark.parametrize("n", range(2, 12))
def test_growing_memory_is_the_line_through_all_plots(n):
    random = np.random.default_rng(n)
    positions = random.normal(size=(n, 2)) * 100.0
    state, _ = smooth(AlphaBetaSmoother(0.0, 0.0), positions)
    times = np.arange(n) * PERIOD
    design = np.stack([np.ones(n), times - times[-1]], axis=1)
    line = np.linalg.lstsq(design, positions, rcond=None)[0]
    np.testing.assert_allclose(state, line.ravel(), rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("n", range(2, 12))
def test_coefficients_are_the_weights_of_the_newest_plot_in_least_squares(n):
    times = np.arange(n) - (n - 1.0)
    weights = np.linalg.pinv(np.stack([np.ones(n), times], axis=1))
    alpha, beta = growing_coefficients(n)
    assert alpha == pytest.approx(weights[0, -1], rel=1e-12)
    assert beta == pytest.approx(weights[1, -1], rel=1e-12)


@pytest.mark.parametrize("n", range(3, 12))
def test_the_covariance_of_the_growing_memory_is_that_of_the_line(n):
    error = 30.0
    state = np.zeros((1, 4))
    # Two plots: position error, and both errors in the velocity.
    block = error**2 * np.array([[1.0, 1.0 / PERIOD], [1.0 / PERIOD, 2.0 / PERIOD**2]])
    covariance = np.kron(block, np.eye(2))[None]
    smoother = AlphaBetaSmoother(0.0, 0.0)
    for number in range(3, n + 1):
        covariance = smoother.update(
            Measured(
                state,
                covariance,
                np.zeros(1),
                np.array([number]),
                np.array([PERIOD]),
                np.zeros((1, 2)),
                np.eye(2)[None] * error**2,
                np.zeros(1),
            )
        ).covariance
    # Kuzmin 1967, (4.64) and (4.63).
    assert covariance[0, 0, 0] == pytest.approx(error**2 * 2 * (2 * n - 1) / (n * (n + 1)))
    assert covariance[0, 3, 3] == pytest.approx(error**2 * 12 / (n * (n * n - 1)) / PERIOD**2)


@pytest.mark.parametrize(
    ("intensity", "alpha", "beta"),
    [
        (1e-4, 0.1985, 0.0398),
        (1e-2, 0.4469, 0.2108),
        (0.1, 0.6241, 0.4372),
        (1.0, 0.8, 0.8),
        (10.0, 0.9252, 1.2408),
    ],
)
def test_optimum_has_the_values_of_the_book(intensity, alpha, beta):
    found = optimal_coefficients(intensity)
    np.testing.assert_allclose(found, (alpha, beta), atol=1e-3)


@pytest.mark.parametrize(
    ("intensity", "alpha", "beta"),
    [(1e-4, 0.1772, 0.0386), (0.1, 0.4408, 0.4302), (2.0, 0.5, 1.0), (10.0, 0.4793, 1.4486)],
)
def test_optimum_of_the_prediction_has_the_values_of_the_book(intensity, alpha, beta):
    np.testing.assert_allclose(
        optimal_coefficients(intensity, "predicted"), (alpha, beta), atol=1e-3
    )


@pytest.mark.parametrize("rule", GAIN_RULES)
def test_every_rule_bounds_the_memory_by_its_own_gains(rule):
    acceleration, error = 3.0, 30.0
    smoother = AlphaBetaSmoother(acceleration, 0.0, rule)
    positions = np.zeros((40, 2))
    positions[-1] = 100.0, 0.0
    state, _ = smooth(smoother, positions, azimuth=0.3, error=error)
    alpha, beta = steady_coefficients((acceleration * PERIOD**2 / error) ** 2, rule)
    np.testing.assert_allclose(state, [100.0 * alpha, 0.0, 100.0 * beta / PERIOD, 0.0], atol=1e-9)


def test_optimum_minimises_random_plus_dynamic_error():
    intensity = 0.05

    def error(coefficients):
        a, b = coefficients
        random = (2 * a * a - 3 * a * b + 2 * b) / (a * (4 - 2 * a - b))
        return random + intensity * (1 - a) ** 2 / b**2

    best = minimize(error, (0.5, 0.3), method="Nelder-Mead", options={"xatol": 1e-8}).x
    np.testing.assert_allclose(optimal_coefficients(intensity), best, atol=1e-3)


def test_intensity_and_optimum_are_inverse():
    beta = np.linspace(0.01, 1.9, 50)
    alpha, back = optimal_coefficients(manoeuvre_intensity(beta))
    np.testing.assert_allclose(back, beta, rtol=1e-3)
    np.testing.assert_allclose(alpha, optimal_alpha(beta), rtol=1e-3)
    assert np.all(2 * alpha + back < 4)


def test_memory_is_bounded_and_follows_an_accelerating_target():
    times = np.arange(60) * PERIOD
    positions = np.stack([0.5 * 3.0 * times**2, 200.0 * times], axis=1)
    bounded, _ = smooth(AlphaBetaSmoother(3.0, 0.0), positions)
    endless, _ = smooth(AlphaBetaSmoother(0.0, 0.0), positions)
    assert abs(bounded[0] - positions[-1, 0]) < 30.0
    assert abs(endless[0] - positions[-1, 0]) > 1000.0
