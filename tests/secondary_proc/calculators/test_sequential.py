# SPDX-License-Identifier: Apache-2.0
"""Sequential filters against their batch solutions, against simulation and against direct minimisation."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import minimize

from secondary_proc.calculators.alpha_beta_dynamics import (
    aperiodic_alpha,
    dynamic_error,
    is_stable,
    random_variance,
    speed_jump_errors,
    speed_jump_square,
    transfer,
)
from secondary_proc.calculators.alpha_beta_gains import (
    growing_coefficients,
    steady_second_increment_gains,
)
from secondary_proc.calculators.alpha_beta_optimum import optimal_gains, total_error
from secondary_proc.calculators.sequential_filter import (
    Gains,
    aided_gains,
    bounded_gains,
    run_filter,
    second_increment_gains,
)

ZERO = (np.zeros(()), np.zeros(()))
stable = st.tuples(st.floats(0.1, 1.0), st.floats(0.05, 1.0))


def constant(alpha, beta, scans):
    none = np.zeros(scans)
    return Gains(none + alpha, none + beta, none, none)


@pytest.mark.parametrize("ratio", [0.2, 1.0, 8.0])
def test_the_aided_recursion_is_least_squares_of_both_observations(ratio):
    random = np.random.default_rng(3)
    n = 9
    plots, speeds = random.normal(size=n), random.normal(size=n)

    def batch(count):
        design = np.zeros((2 * count, 2))
        design[:count, 0] = 1.0
        design[:count, 1] = np.arange(count) - (count - 1.0)
        design[count:, 1] = np.sqrt(ratio)
        seen = np.append(plots[:count], np.sqrt(ratio) * speeds[:count])
        return np.linalg.lstsq(design, seen, rcond=None)[0]

    _, position, velocity = run_filter(aided_gains(n, ratio), plots[2:], batch(2), speeds[2:])
    for count in range(3, n + 1):
        np.testing.assert_allclose(
            [position[count - 3], velocity[count - 3]], batch(count), atol=1e-12
        )


def test_memory_grows_until_its_bound():
    gains = bounded_gains(30, 0.4, 0.1)
    alpha, beta = growing_coefficients(np.arange(3, 31))
    free = alpha >= 0.4
    np.testing.assert_array_equal(gains.alpha[free], alpha[free])
    np.testing.assert_array_equal(gains.beta[free], beta[free])
    assert set(gains.alpha[~free]) == {0.4}
    assert set(gains.beta[~free]) == {0.1}


@pytest.mark.parametrize("intensity", [0.02, 0.1, 0.7, 3.0, 30.0])
def test_the_kalman_form_settles_at_its_closed_gains(intensity):
    gains = second_increment_gains(900, intensity)
    alpha, beta = steady_second_increment_gains(intensity)
    assert gains.alpha[-1] == pytest.approx(float(alpha), rel=1e-6)
    assert gains.beta[-1] == pytest.approx(float(beta), rel=1e-6)


def test_the_kalman_form_is_best_on_its_own_model():
    random = np.random.default_rng(8)
    tracks, scans, intensity = 400, 120, 0.3
    path = np.cumsum(np.cumsum(intensity * random.normal(size=(scans, tracks)), axis=0), axis=0)
    plots = path + random.normal(size=path.shape)
    start = (plots[1], plots[1] - plots[0])

    def error(gains):
        predicted, _, _ = run_filter(gains, plots[2:], start)
        return np.mean((predicted[20:] - path[22:]) ** 2)

    best = error(second_increment_gains(scans, intensity))
    alpha, beta = (float(g) for g in steady_second_increment_gains(intensity))
    assert best < error(constant(0.7 * alpha, beta, scans - 2))
    assert best < error(constant(alpha, 0.5 * beta, scans - 2))
    assert best < error(constant(min(1.3 * alpha, 1.0), 1.8 * beta, scans - 2))


@given(alpha=st.floats(-0.5, 2.5), beta=st.floats(-0.5, 4.5))
def test_the_triangle_holds_the_poles_inside_the_circle(alpha, beta):
    poles = np.abs(np.roots(transfer("residual", alpha, beta)[1]))
    if abs(poles.max() - 1.0) > 1e-6:
        assert is_stable(alpha, beta) == (poles.max() < 1.0)


@given(beta=st.floats(0.01, 0.99))
def test_damping_is_critical_on_its_curve(beta):
    alpha = float(aperiodic_alpha(beta))
    assert np.all(speed_jump_errors(alpha + 1e-3, beta, 300) > -1e-12)
    _, denominator = transfer("residual", alpha, beta)
    assert denominator[1] ** 2 - 4 * denominator[2] == pytest.approx(0.0, abs=1e-12)


@given(gains=stable)
def test_errors_of_a_jump_add_up(gains):
    total = np.square(speed_jump_errors(*gains, 3000)).sum()
    assert total == pytest.approx(float(speed_jump_square(*gains)), rel=1e-6)


@pytest.mark.parametrize("gains", [(0.5, 0.3), (0.3, 0.05), (0.9, 0.7)])
def test_errors_of_a_simulation(gains):
    random = np.random.default_rng(6)
    tracks, scans = 6000, 150
    plots = random.normal(size=(scans, tracks))
    filtered = run_filter(constant(*gains, scans), plots, (np.zeros(tracks), np.zeros(tracks)))
    for output, values in zip(
        ("predicted", "smoothed", "velocity"), (v[-1] for v in filtered), strict=True
    ):
        expected = float(random_variance(output, *gains))
        # The variance of a sample variance of n normal values is 2 / n times its square.
        assert abs(values.var() - expected) < 4 * expected * np.sqrt(2.0 / tracks)
    assert random_variance("residual", *gains) == pytest.approx(
        1.0 + float(random_variance("predicted", *gains))
    )


@given(gains=stable)
def test_lag_behind_a_parabola(gains):
    plots = 0.5 * np.arange(700.0) ** 2
    predicted, smoothed, _ = run_filter(constant(*gains, 700), plots, ZERO)
    assert plots[-1] - predicted[-1] == pytest.approx(
        float(dynamic_error("predicted", *gains)), rel=1e-4
    )
    assert plots[-1] - smoothed[-1] == pytest.approx(
        float(dynamic_error("smoothed", *gains)), rel=1e-4, abs=1e-5
    )


@pytest.mark.parametrize("criterion", ["smoothed", "predicted"])
@pytest.mark.parametrize("intensity", [1e-3, 0.05, 1.0, 10.0])
def test_no_other_gains_have_a_smaller_error(criterion, intensity):
    best = optimal_gains(intensity, criterion)
    found = minimize(
        lambda g: total_error(criterion, g[0], g[1], intensity),
        (best.alpha * 0.9, best.beta * 1.1),
        method="Nelder-Mead",
        options={"xatol": 1e-9, "fatol": 1e-12},
    )
    assert best.error == pytest.approx(found.fun, rel=1e-8)
    assert best.beta == pytest.approx(found.x[1], rel=1e-3)
    assert is_stable(best.alpha, best.beta)


def test_unknown_outputs_and_criteria_are_refused():
    with pytest.raises(ValueError, match="course"):
        transfer("course", 0.5, 0.3)
    with pytest.raises(ValueError, match="course"):
        random_variance("course", 0.5, 0.3)
    with pytest.raises(ValueError, match="velocity"):
        dynamic_error("velocity", 0.5, 0.3)
    with pytest.raises(ValueError, match="course"):
        optimal_gains(1.0, "course")
    with pytest.raises(ValueError, match="intensity"):
        optimal_gains(0.0)
