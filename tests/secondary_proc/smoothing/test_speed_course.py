# SPDX-License-Identifier: Apache-2.0
"""The drift that the book's tracker of speed and course has, and its cure; what the detectors do to each of the two."""

from __future__ import annotations

import numpy as np
import pytest

from secondary_proc.calculators.exponential_smoothing import (
    exponential_variance,
    optimal_zeta,
)
from secondary_proc.motion import noise_density
from secondary_proc.parameters import TrackerParameters


def position_errors(flights, smooth, feedback, plots):
    scene = flights(100, plots, 31, scale=0.5)
    parameters = TrackerParameters(
        smoother="speed_course",
        position_feedback=feedback,
        acceleration=3.0,
        manoeuvre_acceleration=8.0,
        manoeuvre_sigmas=1.0,
    )
    states, _ = smooth(scene, parameters)
    away = (states - scene.truth[1:])[..., :2]
    return np.sqrt((away**2).sum(axis=-1).mean(axis=1))


def test_without_feedback_the_position_drifts_and_with_it_stays(flights, smooth):
    drifting = position_errors(flights, smooth, 0.0, 140)
    held = position_errors(flights, smooth, 0.3, 140)
    assert drifting[120:].mean() > 2.0 * drifting[15:25].mean()
    assert held[120:].mean() == pytest.approx(held[15:25].mean(), rel=0.15)
    assert held[-1] < 0.5 * drifting[-1]


def test_full_feedback_is_the_plot_itself(flights, smooth):
    scene = flights(20, 10, 32)
    states, covariances = smooth(
        scene, TrackerParameters(smoother="speed_course", position_feedback=1.0)
    )
    np.testing.assert_allclose(states[1:, :, :2], scene.position[2:], atol=1e-6)
    np.testing.assert_allclose(covariances[1:, :, :2, :2], scene.covariance[2:], rtol=1e-9)


def test_the_steady_error_of_the_speed_is_the_book_s(flights, smooth):
    # Equal intervals and errors, straight flight to the north: one coefficient all the time.
    scene = flights(1, 80, 33, noise=0.0)
    period, error, acceleration = 4.0, 30.0, 1.0
    scene.seconds[:] = period
    scene.truth[..., 2:] = [0.0, 250.0]
    scene.truth[..., 0] = 0.0
    scene.truth[..., 1] = 20e3 + 250.0 * period * np.arange(80)[:, None]
    scene.position[:] = scene.truth[..., :2]
    scene.covariance[:] = error**2 * np.eye(2)
    parameters = TrackerParameters(
        smoother="speed_course", acceleration=acceleration, position_feedback=0.5
    )
    _, covariances = smooth(scene, parameters)
    pair = 2.0 * error**2 / period**2
    zeta = optimal_zeta((acceleration * period) ** 2 / pair)
    # The target's own gains of speed come on top; the new value knows their mean since the last plot.
    gains = noise_density(acceleration) * period / (1.0 - zeta**2)
    own = gains * ((1.0 - zeta) ** 2 / 3.0 + zeta)
    expected = pair * float(exponential_variance(zeta)) + own
    assert covariances[-1, 0, 3, 3] == pytest.approx(expected, rel=0.01)
    quiet = TrackerParameters(smoother="speed_course", acceleration=1e-9, position_feedback=0.5)
    _, growing = smooth(scene, quiet)
    plots = len(scene.position)
    assert growing[-1, 0, 3, 3] == pytest.approx(
        2.0 * (error / period / (plots - 1)) ** 2, rel=1e-3
    )


def test_a_change_of_speed_leaves_the_course_alone(flights, smooth):
    scene = flights(40, 60, 34, scale=0.25)
    time = np.concatenate([np.zeros((1, 40)), np.cumsum(scene.seconds, axis=0)])
    unit = scene.truth[:, :, 2:] / 250.0
    since = np.maximum(time - 150.0, 0.0)[..., None]
    scene.truth[..., 2:] += unit * 4.0 * np.minimum(since, 25.0)
    more = 2.0 * np.minimum(since, 25.0) ** 2 + 100.0 * np.maximum(since - 25.0, 0.0)
    scene.truth[..., :2] += unit * more
    scene.position[:] += unit * more
    parameters = TrackerParameters(smoother="speed_course", speed_course_weights="weighted_mean")
    states, _ = smooth(scene, parameters)
    speed = np.hypot(states[-1, :, 2], states[-1, :, 3])
    assert np.median(np.abs(speed - 350.0)) < 10.0
    flown = np.arctan2(*states[-1, :, 2:].T) - np.arctan2(*scene.truth[-1, :, 2:].T)
    # The mean of all courses since the beginning, hence better than those since the change of speed could be.
    assert np.sqrt(np.mean(np.angle(np.exp(1j * flown)) ** 2)) < 0.01
