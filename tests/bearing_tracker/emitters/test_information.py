# SPDX-License-Identifier: Apache-2.0
"""What bearings tell about range: nothing before the observer manoeuvres, and never more than there is."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from bearing_tracker.emitters import DEFAULT_FILTER, FILTERS, FilterSettings, Prior
from bearing_tracker.emitters.heard_from import PLACES, first_heard, heard_again, passed
from bearing_tracker.emitters.information import bearing_information, bound, bound_along
from bearing_tracker.emitters.range_prior import whole_range
from bearing_tracker.emitters.sight import sight


@pytest.mark.parametrize("name", FILTERS)
def test_the_range_is_unknown_until_the_observer_manoeuvres(name, passage):
    straight, turned = passage(turn=0.0, looks=40), passage(looks=40)
    chosen = FILTERS[name](FilterSettings())
    prior = straight.prior(speed_std=40.0)
    spread = whole_range(prior).std[:, 0]
    for looks in (1, 40):
        estimate = chosen.estimate(straight.run(chosen, looks, prior=prior))
        assert not estimate.range_known.any()
        assert (estimate.range_std >= 0.999 * spread).all()
    known = chosen.estimate(turned.run(chosen, 40, prior=prior))
    assert known.range_known.all()
    assert (known.range_std < 0.25 * spread).all()
    assert not chosen.estimate(turned.run(chosen, 18, prior=prior)).range_known.any()


def test_a_filter_alone_would_have_believed_it(passage):
    """Why the rule asks the geometry: the filter's own covariance shrinks without a manoeuvre."""
    straight = passage(turn=0.0, looks=40)
    chosen = FILTERS["ekf"](FilterSettings())
    belief = straight.run(chosen, prior=straight.prior(speed_std=40.0))
    along = sight(belief.mean[:, 0, 0, :2] - belief.observer).along
    believed = np.einsum("ni,nij,nj->n", along, belief.covariance[:, 0, 0, :2, :2], along)
    reported = chosen.estimate(belief).range_std
    assert (np.sqrt(believed) < 0.7 * reported).any()


def test_what_is_known_to_stand_still_needs_no_manoeuvre(passage):
    straight = passage(turn=0.3, looks=20)
    chosen = FILTERS[DEFAULT_FILTER](FilterSettings())
    standing = straight.run(chosen, prior=straight.prior(speed_std=0.5), looks=10)
    moving = straight.run(chosen, prior=straight.prior(speed_std=40.0), looks=10)
    assert chosen.estimate(standing).range_known.sum() >= 4
    assert not chosen.estimate(moving).range_known.any()


def path_of(looks, period=4.0):
    seconds = period * np.arange(looks)
    velocity = np.array([6.0, -3.0])
    path = np.column_stack(
        [np.array([8e3, 15e3]) + seconds[:, None] * velocity, np.tile(velocity, (looks, 1))]
    )
    course = np.where(seconds < 0.4 * seconds[-1], 0.3, 1.5)
    moves = 100.0 * period * np.column_stack([np.sin(course), np.cos(course)])
    return path, np.concatenate([np.zeros((1, 2)), np.cumsum(moves, axis=0)[:-1]])


def geometry_of(observer, std, period=4.0):
    geometry = first_heard(observer[:1], np.full(1, std**2))
    for place in observer[1:]:
        geometry = passed(geometry, np.full(1, period), np.zeros(1))
        geometry = heard_again(geometry, place[None], np.full(1, std**2), np.arange(1))
    return geometry


def test_live_bound_on_the_true_path_is_the_recursion():
    std, spread = 0.01, 4e3
    path, observer = path_of(50)
    prior = Prior.between(1e3, 1e5, speed_std=15.0, emitters=1)
    geometry = geometry_of(observer, std)
    state = path[-1:]
    seen = sight(state[:, :2] - observer[-1:])
    information = bearing_information(geometry, state)
    live = bound(information, geometry, state, seen, prior, np.full(1, spread))[0]
    first = sight(path[0, :2] - observer[0])
    start = np.zeros((4, 4))
    start[:2, :2] = spread**2 * np.outer(first.along, first.along)
    start[:2, :2] += (std * first.range) ** 2 * np.outer(first.across, first.across)
    start[2:, 2:] = 15.0**2 * np.eye(2)
    recursion = bound_along(path, observer, np.full(49, 4.0), np.full(50, std), start)[-1]
    np.testing.assert_allclose(live, recursion, rtol=1e-5)


def test_merged_places_lose_little():
    path, observer = path_of(8 * PLACES, period=1.0)
    geometry = geometry_of(observer, 0.01, period=1.0)
    assert (geometry.weight[0] > 0.0).sum() == PLACES
    assert geometry.bearings[0] == 8 * PLACES
    assert geometry.weight.sum() == pytest.approx(8 * PLACES / 0.01**2)
    merged = bearing_information(geometry, path[-1:])[0]
    age = np.arange(8 * PLACES)[::-1]
    gradient = sight(path[:, :2] - observer).gradient
    h = np.concatenate([gradient, -age[:, None] * gradient], axis=1)
    whole = h.T @ h / 0.01**2
    ratio = np.linalg.eigvals(np.linalg.solve(whole, merged))
    np.testing.assert_allclose(ratio, 1.0, atol=0.01)


def test_restless_emitters_make_old_bearings_worthless():
    path, observer = path_of(40)
    geometry = geometry_of(observer, 0.01)
    quiet = bearing_information(geometry, path[-1:])[0]
    restless = dataclasses.replace(geometry, unrest_now=geometry.unrest_now + 100.0)
    less = bearing_information(restless, path[-1:])[0]
    assert np.linalg.eigvalsh(quiet - less).min() >= -1e-9 * np.abs(quiet).max()
    assert np.trace(less) < 0.1 * np.trace(quiet)


def test_recursion_with_process_noise_is_the_information_form():
    path, observer = path_of(10)
    start = np.diag([4e6, 4e6, 100.0, 100.0])
    got = bound_along(path, observer, np.full(9, 4.0), np.full(10, 0.01), start, 0.1)[-1]
    step = np.eye(4) + 4.0 * np.eye(4, k=2)
    shape = np.array([[8.0, 0.0], [0.0, 8.0], [4.0, 0.0], [0.0, 4.0]])
    information = np.linalg.inv(start)
    for state, place in zip(path[1:], observer[1:], strict=True):
        noise = shape @ shape.T * 0.1**2
        information = np.linalg.inv(noise + step @ np.linalg.inv(information) @ step.T)
        east, north = state[:2] - place
        h = np.array([north, -east, 0.0, 0.0]) / (east**2 + north**2)
        information += np.outer(h, h) / 0.01**2
    np.testing.assert_allclose(got, np.linalg.inv(information), rtol=1e-5, atol=1e-4)
