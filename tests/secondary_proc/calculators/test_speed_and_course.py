# SPDX-License-Identifier: Apache-2.0
"""Smoothing and extrapolation by speed and course, against simulation, linear algebra and geometry."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from secondary_proc.calculators.exponential_smoothing import (
    exponential_lag,
    exponential_variance,
    exponential_weights,
    optimal_zeta,
    total_variance,
    turn_intensity,
    two_scan_detection,
)
from secondary_proc.calculators.speed_and_course import (
    book_variances,
    horizontal_range,
    linear_variances,
    motion,
)
from secondary_proc.calculators.speed_course_flowchart import Flowchart, run_flowchart
from secondary_proc.calculators.track_extrapolation import (
    polar_extrapolation,
    polar_variances,
    rectangular_covariance,
    rectangular_extrapolation,
)
from secondary_proc.calculators.weighted_mean import (
    combine,
    least_squares_ratio,
    mean_prediction_variance,
    mean_velocity_variance,
)

angles = st.floats(-3.1, 3.1)


def test_the_mean_weighs_by_accuracy():
    values, variances = np.array([3.0, 5.0, 4.0]), np.array([1.0, 4.0, 2.0])
    mean, variance = values[0], variances[0]
    for value, its in zip(values[1:], variances[1:], strict=True):
        mean, variance = combine(mean, variance, value, its)
    assert mean == pytest.approx(np.average(values, weights=1 / variances))
    assert variance == pytest.approx(1 / np.sum(1 / variances))


@pytest.mark.parametrize("n", range(2, 9))
def test_the_mean_of_speeds_hangs_on_its_ends(n):
    weights = np.diff(np.eye(n), axis=0).mean(axis=0)
    assert weights @ weights == pytest.approx(float(mean_velocity_variance(n)))
    next_one = weights + np.eye(n)[-1]
    assert next_one @ next_one == pytest.approx(float(mean_prediction_variance(n)))
    best = 12.0 / (n * (n**2 - 1.0))
    assert np.sqrt(best / (weights @ weights)) == pytest.approx(float(least_squares_ratio(n)))


@given(zeta=st.floats(0.0, 0.95))
def test_exponential_errors_are_the_sums_of_their_weights(zeta):
    eta = exponential_weights(zeta, 800)
    assert eta.sum() == pytest.approx(1.0)
    assert eta @ eta - eta[1:] @ eta[:-1] == pytest.approx(float(exponential_variance(zeta)))
    assert eta @ np.arange(1, 801) == pytest.approx(float(exponential_lag(zeta)))


@given(intensity=st.floats(1e-4, 3.0))
def test_no_other_coefficient_is_better(intensity):
    best = optimal_zeta(intensity)
    others = total_variance(np.linspace(0.0, 0.99, 400), intensity)
    assert total_variance(best, intensity) <= others.min() + 1e-12
    if best:
        assert turn_intensity(best) == pytest.approx(intensity, rel=1e-6)


def test_without_turns_there_is_no_best_coefficient():
    with pytest.raises(ValueError, match="intensity 0"):
        optimal_zeta(0.0)


@pytest.mark.parametrize(("turn", "sigmas"), [(0.0, 1.0), (0.8, 1.0), (1.5, 2.0)])
def test_the_two_scan_detector_declares_as_simulated(turn, sigmas):
    random = np.random.default_rng(2)
    trials = 40_000
    # Values of variance one from plots of variance one half.
    values = np.diff(np.sqrt(0.5) * random.normal(size=(trials, 4)), axis=1) + turn * np.arange(3)
    share = np.mean(((values[:, 2] - values[:, 0]) / 2.0) ** 2 >= 0.5 * sigmas**2)
    expected = float(two_scan_detection(turn, sigmas))
    assert abs(share - expected) < 4 * np.sqrt(expected * (1 - expected) / trials)


@given(
    place=st.tuples(st.floats(-1e5, 1e5), st.floats(1e3, 1e5)),
    course=angles,
    way=st.floats(10.0, 900.0),
)
def test_two_plots_tell_the_way_between_them(place, course, way):
    first = np.array(place)
    second = first + way * np.array([np.sin(course), np.cos(course)])
    seen = motion(np.hypot(*first), np.arctan2(*first), np.hypot(*second), np.arctan2(*second), 5.0)
    assert seen.path == pytest.approx(way, rel=1e-6)
    assert seen.speed == pytest.approx(way / 5.0, rel=1e-6)
    assert np.cos(seen.course - course) == pytest.approx(1.0, abs=1e-9)
    assert 0.0 <= seen.course_angle < 2 * np.pi


@given(course=angles)
def test_the_error_of_each_plot_is_that_of_both_where_they_are_close(course):
    book = book_variances(course - 0.3, 2e5, 100.0, 5.0, 60.0, 0.001)
    linear = linear_variances(course, [2e5, 2e5], [0.3, 0.3], 100.0, 5.0, 60.0, 0.001)
    np.testing.assert_allclose(book, linear)


@given(course=angles, azimuth=angles)
def test_polar_and_rectangular_predictions_are_one(course, azimuth):
    start = 40e3 * np.array([np.sin(azimuth), np.cos(azimuth)])
    there = rectangular_extrapolation(start, 250.0, course, 8.0)
    distance, direction = polar_extrapolation(40e3, azimuth, 2000.0, course)
    assert distance == pytest.approx(np.hypot(*there))
    assert np.cos(direction - np.arctan2(*there)) == pytest.approx(1.0)


def test_half_the_turn_is_the_direction_of_an_arc():
    turn, steps = 0.3, 20_000
    course = 0.5 + turn * (np.arange(steps) + 0.5) / steps
    arc = 2000.0 * np.array([np.sin(course).mean(), np.cos(course).mean()])
    half, whole = (
        rectangular_extrapolation(np.zeros(2), 250.0, 0.5, 8.0, turn=turn, chord=chord)
        for chord in (0.5, 1.0)
    )
    assert np.hypot(*(half - arc)) < 10.0
    assert np.hypot(*(whole - arc)) > 290.0
    faster = rectangular_extrapolation(np.zeros(2), 250.0, 0.0, 8.0, gain=20.0)
    assert faster[1] == pytest.approx(260.0 * 8.0)


def test_variances_of_the_prediction_are_those_of_a_simulation():
    random = np.random.default_rng(9)
    trials = 40_000
    noise = random.normal(size=(4, trials))
    position = np.stack([80.0 * noise[0], 50.0 * noise[1]], axis=-1)
    there = rectangular_extrapolation(
        position, 300.0 + 12.0 * noise[2], 0.8 + 0.04 * noise[3], 10.0
    )
    expected = rectangular_covariance(np.diag([80.0**2, 50.0**2]), 300.0, 0.8, 10.0, 144.0, 0.0016)
    found = np.cov(there.T)
    assert found == pytest.approx(expected, rel=0.05, abs=0.02 * np.trace(expected))
    near, aside = polar_variances(1e9, 0.8, 300.0, 10.0, 0.0, 0.0, 12.0, 0.04)
    # Far away, range and cross-range are the along and across of the same ellipse.
    assert near + aside * 1e18 == pytest.approx(np.trace(expected) - 80.0**2 - 50.0**2)


def test_height_shortens_the_range():
    assert horizontal_range(5.0, 3.0) == pytest.approx(4.0)


SETTINGS = {"period": 10.0, "range_std": 100.0, "azimuth_std": 1e-5}


def straight(scans, tracks, seed=1):
    noise = 100.0 * np.random.default_rng(seed).normal(size=(scans, tracks, 2))
    truth = np.zeros((scans, 1, 2))
    truth[:, 0, 1] = 1e7 + 3000.0 * np.arange(scans)
    plots = truth + noise
    return truth, np.hypot(*np.moveaxis(plots, -1, 0)), np.arctan2(*np.moveaxis(plots, -1, 0))


def test_the_flowchart_drifts_and_feedback_cures_it():
    truth, ranges, azimuths = straight(302, 200)
    errors = {}
    for feedback in (0.0, 0.3):
        followed = run_flowchart(Flowchart(**SETTINGS, feedback=feedback), ranges, azimuths)
        errors[feedback] = np.sqrt(((followed.position - truth[1:]) ** 2).mean(axis=(1, 2)))
    assert errors[0.0][300] > 2.0 * errors[0.0][50] > 400.0
    assert errors[0.3][20:].max() < 130.0


def test_full_feedback_stays_on_the_plots():
    _, ranges, azimuths = straight(20, 3)
    followed = run_flowchart(Flowchart(**SETTINGS, feedback=1.0), ranges, azimuths)
    np.testing.assert_allclose(followed.position[..., 0], (ranges * np.sin(azimuths))[1:])


def test_one_straight_scan_in_three_is_taken_for_a_manoeuvre():
    _, ranges, azimuths = straight(60, 400)
    followed = run_flowchart(Flowchart(**SETTINGS), ranges, azimuths)
    share = followed.course_manoeuvre[2:].mean()
    assert share == pytest.approx(float(two_scan_detection(0.0)), abs=0.04)
    calm = run_flowchart(Flowchart(**SETTINGS, sigmas=3.0), ranges, azimuths)
    assert calm.course_manoeuvre.mean() < 0.01
    assert not followed.speed_manoeuvre[:2].any()


def test_a_target_that_flies_across_north_is_followed_through():
    way = np.arange(-6, 7)[:, None] * np.array([300.0, 0.0]) + np.array([0.0, 20e3])
    ranges, azimuths = np.hypot(way[:, 0], way[:, 1]), np.arctan2(way[:, 0], way[:, 1])
    followed = run_flowchart(
        Flowchart(**SETTINGS | {"azimuth_std": 0.005}), ranges, azimuths % (2 * np.pi)
    )
    np.testing.assert_allclose(followed.velocity, np.tile([30.0, 0.0], (12, 1)), atol=1e-6)
    np.testing.assert_allclose(followed.position, way[1:], atol=1e-5)


def test_impossible_runs_are_refused():
    with pytest.raises(ValueError, match="two plots"):
        run_flowchart(Flowchart(**SETTINGS), np.ones(1), np.ones(1))
    with pytest.raises(ValueError, match="feedback"):
        run_flowchart(Flowchart(**SETTINGS, feedback=1.5), np.ones(3), np.ones(3))
