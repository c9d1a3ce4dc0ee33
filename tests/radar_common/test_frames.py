# SPDX-License-Identifier: Apache-2.0
"""Angles wrap, frames turn the right way, and every conversion has its inverse."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from radar_common import frames

ANGLES = st.floats(-1e4, 1e4)
SMALL = st.floats(-1e-300, 1e-300)


@given(ANGLES | SMALL)
def test_wrapped_angles_are_in_range_and_point_the_same_way(angle):
    full, half = float(frames.wrap_two_pi(angle)), float(frames.wrap_pi(angle))
    assert 0.0 <= full < frames.TWO_PI
    assert -np.pi <= half < np.pi
    for wrapped in (full, half):
        assert np.cos(wrapped - angle) == pytest.approx(1.0, abs=1e-9)


@pytest.mark.parametrize(
    ("azimuth", "yaw"),
    [(0.0, np.pi / 2), (np.pi / 2, 0.0), (np.pi, -np.pi / 2), (1.5 * np.pi, -np.pi)],
    ids=["north", "east", "south", "west"],
)
def test_cardinal_directions(azimuth, yaw):
    assert float(frames.yaw_from_azimuth(azimuth)) == pytest.approx(yaw)
    assert float(frames.azimuth_from_yaw(yaw)) == pytest.approx(azimuth)
    x, y = frames.enu_from_polar(2.0, azimuth)
    assert x == pytest.approx(2.0 * np.cos(yaw), abs=1e-12)
    assert y == pytest.approx(2.0 * np.sin(yaw), abs=1e-12)


@given(ANGLES)
def test_yaw_is_the_inverse_of_azimuth(angle):
    there_and_back = frames.azimuth_from_yaw(frames.yaw_from_azimuth(angle))
    assert float(frames.wrap_pi(there_and_back - angle)) == pytest.approx(0.0, abs=1e-9)


@given(st.floats(1e-3, 1e6), ANGLES)
def test_polar_is_the_inverse_of_enu(distance, azimuth):
    back_range, back_azimuth = frames.polar_from_enu(*frames.enu_from_polar(distance, azimuth))
    assert float(back_range) == pytest.approx(distance)
    assert float(frames.wrap_pi(back_azimuth - azimuth)) == pytest.approx(0.0, abs=1e-8)


def test_the_covariance_is_that_of_sampled_errors():
    rng = np.random.default_rng(1)
    count, distance, azimuth, range_std, azimuth_std = 200_000, 50e3, 0.7, 30.0, 2e-3
    x, y = frames.enu_from_polar(
        distance + range_std * rng.standard_normal(count),
        azimuth + azimuth_std * rng.standard_normal(count),
    )
    expected = frames.enu_covariance(distance, azimuth, range_std, azimuth_std)
    # A variance estimated from n samples has the relative deviation sqrt(2 / n); four of them are allowed.
    np.testing.assert_allclose(
        np.cov(x, y), expected, atol=4 * np.sqrt(2 / count) * expected.diagonal().max()
    )


@given(st.floats(0, 4e5), ANGLES, st.floats(1e-2, 1e4), st.floats(1e-6, 0.2))
def test_covariances_are_positive_definite(distance, azimuth, range_std, azimuth_std):
    covariance = frames.enu_covariance(
        np.array([distance]), np.array([azimuth]), np.array([range_std]), np.array([azimuth_std])
    )
    assert covariance.shape == (1, 2, 2)
    assert np.linalg.eigvalsh(covariance).min() >= -1e-9 * covariance.max()


def test_ground_range_of_a_known_height():
    np.testing.assert_allclose(
        frames.ground_from_slant([5.0, 5.0, 3.0], [3.0, 0.0, 4.0]), [4, 5, 0]
    )
