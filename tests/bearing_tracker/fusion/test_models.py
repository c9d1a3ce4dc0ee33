# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import expm

from bearing_tracker.fusion import Channel, ChannelPair
from bearing_tracker.fusion.azimuth_channels import azimuth_channel
from bearing_tracker.fusion.chain import chain_after, shares_and_memory
from bearing_tracker.fusion.guidance import (
    decay_of_approach,
    guidance_covariance,
    guidance_motion,
)
from bearing_tracker.fusion.surveillance import surveillance_motion

DECAYS = [0.0, 1 / 350, 0.02, 0.1, 0.16, 0.5]


@pytest.mark.parametrize("decay", DECAYS)
def test_the_swing_is_stationary(decay):
    motion = guidance_motion(1.0, 0.16, decay, 0.7)
    covariance = guidance_covariance(0.16, decay, 0.7)
    after = motion.transition @ covariance @ motion.transition.T + motion.noise
    np.testing.assert_allclose(after, covariance, atol=1e-12)


@pytest.mark.parametrize(("decay", "residual"), [(1 / 350, 8e-6), (0.02, 4e-4), (0.1, 8e-3)])
def test_as_printed_it_is_not(decay, residual):
    """Phi_21 = -mu sin and Gamma_22 = sqrt(mu^2 - alpha^2), D = 1; its best covariance is D [[1, -alpha], ...]."""
    mu = 0.16
    motion = guidance_motion(1.0, mu, decay, 1.0)
    printed = motion.transition.copy()
    printed[1, 0] = -np.exp(-decay) * mu * np.sin(mu)
    shape = np.sqrt(-np.expm1(-2 * decay)) * np.array([[1, 0], [-decay, np.sqrt(mu**2 - decay**2)]])
    covariance = np.array([[1.0, -decay], [-decay, mu**2]])
    left = covariance - printed @ covariance @ printed.T - shape @ shape.T
    assert np.abs(left).max() == pytest.approx(residual, rel=0.5)


def test_the_autocorrelation_is_a_damped_cosine():
    mu, decay, period = 0.16, 0.03, 0.5
    motion = guidance_motion(period, mu, decay, 2.0)
    lag = guidance_covariance(mu, decay, 2.0)
    for step in range(60):
        expected = 4.0 * np.exp(-decay * step * period) * np.cos(mu * step * period)
        assert lag[0, 0] == pytest.approx(expected, abs=1e-12)
        lag = motion.transition @ lag


def test_the_motion_is_that_of_the_differential_equation():
    mu, decay = 0.16, 0.05
    rate = np.array([[0.0, 1.0], [-(mu**2 + decay**2), -2.0 * decay]])
    np.testing.assert_allclose(
        guidance_motion(1.7, mu, decay, 1.0).transition, expm(1.7 * rate), atol=1e-14
    )


def test_decay_follows_range_and_closing_speed():
    """1 / alpha is half of what the paper's text calls it: 10 km at 250 m/s are 40 s, alpha is 1 / 20 s."""
    distance = np.array([10_000.0, 10_000.0, np.nan, 10_000.0, 0.0])
    speed = np.array([250.0, -30.0, 250.0, np.nan, 250.0])
    found = decay_of_approach(distance, speed, 0.003)
    np.testing.assert_allclose(found, [0.05, 0.003, 0.003, 0.003, 0.003])


def test_each_target_has_its_own_swing():
    decay = np.array([0.01, 0.02, 0.04])
    seconds = np.array([1.0, 2.0, 0.5])
    axis = np.array([0.1, 3.0, -2.0])
    motion = guidance_motion(seconds, 0.16, decay, 0.3, axis)
    for k in range(3):
        alone = guidance_motion(seconds[k], 0.16, decay[k], 0.3)
        np.testing.assert_allclose(motion.transition[k], alone.transition, atol=1e-15)
        np.testing.assert_allclose(motion.noise[k], alone.noise, atol=1e-15)
    np.testing.assert_array_equal(motion.axis, np.stack([axis, np.zeros(3)], axis=1))


@pytest.mark.parametrize(
    "make",
    [
        lambda t: surveillance_motion(t, 30e3, 2.0, 10.0, 100.0),
        lambda t: guidance_motion(t, 0.16, 0.02, 1.0),
    ],
)
def test_two_short_steps_are_one_long(make):
    first, second, whole = make(1.3), make(2.7), make(4.0)
    np.testing.assert_allclose(second.transition @ first.transition, whole.transition, atol=1e-14)
    noise = second.transition @ first.noise @ second.transition.T + second.noise
    np.testing.assert_allclose(noise, whole.noise, rtol=1e-12, atol=1e-18)


def test_near_targets_turn_faster():
    near, far = (surveillance_motion(4.0, d, 2.0, 10.0).noise for d in (10e3, 40e3))
    np.testing.assert_allclose(near, 16.0 * far, rtol=1e-12)


def test_the_bend_of_a_straight_flight_is_the_largest_there_is():
    speed, distance = 200.0, 5000.0
    t = np.linspace(-60.0, 60.0, 200_001)
    rate = speed * distance / (distance**2 + (speed * t) ** 2)
    largest = np.abs(np.gradient(rate, t)).max()
    density = surveillance_motion(1.0, distance, 0.0, 1.0, speed).noise[1, 1]
    assert np.sqrt(density) == pytest.approx(largest, rel=1e-4)


def test_chains_over_steps_of_any_length_fit_together():
    shares = (0.7, 0.2, 0.1)
    seconds = np.array([0.0, 0.4, 3.0, 1e6])
    chains = chain_after(shares, 12.0, seconds)
    np.testing.assert_allclose(chains.sum(axis=-1), 1.0, atol=1e-15)
    np.testing.assert_array_equal(chains[0], np.eye(3))
    np.testing.assert_allclose(chains[3], [shares] * 3, atol=1e-15)
    both = chain_after(shares, 12.0, 3.4)
    np.testing.assert_allclose(chains[1] @ chains[2], both, atol=1e-15)


def test_two_states_stay_as_long_as_asked():
    shares, memory = shares_and_memory(100.0, 25.0)
    short = 1e-4
    chain = chain_after(shares, memory, short)
    assert short / chain[0, 1] == pytest.approx(100.0, rel=1e-4)
    assert short / chain[1, 0] == pytest.approx(25.0, rel=1e-4)


@pytest.mark.parametrize(
    "make",
    [
        lambda: guidance_motion(1.0, 0.0, 0.1, 1.0),
        lambda: guidance_motion(-1.0, 0.1, 0.1, 1.0),
        lambda: guidance_motion(1.0, 0.1, np.nan, 1.0),
        lambda: surveillance_motion(1.0, 0.0, 1.0, 1.0),
        lambda: surveillance_motion(np.nan, 1e4, 1.0, 1.0),
        lambda: surveillance_motion(1.0, 1e4, -1.0, 1.0),
        lambda: chain_after((0.5, 0.6), 1.0, 1.0),
        lambda: chain_after((0.5, 0.5), 0.0, 1.0),
        lambda: chain_after((0.5, 0.5), 1.0, -1.0),
        lambda: shares_and_memory(0.0, 1.0),
        lambda: azimuth_channel(np.eye(2), (1.0, 0.0), (1.0, 1.0)),
        lambda: azimuth_channel(np.eye(2), (1.0,), (1.0, 1.0)),
        lambda: azimuth_channel(np.eye(3), (1.0, 1.0), (1.0, 1.0)),
        lambda: azimuth_channel(((0.5, 0.4), (0.0, 1.0)), (1.0, 1.0), (1.0, 1.0)),
        lambda: azimuth_channel(((1.5, -0.5), (0.0, 1.0)), (1.0, 1.0), (1.0, 1.0)),
        lambda: azimuth_channel(np.eye(2), (1.0, np.inf), (1.0, 1.0)),
    ],
)
def test_what_makes_no_sense_is_refused(make):
    with pytest.raises(ValueError, match=r"."):
        make()


def test_channels_must_fit_together(make_linear_scene):
    active = azimuth_channel(np.eye(2), (1.0, 2.0), (1.0, 1.0))
    passive = make_linear_scene(targets=1).channels.passive
    with pytest.raises(ValueError, match="different dimensions"):
        ChannelPair(active, passive, np.array([True, False]))
    with pytest.raises(ValueError, match="do not fit"):
        Channel(np.eye(2), np.zeros((2, 1, 2)), np.zeros((2, 2, 2)), np.array([True]))
