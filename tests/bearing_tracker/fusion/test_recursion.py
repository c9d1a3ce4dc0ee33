# SPDX-License-Identifier: Apache-2.0
"""The paper's recursion against programs and formulas written apart from it."""

from __future__ import annotations

import numpy as np
import pytest
from filterpy.kalman import IMMEstimator, KalmanFilter
from scipy.stats import multivariate_normal

from bearing_tracker.fusion import FILTERS


def stacked(channels, hypothesis):
    j, m = divmod(hypothesis, channels.passive.states)
    observation = np.vstack([channels.active.observation[j], channels.passive.observation[m]])
    first, second = channels.active.noise[j], channels.passive.noise[m]
    noise = np.zeros((len(observation), len(observation)))
    noise[: len(first), : len(first)] = first @ first.T
    noise[len(first) :, len(first) :] = second @ second.T
    return observation, noise


def textbook(scene, target):
    channels, motion = scene.channels, scene.motions[0]
    filters = []
    for hypothesis in range(channels.hypotheses):
        kalman = KalmanFilter(dim_x=3, dim_z=3)
        kalman.x, kalman.P = scene.mean[target].copy(), scene.covariance.copy()
        kalman.F, kalman.Q = motion.transition, motion.noise
        kalman.H, kalman.R = stacked(channels, hypothesis)
        filters.append(kalman)
    size = channels.hypotheses
    chain = np.kron(channels.active.transition, channels.passive.transition)
    return IMMEstimator(filters, np.full(size, 1.0 / size), chain)


def test_the_mean_over_hypotheses_is_an_interacting_multiple_model_filter(make_linear_scene):
    scene = make_linear_scene()
    tracker, beliefs = scene.follow("dcmp")
    for target in range(len(scene.mean)):
        imm = textbook(scene, target)
        for belief, active, passive in zip(beliefs, scene.active, scene.passive, strict=True):
            imm.predict()
            imm.update(np.concatenate([active.value[target], passive.value[target]]))
            answer = tracker.estimate(belief)
            np.testing.assert_allclose(answer.mean[target], imm.x, atol=1e-12, rtol=1e-12)
            np.testing.assert_allclose(answer.covariance[target], imm.P, atol=1e-12, rtol=1e-12)
            probability = np.exp(belief.log_probability[target])
            np.testing.assert_allclose(probability, imm.mu, atol=1e-12)


def test_the_blocks_of_the_gain_are_those_of_10_and_11(make_linear_scene):
    """The corrected blocks, n_y1 = 2 and n_y2 = 1, are the gain of the joint update, and so is what the filter does."""
    scene = make_linear_scene(steps=1)
    channels, motion = scene.channels, scene.motions[0]
    _, (belief,) = scene.follow("bank")
    predicted = motion.transition @ scene.covariance @ motion.transition.T + motion.noise
    for hypothesis in range(channels.hypotheses):
        observation, noise = stacked(channels, hypothesis)
        h1, h2 = observation[:2], observation[2:]
        joint = observation @ predicted @ observation.T + noise
        r11, r12, r22 = joint[:2, :2], joint[:2, 2:], joint[2:, 2:]
        i22 = np.linalg.inv(r22)
        s1 = np.linalg.inv(r11 - r12 @ i22 @ r12.T)
        k1 = predicted @ h1.T @ s1 - predicted @ h2.T @ i22 @ r12.T @ s1
        k2 = -predicted @ h1.T @ s1 @ r12 @ i22
        k2 += predicted @ h2.T @ (i22 + i22 @ r12.T @ s1 @ r12 @ i22)
        gain = np.linalg.solve(joint, observation @ predicted).T
        np.testing.assert_allclose(np.hstack([k1, k2]), gain, atol=1e-12)
        value = np.hstack([scene.active[0].value, scene.passive[0].value])
        start = scene.mean @ motion.transition.T
        after = start + (value - start @ observation.T) @ gain.T
        np.testing.assert_allclose(belief.mean[:, hypothesis], after, atol=1e-12)
        left = predicted - gain @ observation @ predicted
        np.testing.assert_allclose(
            belief.covariance[:, hypothesis], [left] * len(after), atol=1e-12
        )


@pytest.mark.parametrize("name", ["dcmp", "gpb1", "gpb2"])
def test_one_step_is_exact(name, make_linear_scene):
    """From one common Gaussian the exact posterior is a mixture of M; the first step has nothing to approximate."""
    scene = make_linear_scene(steps=1)
    channels, motion = scene.channels, scene.motions[0]
    _, (belief,) = scene.follow(name)
    predicted = motion.transition @ scene.covariance @ motion.transition.T + motion.noise
    chain = np.kron(channels.active.transition, channels.passive.transition)
    prior = chain.mean(axis=0)
    value = np.hstack([scene.active[0].value, scene.passive[0].value])
    for target in range(len(value)):
        posterior = np.array(
            [
                p
                * multivariate_normal.pdf(
                    value[target],
                    h @ motion.transition @ scene.mean[target],
                    h @ predicted @ h.T + r,
                )
                for p, (h, r) in zip(
                    prior, (stacked(channels, k) for k in range(len(prior))), strict=True
                )
            ]
        )
        found = np.exp(belief.log_probability[target])
        np.testing.assert_allclose(found, posterior / posterior.sum(), atol=1e-12)


def test_second_order_follows_every_pair(make_linear_scene):
    """After two steps, from one Gaussian, the pseudo-Bayesian estimator of order 2 still is the exact mixture."""
    scene = make_linear_scene(steps=2, targets=1)
    channels, motion = scene.channels, scene.motions[0]
    size = channels.hypotheses
    chain = np.kron(channels.active.transition, channels.passive.transition)
    values = [
        np.hstack([a.value[0], p.value[0]])
        for a, p in zip(scene.active, scene.passive, strict=True)
    ]

    def step(mean, covariance, hypothesis, value):
        observation, noise = stacked(channels, hypothesis)
        mean = motion.transition @ mean
        covariance = motion.transition @ covariance @ motion.transition.T + motion.noise
        joint = observation @ covariance @ observation.T + noise
        likelihood = multivariate_normal.pdf(value, observation @ mean, joint)
        gain = covariance @ observation.T @ np.linalg.inv(joint)
        mean = mean + gain @ (value - observation @ mean)
        return mean, covariance - gain @ observation @ covariance, likelihood

    weights, means = [], []
    for first in range(size):
        mean, covariance, likelihood = step(scene.mean[0], scene.covariance, first, values[0])
        weight = chain.mean(axis=0)[first] * likelihood
        for second in range(size):
            after, _, again = step(mean, covariance, second, values[1])
            weights.append(weight * chain[first, second] * again)
            means.append(after)
    exact = np.average(means, axis=0, weights=weights)
    np.testing.assert_allclose(scene.end("gpb2").mean[0], exact, atol=1e-12)
    assert np.abs(scene.end("dcmp").mean[0] - exact).max() > 1e-6


def test_the_told_filters_are_kalman_filters(make_linear_scene):
    scene = make_linear_scene(missing=True)
    for name in ("kalman", "oracle"):
        answer = scene.end(name)
        for target in range(len(scene.mean)):
            kalman = KalmanFilter(dim_x=3, dim_z=1)
            kalman.x, kalman.P = scene.mean[target].copy(), scene.covariance.copy()
            kalman.F, kalman.Q = scene.motions[0].transition, scene.motions[0].noise
            for readings in zip(scene.active, scene.passive, strict=True):
                kalman.predict()
                for reading, channel in zip(
                    readings, (scene.channels.active, scene.channels.passive), strict=True
                ):
                    if not reading.reported[target]:
                        continue
                    state = reading.state[target] if name == "oracle" else 0
                    noise = channel.noise[state] @ channel.noise[state].T
                    kalman.update(reading.value[target], R=noise, H=channel.observation[state])
            np.testing.assert_allclose(answer.mean[target], kalman.x, atol=1e-12)
            np.testing.assert_allclose(answer.covariance[target], kalman.P, atol=1e-12)


def test_filters_differ_only_in_where_hypotheses_start(make_linear_scene):
    """One step from one common state is the same for all that weigh hypotheses; the second is not."""
    weighing = ["dcmp", "gpb1", "gpb2", "bank", "reassignment"]
    one, two = make_linear_scene(steps=1), make_linear_scene(steps=2)
    first = [one.end(name).mean for name in weighing]
    second = [two.end(name).mean for name in weighing]
    for mean in first[1:]:
        np.testing.assert_allclose(mean, first[0], atol=1e-12)
    for k, mean in enumerate(second):
        assert all(np.abs(mean - other).max() > 1e-8 for other in second[:k])
    assert set(weighing) < set(FILTERS)
