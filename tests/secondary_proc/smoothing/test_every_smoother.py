# SPDX-License-Identifier: Apache-2.0
"""What every smoother must hold to, in every way to use it."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from radar_common.frames import enu_covariance
from secondary_proc.smoothing import SMOOTHERS, Measured, SmoothingParameters


def test_the_variants_cover_all_smoothers(variants):
    assert {made["smoother"] for made in variants.values()} == set(SMOOTHERS)


def test_straight_flight_without_errors_is_followed_exactly(flights, smooth, variant):
    scene = flights(20, 40, 1, noise=0.0)
    states, _ = smooth(scene, variant())
    np.testing.assert_allclose(states, scene.truth[1:], rtol=0.0, atol=1e-3)


def test_a_wrong_start_is_forgotten(flights, smooth, variant):
    scene = flights(20, 80, 2, noise=0.0)
    wrong = scene.position.copy()
    wrong[0, :, 0] += 300.0
    scene.position[:] = wrong
    states, _ = smooth(scene, variant())
    errors = np.abs(states - scene.truth[1:]).max(axis=(1, 2))
    assert errors[0] > 30.0
    assert errors[-1] < 15.0


def test_errors_have_the_covariance_that_is_told(flights, smooth, straight_variant):
    # With one intensity for both, quiet flight and manoeuvre are the same, and the model is that of the flights.
    acceleration, tracks = 0.2, 500
    # Small errors, because speed and course are no linear functions of large ones.
    scene = flights(tracks, 31, 3, density=acceleration**2 * 4.0, scale=0.25)
    parameters = straight_variant(
        acceleration=acceleration, manoeuvre_acceleration=acceleration, manoeuvre_sigmas=5.0
    )
    states, covariances = smooth(scene, parameters)
    for plot in (0, 3, 9, 29):
        error = states[plot] - scene.truth[plot + 1]
        square = np.einsum("ni,nij,nj->n", error, np.linalg.inv(covariances[plot]), error)
        # Mean of chi-square of four degrees of freedom, four standard deviations to either side.
        assert square.mean() == pytest.approx(4.0, abs=4.0 * np.sqrt(2.0 * 4.0 / tracks))


def test_a_moved_scene_gives_moved_tracks(flights, smooth, variant):
    scene = flights(15, 25, 4, density=30.0)
    azimuth = np.arctan2(scene.position[..., 0], scene.position[..., 1])
    angle, shift = 0.7, np.array([3e3, -8e3])
    here = smooth(scene, variant())
    # Anticlockwise; azimuths run clockwise, and an error's axes turn but are not shifted.
    there = smooth(scene.moved(angle, shift), variant(), azimuth=azimuth - angle)
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    np.testing.assert_allclose(there[0][..., :2], here[0][..., :2] @ turn.T + shift, atol=1e-3)
    np.testing.assert_allclose(there[0][..., 2:], here[0][..., 2:] @ turn.T, atol=1e-4)
    both = np.kron(np.eye(2), turn)
    np.testing.assert_allclose(there[1], both @ here[1] @ both.T, rtol=1e-5, atol=1e-3)


def test_a_track_does_not_depend_on_its_neighbours(flights, smooth, variant):
    scene = flights(6, 25, 5, density=30.0)
    together = smooth(scene, variant())
    order = np.array([4, 2, 0])
    some = smooth(scene.only(order), variant())
    np.testing.assert_allclose(some[0], together[0][:, order], rtol=1e-9)
    np.testing.assert_allclose(some[1], together[1][:, order], rtol=1e-6, atol=1e-6)


def test_no_tracks_are_no_trouble(flights, smooth, variant):
    states, covariances = smooth(flights(0, 4, 6), variant())
    assert states.shape == (3, 0, 4)
    assert covariances.shape == (3, 0, 4, 4)


def test_a_track_of_another_smoother_is_taken_over(flights, smooth, variant):
    scene = flights(80, 45, 7)
    before = smooth(scene, variant().changed({"smoother": "kalman"}))
    rest = type(scene)(
        scene.seconds[29:], scene.truth[29:], scene.position[29:], scene.covariance[29:]
    )
    states, _ = smooth(rest, variant(), start=(before[0][29], before[1][29]))
    errors = np.linalg.norm((states - rest.truth[1:])[..., :2], axis=-1)
    plots = np.linalg.norm(rest.position[1:] - rest.truth[1:, :, :2], axis=-1)
    assert np.sqrt((errors**2).mean()) < 1.25 * np.sqrt((plots**2).mean())
    assert np.median(errors[0]) < np.median(plots[0])


@pytest.mark.parametrize("name", SMOOTHERS)
@settings(max_examples=6)
@given(
    seed=st.integers(0, 2**32 - 1),
    range_std=st.floats(5.0, 1e4),
    azimuth_std=st.floats(2e-4, 0.5),
    far=st.floats(10.0, 400e3),
)
def test_covariances_stay_symmetric_and_positive_definite(name, seed, range_std, azimuth_std, far):
    random = np.random.default_rng(seed)
    smoother = SMOOTHERS[name](SmoothingParameters())
    count = 80
    state = random.normal(size=(count, 4)) * 100.0
    root = random.normal(size=(count, 4, 4)) * np.array([100.0, 100.0, 10.0, 10.0])[:, None]
    covariance = root @ root.transpose(0, 2, 1) + np.eye(4)
    memory = np.zeros(count, smoother.memory)
    for hits in range(3, 15):
        azimuth = random.uniform(0, 2 * np.pi, count)
        errors = enu_covariance(
            np.full(count, far), azimuth, np.full(count, range_std), np.full(count, azimuth_std)
        )
        smoothed = smoother.update(
            Measured(
                state,
                covariance,
                memory,
                np.full(count, hits),
                random.uniform(1.0, 30.0, count),
                state[:, :2] + random.normal(size=(count, 2)) * 300.0,
                errors,
                azimuth,
            )
        )
        state, covariance, memory = smoothed.state, smoothed.covariance, smoothed.memory
        assert np.isfinite(state).all()
        np.testing.assert_array_equal(covariance, covariance.transpose(0, 2, 1))
        # Relative to the scale of each state: the correlation matrix has the definiteness.
        scale = np.sqrt(np.diagonal(covariance, axis1=1, axis2=2))
        correlation = covariance / scale[:, :, None] / scale[:, None, :]
        assert np.linalg.eigvalsh(correlation).min() > -1e-9
