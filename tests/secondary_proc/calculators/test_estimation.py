# SPDX-License-Identifier: Apache-2.0
"""Estimates from a fixed number of plots against generalised least squares and simulation."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from secondary_proc.calculators import line_estimator as line
from secondary_proc.calculators import parabola_estimator as parabola
from secondary_proc.calculators.manoeuvre_detector import (
    false_manoeuvre_probability,
    manoeuvre_detection,
    sigmas_for,
)
from secondary_proc.calculators.polynomial_estimator import estimate_variance, polynomial_weights
from secondary_proc.calculators.velocity_observations import (
    aided_position_variance,
    aided_position_weights,
    aided_velocity_variance,
    aided_velocity_weights,
)


def covariance_of(n, seed):
    root = np.random.default_rng(seed).normal(size=(n, n))
    return root @ root.T + 0.1 * np.eye(n)


@settings(max_examples=40)
@given(
    degree=st.integers(0, 3),
    more=st.integers(1, 6),
    seed=st.integers(0, 1000),
    begin=st.floats(-1e5, 1e5),
)
def test_the_estimate_is_generalised_least_squares(degree, more, seed, begin):
    random = np.random.default_rng(seed)
    n = degree + more
    times = np.cumsum(random.uniform(0.5, 2.0, n))
    covariance = covariance_of(n, seed)
    weights = polynomial_weights(begin + times, degree, begin + 3.0, covariance=covariance)
    design = times[:, None] ** np.arange(degree + 1)
    inverse = np.linalg.inv(covariance)
    gain = np.linalg.solve(design.T @ inverse @ design, design.T @ inverse)
    np.testing.assert_allclose(weights, 3.0 ** np.arange(degree + 1) @ gain, atol=1e-5)


@given(degree=st.integers(0, 4), derivative=st.integers(0, 3), at=st.floats(-5.0, 15.0))
def test_polynomials_of_the_degree_come_out_exactly(degree, derivative, at):
    truth = np.polynomial.Polynomial(np.arange(1.0, degree + 2.0))
    times = np.array([0.0, 1.1, 1.9, 4.2, 5.0, 7.7])
    weights = polynomial_weights(times, degree, at, derivative=derivative)
    expected = truth.deriv(derivative)(at) if derivative else truth(at)
    assert weights @ truth(times) == pytest.approx(expected, rel=1e-7, abs=1e-6)


def test_no_linear_unbiased_estimate_is_better_than_that_for_the_right_covariance():
    times, covariance = np.arange(8), covariance_of(8, 2)
    best = polynomial_weights(times, 1, [7.0, 8.0], covariance=covariance)
    plain = polynomial_weights(times, 1, [7.0, 8.0])
    assert best.shape == (2, 8)
    assert np.all(estimate_variance(best, covariance) < estimate_variance(plain, covariance))


def test_too_few_times_or_an_impossible_covariance_are_refused():
    with pytest.raises(ValueError, match="1 times"):
        polynomial_weights([2.0, 2.0], 1, 0.0)
    with pytest.raises(ValueError, match="positive definite"):
        polynomial_weights([0.0, 1.0], 1, 0.0, covariance=[[1.0, 2.0], [2.0, 1.0]])


@pytest.mark.parametrize("n", range(3, 15))
def test_closed_weights_have_their_closed_variances(n):
    def variance(weights):
        return float(estimate_variance(weights))

    assert variance(line.line_velocity_weights(n)) == pytest.approx(
        float(line.line_velocity_variance(n))
    )
    for ahead in (1 - n, 0, 1, 3):
        weights = line.line_position_weights(n, ahead)
        assert variance(weights) == pytest.approx(float(line.line_position_variance(n, ahead)))
    for weights, formula in (
        (parabola.parabola_velocity_weights, parabola.parabola_velocity_variance),
        (parabola.parabola_acceleration_weights, parabola.parabola_acceleration_variance),
        (parabola.parabola_last_weights, parabola.parabola_last_variance),
        (parabola.parabola_next_weights, parabola.parabola_next_variance),
    ):
        assert variance(weights(n)) == pytest.approx(float(formula(n)))


@pytest.mark.parametrize("n", range(2, 10))
@pytest.mark.parametrize("ratio", [0.2, 1.0, 7.0])
def test_aided_weights_give_aided_variances(n, ratio):
    for ahead in (1 - n, 0, 1, 4):
        weights = aided_position_weights(n, ratio, ahead)
        variance = weights.position @ weights.position + n * weights.velocity**2 / ratio
        assert variance == pytest.approx(float(aided_position_variance(n, ratio, ahead)))
    weights = aided_velocity_weights(n, ratio)
    variance = weights.position @ weights.position + n * weights.velocity**2 / ratio
    assert variance == pytest.approx(float(aided_velocity_variance(n, ratio)))


def test_without_velocity_the_line_is_the_plain_one():
    np.testing.assert_allclose(
        aided_position_weights(6, 0.0, 1).position, line.line_position_weights(6, 1)
    )
    assert aided_position_variance(6, 0.0, 2) == pytest.approx(
        float(line.line_position_variance(6, 2))
    )


@pytest.mark.parametrize("scans", [0, 1, 3, None])
def test_manoeuvres_are_declared_as_often_as_simulated(scans):
    random = np.random.default_rng(4)
    trials, n, sigmas, intensity = 40_000, 4, 1.5, 2.0
    since = n - 1 if scans is None else scans
    path = 0.5 * intensity * np.maximum(np.arange(since - n + 1, since + 1), 0.0) ** 2
    plots = path + random.normal(size=(trials, n))
    estimate = plots @ parabola.parabola_acceleration_weights(n)
    threshold = sigmas * np.sqrt(parabola.parabola_acceleration_variance(n))
    share = np.mean(np.abs(estimate) >= threshold)
    expected = float(manoeuvre_detection(n, sigmas, intensity, scans))
    assert abs(share - expected) < 4 * np.sqrt(expected * (1 - expected) / trials)


def test_without_a_manoeuvre_only_errors_are_declared():
    assert manoeuvre_detection(5, 2.0, 0.0) == pytest.approx(
        float(false_manoeuvre_probability(2.0))
    )
    assert false_manoeuvre_probability(sigmas_for(0.01)) == pytest.approx(0.01)
    rising = manoeuvre_detection(4, 3.0, 3.0, np.arange(6))
    assert np.all(np.diff(rising[:4]) > 0)
    assert rising[4] == pytest.approx(rising[3])
