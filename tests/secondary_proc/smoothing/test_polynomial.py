# SPDX-License-Identifier: Apache-2.0
"""Batched polynomials are those of the calculator; the detector chooses between line and parabola as it should."""

from __future__ import annotations

import numpy as np
import pytest

from secondary_proc.calculators.line_estimator import line_position_variance
from secondary_proc.calculators.parabola_estimator import (
    parabola_acceleration_variance,
    parabola_last_variance,
)
from secondary_proc.calculators.polynomial_estimator import polynomial_weights
from secondary_proc.parameters import TrackerParameters
from secondary_proc.smoothing.polynomial_fit import fit


@pytest.mark.parametrize("degree", [1, 2])
def test_the_fit_is_the_calculator_s_for_unequal_times_and_errors(degree):
    random = np.random.default_rng(degree)
    plots = 6
    age = np.sort(random.uniform(0.0, 60.0, (1, plots)))
    age[:, 0] = 0.0
    variance = random.uniform(20.0, 200.0, (plots, 2)) ** 2
    position = random.normal(size=(1, plots, 2)) * 1e3
    information = np.zeros((1, plots + 2, 2, 2))
    information[0, :plots, [0, 1], [0, 1]] = 1.0 / variance.T
    # Two places are empty; what stands in them must not matter.
    ages = np.pad(age, ((0, 0), (0, 2)), constant_values=500.0)
    positions = np.pad(position, ((0, 0), (0, 2), (0, 0)), constant_values=1e9)
    found = fit(ages, positions, information, degree, 0.0)
    for axis in (0, 1):
        covariance = np.diag(variance[:, axis])
        for derivative in range(degree + 1):
            weights = polynomial_weights(
                -age[0], degree, 0.0, derivative=derivative, covariance=covariance
            )
            row = 2 * derivative + axis
            assert found.estimate[0, row] == pytest.approx(weights @ position[0, :, axis])
            assert found.covariance[0, row, row] == pytest.approx(weights @ covariance @ weights)


@pytest.mark.parametrize("plots", [3, 5, 8])
def test_the_errors_at_equal_intervals_are_the_book_s(plots):
    age = 4.0 * np.arange(plots)[None]
    information = np.broadcast_to(np.eye(2) / 30.0**2, (1, plots, 2, 2)).copy()
    nowhere = np.zeros((1, plots, 2))
    line = fit(age, nowhere, information, 1, 0.0).covariance[0]
    assert line[0, 0] == pytest.approx(30.0**2 * line_position_variance(plots))
    parabola = fit(age, nowhere, information, 2, 0.0).covariance[0]
    assert parabola[0, 0] == pytest.approx(30.0**2 * parabola_last_variance(plots))
    assert parabola[5, 5] == pytest.approx(30.0**2 * parabola_acceleration_variance(plots) / 4.0**4)


def test_the_memory_holds_just_so_many_plots(flights, smooth):
    plots = 5
    scene = flights(10, 20, 21)
    parameters = TrackerParameters(
        smoother="polynomial", polynomial_plots=plots, polynomial_degree=1, acceleration=0.0
    )
    states, _ = smooth(scene, parameters)
    changed = scene.position.copy()
    scene.position[:-plots] += 1e4
    elsewhere, _ = smooth(scene, parameters)
    np.testing.assert_allclose(states[-1], elsewhere[-1], rtol=1e-9)
    scene.position[:] = changed
    scene.position[-plots] += 1e4
    assert np.abs(smooth(scene, parameters)[0][-1] - states[-1]).max() > 100.0


def test_a_steady_acceleration_is_met_by_parabolas_and_lagged_by_lines(flights, smooth):
    scene = flights(10, 30, 22, noise=0.0)
    time = np.concatenate([np.zeros((1, 10)), np.cumsum(scene.seconds, axis=0)])
    push = np.array([10.0, -5.0])
    scene.truth[..., :2] += 0.5 * push * time[..., None] ** 2
    scene.truth[..., 2:] += push * time[..., None]
    scene.position[:] = scene.truth[..., :2]
    lines, _ = smooth(scene, TrackerParameters(smoother="polynomial", polynomial_degree=1))
    parabolas, _ = smooth(scene, TrackerParameters(smoother="polynomial"))
    assert np.abs(lines[-1] - scene.truth[-1]).max() > 100.0
    np.testing.assert_allclose(parabolas[-1], scene.truth[-1], atol=1e-3)


def test_quiet_flight_is_taken_for_a_manoeuvre_as_often_as_wanted(flights, smooth):
    tracks = 1500
    scene = flights(tracks, 6, 23)
    sigmas, wanted = 2.0, 0.0455
    parabolas, _ = smooth(
        scene, TrackerParameters(smoother="polynomial", manoeuvre_sigmas=sigmas, acceleration=0.0)
    )
    lines, _ = smooth(
        scene, TrackerParameters(smoother="polynomial", polynomial_degree=1, acceleration=0.0)
    )
    declared = (parabolas[-1] != lines[-1]).any(axis=1).mean()
    assert declared == pytest.approx(wanted, abs=4.0 * np.sqrt(wanted / tracks))
