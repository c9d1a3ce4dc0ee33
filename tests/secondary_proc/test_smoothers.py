# SPDX-License-Identifier: Apache-2.0
"""The prediction, and the Kalman filter against a well-known one."""

from __future__ import annotations

import numpy as np
from filterpy.kalman import KalmanFilter
from hypothesis import given, settings
from hypothesis import strategies as st

from radar_common.frames import enu_covariance, enu_from_polar
from secondary_proc.motion import predict_covariance, predict_state
from secondary_proc.smoothing import Measured
from secondary_proc.smoothing.kalman import KalmanSmoother
from secondary_proc.smoothing.manoeuvre import ManoeuvreDetector

PERIOD = 4.0


def transition(seconds):
    matrix = np.eye(4)
    matrix[0, 2] = matrix[1, 3] = seconds
    return matrix


def process_noise(seconds, density):
    block = density * np.array([[seconds**3 / 3, seconds**2 / 2], [seconds**2 / 2, seconds]])
    return np.kron(block, np.eye(2))


def random_covariances(random, count):
    root = random.normal(size=(count, 4, 4)) * np.array([100.0, 100.0, 10.0, 10.0])[:, None]
    return root @ root.transpose(0, 2, 1) + np.eye(4)


@settings(max_examples=30)
@given(seconds=st.floats(0.1, 30.0), density=st.floats(0.0, 100.0), seed=st.integers(0, 99))
def test_prediction_is_the_matrix_product(seconds, density, seed):
    random = np.random.default_rng(seed)
    covariance, state = random_covariances(random, 3), random.normal(size=(3, 4))
    matrix = transition(seconds)
    each = np.full(3, seconds)
    np.testing.assert_allclose(predict_state(state, each), state @ matrix.T, atol=1e-9)
    np.testing.assert_allclose(
        predict_covariance(covariance, each, density),
        matrix @ covariance @ matrix.T + process_noise(seconds, density),
        rtol=1e-9,
        atol=1e-6,
    )


def test_kalman_is_that_of_filterpy_on_the_same_plots():
    random = np.random.default_rng(5)
    density = 0.4
    smoother = KalmanSmoother(density, density, ManoeuvreDetector(3.0))
    peer = KalmanFilter(dim_x=4, dim_z=2)
    peer.H = np.eye(2, 4)
    peer.x = np.array([[20e3], [30e3], [100.0], [-150.0]])
    peer.P = np.diag([200.0, 300.0, 40.0, 40.0]) ** 2
    state, covariance, memory = peer.x.T.copy(), peer.P[None].copy(), np.zeros(1)
    for hits in range(3, 40):
        seconds = random.uniform(3.0, 13.0)
        distance, azimuth = np.array([36e3]), random.uniform(0.5, 0.7, 1)
        position = np.stack(enu_from_polar(distance, azimuth), axis=1)
        errors = enu_covariance(distance, azimuth, [20.0], [0.002])
        smoothed = smoother.update(
            Measured(
                state,
                covariance,
                memory,
                np.array([hits]),
                np.array([seconds]),
                position,
                errors,
                azimuth,
            )
        )
        state, covariance, memory = smoothed.state, smoothed.covariance, smoothed.memory
        peer.predict(F=transition(seconds), Q=process_noise(seconds, density))
        peer.update(position.T, R=errors[0])
        np.testing.assert_allclose(state[0], peer.x[:, 0], rtol=1e-8)
        np.testing.assert_allclose(covariance[0], peer.P, rtol=1e-6, atol=1e-8)


def test_a_surprise_opens_the_bandwidth_and_it_closes_again():
    detector = ManoeuvreDetector(3.0)
    smoother = KalmanSmoother(0.1, 200.0, detector)
    state = np.zeros((2, 4))
    covariance = np.diag([50.0, 50.0, 5.0, 5.0])[None].repeat(2, axis=0) ** 2
    error = 20.0**2 * np.eye(2)[None].repeat(2, axis=0)
    # Just below and just above the threshold, as the quiet filter sees it.
    spread = 50.0**2 + (5.0 * PERIOD) ** 2 + 0.1 * PERIOD**3 / 3 + 20.0**2
    jump = np.sqrt(spread * detector.thresholds[1]) * np.array([0.99, 1.01])
    position = np.stack([jump, np.zeros(2)], axis=1)
    each = np.full(2, PERIOD)
    first = smoother.update(
        Measured(state, covariance, np.zeros(2), np.full(2, 5), each, position, error, np.zeros(2))
    )
    assert list(first.memory) == [0.0, 1.0]
    assert first.covariance[1, 2, 2] > first.covariance[0, 2, 2]
    following = first.state[:, :2] + first.state[:, 2:] * PERIOD
    second = smoother.update(
        Measured(
            first.state,
            first.covariance,
            first.memory,
            np.full(2, 6),
            each,
            following,
            error,
            np.zeros(2),
        )
    )
    assert 0.0 == second.memory[0] < second.memory[1] < 1.0
