# SPDX-License-Identifier: Apache-2.0
"""Filters against other people's, and the numbers they rest on against their definitions."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from filterpy.kalman import ExtendedKalmanFilter
from scipy import integrate, linalg, stats

from bearing_tracker.emitters import FILTERS, FilterSettings, Prior, mixture, motion
from bearing_tracker.emitters.corrections.interface import Look
from bearing_tracker.emitters.corrections.modified_polar import modified_polar
from bearing_tracker.emitters.corrections.sigma_points import cubature, triangular_root, unscented
from bearing_tracker.emitters.interface import CorrelatedError
from bearing_tracker.emitters.range_prior import range_bins, whole_range


def test_ekf_is_filterpys(usual):
    chosen = FILTERS["ekf"](FilterSettings(acceleration_std=0.05))
    ours = usual.run(chosen)
    begin = usual.run(chosen, 1)
    noise = np.array([[12.5, 0.0], [0.0, 12.5], [5.0, 0.0], [0.0, 5.0]])
    for row in range(3):
        peer = ExtendedKalmanFilter(dim_x=4, dim_z=1)
        peer.x = begin.mean[row, 0, 0][:, None]
        peer.P = begin.covariance[row, 0, 0].copy()
        peer.F = np.eye(4) + 5.0 * np.eye(4, k=2)
        peer.Q = noise @ noise.T * 0.05**2
        peer.R = np.array([[usual.std**2]])

        def jacobian(x, place):
            east, north = x[:2, 0] - place
            return np.array([[north, -east, 0.0, 0.0]]) / (east**2 + north**2)

        def azimuth(x, place):
            return np.array([[np.arctan2(*(x[:2, 0] - place))]])

        def wrapped(a, b):
            return np.mod(a - b + np.pi, 2 * np.pi) - np.pi

        for look in range(1, len(usual.azimuth)):
            place = usual.observer[look, row]
            peer.predict()
            peer.update(
                usual.azimuth[look, row], jacobian, azimuth,
                args=(place,), hx_args=(place,), residual=wrapped,
            )  # fmt: skip
        np.testing.assert_allclose(ours.mean[row, 0, 0], peer.x[:, 0], rtol=1e-6, atol=1e-6)
        np.testing.assert_allclose(ours.covariance[row, 0, 0], peer.P, rtol=1e-5, atol=1e-7)


def look_at(mean, observer, azimuth, std):
    return Look(
        np.full((1, 1, 1), azimuth),
        np.full((1, 1, 1), std**2),
        np.reshape(observer, (1, 1, 1, 2)),
        np.array([[[[30.0, -10.0]]]]),
        np.full((1, 1, 1), 1e3),
        np.full((1, 1, 1), 1e5),
    )


MEAN = np.array([9e3, 4e3, -5.0, 8.0])
COVARIANCE = np.diag([9e4, 4e4, 25.0, 9.0]) + 40.0 * (np.eye(4, k=2) + np.eye(4, k=-2))


@pytest.mark.parametrize("correction", [unscented, cubature, modified_polar])
def test_other_corrections_equal_the_kalman_filter_where_all_is_nearly_linear(correction):
    mean, covariance = MEAN[None, None, None], 1e-3 * COVARIANCE[None, None, None]
    seen = np.arctan2(MEAN[0] - 100.0, MEAN[1] + 200.0)
    look = look_at(mean, (100.0, -200.0), seen + 1e-4, 1e-3)
    got = correction(mean, covariance, look)
    relative = MEAN[:2] - (100.0, -200.0)
    h = np.array([relative[1], -relative[0], 0.0, 0.0]) / (relative @ relative)
    variance = h @ covariance[0, 0, 0] @ h + 1e-6
    gain = covariance[0, 0, 0] @ h / variance
    np.testing.assert_allclose(got.mean[0, 0, 0], MEAN + gain * 1e-4, atol=2e-3)
    kalman = covariance[0, 0, 0] - np.outer(gain, gain) * variance
    np.testing.assert_allclose(got.covariance[0, 0, 0], kalman, rtol=2e-3, atol=2e-4)
    assert got.log_likelihood[0, 0, 0] == pytest.approx(
        stats.norm.logpdf(1e-4, scale=np.sqrt(variance)), abs=1e-3
    )


def test_triangular_root_is_cholesky_and_never_fails():
    random = np.random.default_rng(1)
    some = random.standard_normal((20, 5, 7))
    matrices = some @ some.swapaxes(1, 2)
    np.testing.assert_allclose(triangular_root(matrices), np.linalg.cholesky(matrices))
    assert np.isfinite(triangular_root(np.ones((3, 4, 4)))).all()


def test_process_noise_is_the_papers():
    step = np.array([3.0])
    shape = np.array([[4.5, 0.0], [3.0, 0.0], [0.0, 4.5], [0.0, 3.0]])
    paper = shape @ shape.T * 0.2**2
    # The paper's x (north), Vx, z (east), Vz are our y, vy, x, vx.
    ours = np.array([2, 0, 3, 1])
    _, covariance = motion.propagate(np.zeros((1, 4)), np.zeros((1, 4, 4)), step, np.full(1, 0.2))
    np.testing.assert_allclose(covariance[0], paper[np.ix_(ours, ours)])


def test_lasting_error_keeps_its_variance():
    error = CorrelatedError(std=0.01, time=10.0)
    mean, covariance = np.ones((1, 5)), np.zeros((1, 5, 5))
    covariance[0, 4, 4], covariance[0, 4, 0] = 0.01**2, 2.0
    covariance[0, 0, 4] = 2.0
    motion.wander(mean, covariance, np.array([10.0]), error)
    assert mean[0, 4] == pytest.approx(np.exp(-1.0))
    assert covariance[0, 4, 4] == pytest.approx(0.01**2)
    assert covariance[0, 4, 0] == covariance[0, 0, 4] == pytest.approx(2.0 * np.exp(-1.0))


def test_inflation_is_the_variance_of_a_long_mean():
    error = CorrelatedError(std=0.8, time=10.0)
    inflated = motion.inflated_variance(np.array([1.0]), np.array([2.0]), error)
    # The root is 2.60 for one bearing in 2 s.
    assert np.sqrt(inflated[0]) == pytest.approx(2.60, abs=0.005)
    looks = 400
    lags = np.exp(-2.0 / 10.0 * np.arange(looks))
    covariance = 0.64 * linalg.toeplitz(lags) + 0.36 * np.eye(looks)
    assert covariance.mean() * looks == pytest.approx(inflated[0], rel=0.02)
    white = motion.inflated_variance(np.array([1.0]), np.array([1e4]), error)
    assert white[0] == pytest.approx(1.0)
    assert np.isfinite(motion.inflated_variance(np.array([1.0]), np.zeros(1), error)).all()


def test_switching_is_the_exponential_of_the_rates():
    rates = np.array([[-1 / 300.0, 1 / 300.0], [1 / 30.0, -1 / 30.0]])
    got = mixture.switching(np.array([0.0, 7.0, 1e9]), 300.0, 30.0)
    for passing, seconds in zip(got, (0.0, 7.0), strict=False):
        np.testing.assert_allclose(passing, linalg.expm(rates * seconds), atol=1e-12)
    np.testing.assert_allclose(got[2], [[10 / 11, 1 / 11]] * 2)


def test_moments_of_a_mixture():
    random = np.random.default_rng(2)
    weight = np.array([0.2, 0.5, 0.3])
    mean = random.standard_normal((3, 2))
    root = random.standard_normal((3, 2, 2))
    covariance = root @ root.swapaxes(1, 2)
    centre, spread = mixture.moments(weight, mean, covariance)
    np.testing.assert_allclose(centre, weight @ mean)
    second = sum(w * (p + np.outer(m, m)) for w, m, p in zip(weight, mean, covariance, strict=True))
    np.testing.assert_allclose(spread, second - np.outer(centre, centre))


def test_interaction_keeps_the_moments_of_a_bin():
    random = np.random.default_rng(5)
    weight = random.dirichlet(np.ones(6), 4).reshape(4, 3, 2)
    mean = random.standard_normal((4, 3, 2, 4))
    root = random.standard_normal((4, 3, 2, 4, 6))
    covariance = root @ root.swapaxes(-1, -2)
    passing = mixture.switching(np.full(4, 20.0), 300.0, 30.0)
    later = mixture.interacted(weight, mean, covariance, passing)
    for got, before in zip(
        mixture.moments(later[0] / later[0].sum(-1, keepdims=True), *later[1:]),
        mixture.moments(weight / weight.sum(-1, keepdims=True), mean, covariance),
        strict=True,
    ):
        np.testing.assert_allclose(got, before)


def test_ruled_out_bins_follow_the_rest():
    weight = np.array([[[1.0 - 1e-9], [1e-9]]])
    mean = np.array([[[[1.0, 2.0]], [[1e9, -1e9]]]])
    covariance = np.tile(np.eye(2), (1, 2, 1, 1, 1))
    later = mixture.revived(weight, mean, covariance)
    # Exactly the mixture's mean, to which the lost bin still gave its billionth.
    np.testing.assert_allclose(later[1][0, 1, 0], [2.0, 1.0], rtol=1e-6)
    np.testing.assert_array_equal(later[1][0, 0], mean[0, 0])
    assert later[0][0, 1, 0] == pytest.approx(1e-5, rel=1e-3)


def test_range_bins_cut_the_density():
    vague = Prior.between(1e3, 64e3, speed_std=10.0, emitters=1)
    bins = range_bins(vague, 6)
    np.testing.assert_allclose(bins.probability[0], 1 / 6)
    edges = 1e3 * 2.0 ** np.arange(7)
    np.testing.assert_allclose(bins.mean[0], np.diff(edges) / np.log(2.0), rtol=1e-9)
    told = Prior(*(np.array([v]) for v in (500.0, 12e3, 5e3, 2e3)), *vague_velocity())
    bins = range_bins(told, 5)
    low, high = 500.0, 11e3
    edges = low * (high / low) ** (np.arange(6) / 5)
    law = stats.norm(5e3, 2e3)
    mass = np.diff(law.cdf(edges))
    np.testing.assert_allclose(bins.probability[0], mass / mass.sum(), rtol=1e-6)
    for number, (left, right) in enumerate(pairwise(edges)):
        moment = integrate.quad(lambda r: r * law.pdf(r), left, right)[0] / mass[number]
        assert bins.mean[0, number] == pytest.approx(moment, rel=1e-6)
    whole = whole_range(told)
    cut = stats.truncnorm((low - 5e3) / 2e3, 3.0, 5e3, 2e3)
    assert whole.mean[0, 0] == pytest.approx(cut.mean(), rel=1e-6)
    assert whole.std[0, 0] == pytest.approx(cut.std(), rel=1e-5)


def vague_velocity():
    return np.zeros((1, 2)), 100.0 * np.eye(2)[None]


def test_augmented_start_blames_the_bearing():
    """The first bearing's lasting error g moved the emitter, so that both errors are tied."""
    error = CorrelatedError(std=0.01, treatment="augment")
    chosen = FILTERS["ekf"](FilterSettings(correlated=error))
    prior = Prior.between(9e3, 11e3, speed_std=10.0, emitters=1)
    belief = chosen.start(np.array([0.7]), np.array([0.0125]), np.zeros((1, 2)), prior)
    expected = chosen.expected(belief)
    assert expected.azimuth[0] == pytest.approx(0.7, abs=1e-9)
    # The lasting part is in the next bearing as in the first: only the white one separates them.
    assert expected.azimuth_std[0] == pytest.approx(0.0075, rel=1e-3)
