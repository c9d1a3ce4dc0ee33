# SPDX-License-Identifier: Apache-2.0
"""Interacting models against a well-known implementation; switching by time; turns; errors in matched manoeuvres."""

from __future__ import annotations

import numpy as np
import pytest
from filterpy.kalman import IMMEstimator, KalmanFilter
from scipy.linalg import expm

from secondary_proc.motion import noise_density, unit_noise
from secondary_proc.parameters import TrackerParameters
from secondary_proc.smoothing import SMOOTHERS
from secondary_proc.smoothing.interacting_models import InteractingModelsSmoother
from secondary_proc.smoothing.manoeuvre import ManoeuvreDetector
from secondary_proc.smoothing.motion_models import CoordinatedTurn, UniformMotion

INTERVAL, DURATION = 60.0, 20.0
QUIET, MANOEUVRE = 0.4, 200.0


def two_models():
    models = [UniformMotion(QUIET), UniformMotion(MANOEUVRE)]
    # No plot is so surprising that the second model is widened.
    return InteractingModelsSmoother(models, 5.0, INTERVAL, DURATION, ManoeuvreDetector(30.0))


def test_it_is_that_of_filterpy_on_the_same_plots(flights, smooth, monkeypatch):
    period = 4.0
    scene = flights(1, 40, 11, density=20.0)
    scene.seconds[:] = period
    smoother = two_models()
    monkeypatch.setitem(SMOOTHERS, "imm", lambda parameters: smoother)
    states, covariances = smooth(scene, TrackerParameters(smoother="imm"))
    filters = []
    for density in (QUIET, MANOEUVRE):
        peer = KalmanFilter(dim_x=4, dim_z=2)
        peer.H, peer.F = np.eye(2, 4), np.eye(4) + period * np.eye(4, k=2)
        peer.Q = density * unit_noise(np.array([period]))[0]
        peer.x, peer.P = states[0, 0][:, None].copy(), covariances[0, 0].copy()
        filters.append(peer)
    quiet = INTERVAL / (INTERVAL + DURATION)
    jump = smoother.transition(np.array([period]))[0]
    peer = IMMEstimator(filters, [quiet, 1.0 - quiet], jump)
    for plot in range(2, len(scene.position)):
        for single in filters:
            single.R = scene.covariance[plot, 0]
        peer.predict()
        peer.update(scene.position[plot, 0][:, None])
        # Ours never lets the weight of a model vanish; that makes the last digits.
        np.testing.assert_allclose(states[plot - 1, 0], peer.x[:, 0], rtol=1e-5, atol=1e-2)
        np.testing.assert_allclose(covariances[plot - 1, 0], peer.P, rtol=1e-3, atol=1e-2)


@pytest.mark.parametrize("kinds", [1, 2])
def test_switching_follows_its_rates_whatever_the_interval(kinds):
    models = [UniformMotion(1.0)] * (kinds + 1)
    detector = ManoeuvreDetector(3.0)
    smoother = InteractingModelsSmoother(models, 5.0, INTERVAL, DURATION, detector)
    rates = np.zeros((kinds + 1, kinds + 1))
    rates[0, 1:], rates[1:, 0] = 1.0 / INTERVAL / kinds, 1.0 / DURATION
    rates -= np.diag(rates.sum(axis=1))
    seconds = np.array([0.0, 0.5, 4.0, 10.0, 120.0])
    for dt, matrix in zip(seconds, smoother.transition(seconds), strict=True):
        np.testing.assert_allclose(matrix, expm(rates * dt), atol=1e-12)


def test_a_turn_is_a_circle_and_its_derivatives_are_right():
    model = CoordinatedTurn(0.0, 30.0)
    state = np.array([[1e3, 2e3, 150.0, -80.0, 0.05], [1e3, 2e3, 150.0, -80.0, 0.0]])
    seconds, none = np.full(2, 7.0), np.zeros(2)
    moved, _ = model.predict(state, np.zeros((2, 5, 5)), seconds, none)
    speed = np.hypot(*moved[:, 2:4].T)
    np.testing.assert_allclose(speed, np.hypot(150.0, 80.0), rtol=1e-12)
    # The centre of the circle stays where it was: to the left of an anticlockwise turn.
    for before, after in ((state[0], moved[0]),):
        left = np.array([-before[3], before[2]]), np.array([-after[3], after[2]])
        centre = [
            place[:2] + aside / before[4]
            for place, aside in zip((before, after), left, strict=True)
        ]
        np.testing.assert_allclose(centre[0], centre[1], atol=1e-6)
    np.testing.assert_allclose(moved[1, :2], state[1, :2] + 7.0 * state[1, 2:4], atol=0.1)
    for axis in range(5):
        covariance = np.zeros((2, 5, 5))
        covariance[:, axis, axis] = 1.0
        _, spread = model.predict(state, covariance, seconds, none)
        step = np.zeros(5)
        step[axis] = 1e-4
        plus, _ = model.predict(state + step, covariance, seconds, none)
        minus, _ = model.predict(state - step, covariance, seconds, none)
        slope = (plus - minus)[0] / 2e-4
        np.testing.assert_allclose(spread[0], np.outer(slope, slope), rtol=1e-4, atol=1e-3)


def test_turns_are_followed_best_by_the_model_that_knows_them(flights, smooth):
    scene = flights(60, 60, 12, noise=0.0, scale=0.5)
    random = np.random.default_rng(13)
    rate, time = 0.05, np.cumsum(scene.seconds, axis=0)
    truth = scene.truth
    start, velocity = truth[0, :, :2].copy(), truth[0, :, 2:].copy()
    # Straight for two minutes, then a turn of 0.05 rad/s.
    turning = np.maximum(time - 120.0, 0.0)
    straight = time - turning
    heading = (velocity[:, 0] + 1j * velocity[:, 1]) * np.exp(1j * rate * turning)
    place = (start[:, 0] + 1j * start[:, 1]) + (velocity[:, 0] + 1j * velocity[:, 1]) * (
        straight + (np.exp(1j * rate * turning) - 1.0) / (1j * rate)
    )
    truth[1:] = np.stack([place.real, place.imag, heading.real, heading.imag], axis=-1)
    root = np.linalg.cholesky(scene.covariance)
    errors = (root @ random.standard_normal((*root.shape[:2], 2, 1)))[..., 0]
    scene.position[:] = truth[..., :2] + errors
    late = slice(40, None)

    def velocity_error(**chosen):
        states, _ = smooth(scene, TrackerParameters(**chosen))
        away = (states - truth[1:])[late, :, 2:]
        return np.sqrt((away**2).sum(axis=-1).mean())

    kalman = velocity_error(smoother="kalman")
    accelerations = velocity_error(smoother="imm")
    turns = velocity_error(smoother="imm", imm_manoeuvres="turns")
    assert accelerations < kalman
    assert turns < 0.8 * accelerations


def test_errors_in_manoeuvres_have_the_covariance_that_is_told(flights, smooth):
    # A steady acceleration as often as quiet flight: no filter of two noises is exact here, but it must not be far off.
    acceleration, tracks = 4.0, 200
    scene = flights(tracks, 31, 14, density=noise_density(acceleration), scale=0.25)
    parameters = TrackerParameters(
        smoother="imm", acceleration=0.1, manoeuvre_acceleration=acceleration
    )
    states, covariances = smooth(scene, parameters)
    error = states[-1] - scene.truth[-1]
    square = np.einsum("ni,nij,nj->n", error, np.linalg.inv(covariances[-1]), error).mean()
    bound = 4.0 * np.sqrt(2.0 * 4.0 / tracks)
    assert 4.0 - bound < square < 1.25 * (4.0 + bound)
