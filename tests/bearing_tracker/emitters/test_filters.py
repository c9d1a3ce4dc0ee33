# SPDX-License-Identifier: Apache-2.0
"""What every filter does, whatever it is made of."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bearing_tracker.emitters import (
    DEFAULT_FILTER,
    FILTERS,
    CorrelatedError,
    FilterSettings,
    Prior,
)

SETTINGS = {
    "steady": FilterSettings(),
    "manoeuvring": FilterSettings(manoeuvre_std=1.0),
    "inflated": FilterSettings(correlated=CorrelatedError(std=0.004)),
    "augmented": FilterSettings(correlated=CorrelatedError(std=0.004, treatment="augment")),
    "all": FilterSettings(
        manoeuvre_std=1.0, correlated=CorrelatedError(std=0.004, treatment="augment")
    ),
}
EVERY = [(DEFAULT_FILTER, kind) for kind in SETTINGS] + [
    (name, kind) for name in FILTERS if name != DEFAULT_FILTER for kind in ("steady", "all")
]


def filter_of(name, kind="steady"):
    return FILTERS[name](SETTINGS[kind])


def same(first, second, **tolerance):
    for item in dataclasses.fields(first):
        np.testing.assert_allclose(
            getattr(first, item.name), getattr(second, item.name), **tolerance, err_msg=item.name
        )


@pytest.mark.parametrize(("name", "kind"), EVERY)
def test_batches_split_identically(name, kind, usual):
    chosen = filter_of(name, kind)
    together = chosen.estimate(usual.run(chosen))
    apart = [
        chosen.estimate(usual.run(chosen, rows=rows)) for rows in (slice(0, 2), slice(2, None))
    ]
    same(together, apart[0].joined(apart[1]), rtol=1e-6, atol=1e-9)


@pytest.mark.parametrize(("name", "kind"), EVERY)
def test_covariances_are_positive_definite(name, kind, usual):
    chosen = filter_of(name, kind)
    for looks in (1, 2, 30):
        belief = usual.run(chosen, looks)
        assert (np.linalg.eigvalsh(belief.covariance) > 0.0).all()
        estimate = chosen.estimate(belief)
        assert (np.linalg.eigvalsh(estimate.covariance) > 0.0).all()
        np.testing.assert_allclose(belief.weight.sum(axis=(1, 2)), 1.0)
        assert np.isfinite(estimate.bound_std).all()


@pytest.mark.parametrize("name", FILTERS)
@given(turn=st.floats(0.0, 2 * np.pi), east=st.floats(-1e5, 1e5), north=st.floats(-1e5, 1e5))
@settings(max_examples=3)
def test_a_turned_and_shifted_scene_gives_the_turned_and_shifted_result(
    name, usual, turn, east, north
):
    chosen = filter_of(name)
    plain = chosen.estimate(usual.run(chosen, 20))
    # Clockwise, as azimuths run.
    clockwise = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    moved = dataclasses.replace(
        usual,
        azimuth=np.mod(usual.azimuth + turn, 2 * np.pi),
        observer=usual.observer @ clockwise.T + (east, north),
    )
    other = chosen.estimate(moved.run(chosen, 20))
    both = np.kron(np.eye(2), clockwise)
    # Sigma points along other axes are other points; the rest is exact.
    by_points = name.endswith(("ukf", "ckf"))
    loose = 0.3 * plain.range_std.max() if by_points else 0.5
    expected = plain.state @ both.T + (east, north, 0.0, 0.0)
    np.testing.assert_allclose(other.state[:, :2], expected[:, :2], atol=loose)
    if not by_points:
        np.testing.assert_allclose(
            other.covariance, both @ plain.covariance @ both.T, rtol=1e-3, atol=1.0
        )
        np.testing.assert_allclose(other.range_information, plain.range_information, rtol=1e-3)
        np.testing.assert_array_equal(other.range_known, plain.range_known)


@pytest.mark.parametrize("name", FILTERS)
def test_bearings_around_north(name):
    chosen = filter_of(name)
    std, here = np.full(1, 0.01), np.zeros((1, 2))
    prior = Prior.between(5e3, 20e3, speed_std=1.0, emitters=1)
    belief = chosen.start(np.array([2 * np.pi - 0.004]), std, here, prior)
    for look in range(1, 9):
        azimuth = np.array([0.004 if look % 2 else 2 * np.pi - 0.004])
        belief = chosen.step(belief, np.ones(1), here, azimuth, std, np.ones(1, bool))
    expected = chosen.expected(belief)
    assert abs(np.sin(expected.azimuth[0])) < 0.01
    assert np.cos(expected.azimuth[0]) > 0.99
    assert chosen.estimate(belief).state[0, 1] > 1e3
    near = expected.distance(np.array([0.004, 2 * np.pi - 0.004]), np.full(2, 0.01))
    assert (near < 1.0).all()


@pytest.mark.parametrize(("name", "kind"), EVERY)
def test_what_is_not_heard_is_predicted(name, kind, usual):
    chosen = filter_of(name, kind)
    belief = usual.run(chosen, 10)
    heard = np.array([True, False, True, False, False, True])
    seconds, place = np.full(6, 5.0), usual.observer[10]
    azimuth = np.where(heard, usual.azimuth[10], np.nan)
    std = np.where(heard, usual.std, 0.0)
    stepped = chosen.step(belief, seconds, place, azimuth, std, heard)
    predicted = chosen.predict(belief, seconds, place)
    np.testing.assert_array_equal(stepped.mean[~heard], predicted.mean[~heard])
    np.testing.assert_array_equal(stepped.geometry.bearings - belief.geometry.bearings, heard)
    alone = chosen.step(
        belief.take(heard), seconds[heard], place[heard], azimuth[heard], std[heard], heard[heard]
    )
    np.testing.assert_allclose(stepped.take(heard).mean, alone.mean)


@pytest.mark.parametrize("name", FILTERS)
def test_the_emitter_is_found_when_the_observer_has_turned(name, usual):
    if name == "pseudo_linear":
        pytest.skip("it is biased towards the observer")
    chosen = filter_of(name)
    estimate = chosen.estimate(usual.run(chosen))
    error = np.hypot(*(estimate.state - usual.truth[-1])[:, :2].T)
    good = error < 4.0 * np.sqrt(estimate.covariance[:, 0, 0] + estimate.covariance[:, 1, 1])
    assert good.mean() >= 5 / 6
    assert estimate.range_known.all()


@pytest.mark.parametrize("name", FILTERS)
def test_times_of_their_own(name, usual):
    """Emitters heard at other times go their own ways in one call."""
    chosen = filter_of(name)
    belief = usual.run(chosen, 10)
    seconds = np.array([0.0, 1.0, 2.0, 4.0, 8.0, 16.0])
    later = chosen.predict(belief, seconds, usual.observer[9])
    for row, each in enumerate(seconds):
        alone = chosen.predict(belief.take([row]), np.array([each]), usual.observer[9][[row]])
        np.testing.assert_allclose(later.mean[row], alone.mean[0])
    moved = later.mean[..., :2] - belief.mean[..., :2]
    velocity = belief.mean[..., 2:4]
    np.testing.assert_allclose(moved, seconds[:, None, None, None] * velocity, atol=1e-6)


def test_no_emitters():
    prior = Prior.between(1e3, 1e5, speed_std=10.0, emitters=0)
    nothing, nowhere = np.zeros(0), np.zeros((0, 2))
    for name, kind in EVERY:
        chosen = filter_of(name, kind)
        belief = chosen.start(nothing, nothing, nowhere, prior)
        belief = chosen.step(belief, nothing, nowhere, nothing, nothing, np.zeros(0, bool))
        assert len(chosen.estimate(belief)) == len(chosen.expected(belief)) == 0


def test_bad_bearings_are_refused():
    chosen = filter_of(DEFAULT_FILTER)
    prior = Prior.between(1e3, 1e5, speed_std=10.0, emitters=1)
    one, here, heard = np.ones(1), np.zeros((1, 2)), np.ones(1, bool)
    for azimuth, std in ((np.nan, 1.0), (np.inf, 1.0), (1.0, 0.0), (1.0, -1.0), (1.0, np.nan)):
        with pytest.raises(ValueError, match="bearings"):
            chosen.start(np.array([azimuth]), np.array([std]), here, prior)
    belief = chosen.start(one, 0.01 * one, here, prior)
    with pytest.raises(ValueError, match="bearings"):
        chosen.step(belief, one, here, np.array([np.nan]), one, heard)
    with pytest.raises(ValueError, match="backwards"):
        chosen.predict(belief, -one, here)
    with pytest.raises(ValueError, match="backwards"):
        chosen.predict(belief, np.array([np.nan]), here)
    with pytest.raises(ValueError, match="bin"):
        FILTERS[DEFAULT_FILTER](FilterSettings(range_bins=0))
    with pytest.raises(ValueError, match="inflate"):
        FILTERS["ekf"](FilterSettings(correlated=CorrelatedError(std=0.1, treatment="ignore")))
    with pytest.raises(ValueError, match="prior"):
        Prior.between(1e5, 1e3, speed_std=10.0, emitters=1)


@pytest.mark.parametrize(("name", "kind"), EVERY)
def test_wild_bearings_leave_numbers_finite(name, kind, usual):
    """Bearings from anywhere, for a long time, and an observer that flies through the emitters."""
    chosen = filter_of(name, kind)
    random = np.random.default_rng(8)
    wild = dataclasses.replace(usual, azimuth=random.uniform(0, 2 * np.pi, usual.azimuth.shape))
    belief = wild.run(chosen)
    through = chosen.estimate(belief).state[:, :2]
    belief = chosen.step(
        belief, np.ones(6), through, np.zeros(6), np.full(6, 1e-3), np.ones(6, bool)
    )
    estimate = chosen.estimate(belief)
    for item in dataclasses.fields(estimate):
        assert np.isfinite(getattr(estimate, item.name)).all(), item.name
    assert (estimate.range < 1e7).all()


def test_gate_and_likelihood_agree(usual):
    chosen = filter_of(DEFAULT_FILTER)
    expected = chosen.expected(usual.run(chosen, 12))
    azimuth, std = expected.azimuth[[0, 3]] + 0.003, np.array([0.005, 0.01])
    distance, logarithm = expected.distance(azimuth, std), expected.log_likelihood(azimuth, std)
    assert distance.shape == logarithm.shape == (6, 2)
    variance = expected.azimuth_std[0] ** 2 + 0.005**2
    assert distance[0, 0] == pytest.approx(0.003**2 / variance)
    assert logarithm[0, 0] == pytest.approx(-0.5 * (distance[0, 0] + np.log(2 * np.pi * variance)))
    assert list(distance.argmin(axis=0)) == [0, 3]


@pytest.mark.parametrize(("name", "kind"), EVERY)
def test_no_emitters_are_no_error(name, kind, usual):
    chosen = filter_of(name, kind)
    nobody = usual.run(chosen, 2, rows=slice(0, 0))
    estimate = chosen.estimate(nobody)
    assert estimate.state.shape == (0, 4)
    assert estimate.covariance.shape == (0, 4, 4)
    assert chosen.expected(nobody).azimuth.shape == (0,)
