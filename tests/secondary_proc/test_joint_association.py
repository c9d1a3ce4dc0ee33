# SPDX-License-Identifier: Apache-2.0
"""Joint probabilities against all events, and mixed plots against the filter that knows of several."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from secondary_proc.association.joint_events import MOST_SETS, joint_probabilities
from secondary_proc.association.mixture import mix, scatter_of_state
from secondary_proc.smoothing import joseph_update


def event_by_event(track, plot, gain):
    """Marginal probabilities by listing every joint event."""
    ratio, total, out = np.exp(gain), 0.0, np.zeros(len(track))
    choices = [[None, *np.flatnonzero(track == number)] for number in sorted(set(track.tolist()))]
    for event in product(*choices):
        edges = [edge for edge in event if edge is not None]
        if len(set(plot[edges].tolist())) == len(edges):
            weight = float(ratio[edges].prod())
            total += weight
            out[edges] += weight
    return out / total


@settings(max_examples=50)
@given(
    inside=st.lists(st.lists(st.booleans(), min_size=5, max_size=5), min_size=1, max_size=5),
    seed=st.integers(0, 2**31),
)
def test_probabilities_are_those_of_all_joint_events(inside, seed):
    track, plot = np.nonzero(inside)
    gain = np.random.default_rng(seed).normal(1.0, 4.0, len(track))
    found = joint_probabilities(7 * track, plot + 3, gain)
    np.testing.assert_allclose(found, event_by_event(track, plot, gain), atol=1e-12)
    assert (np.bincount(track, found, 5) <= 1.0 + 1e-12).all()
    assert (np.bincount(plot, found, 5) <= 1.0 + 1e-12).all()


def test_one_track_is_the_textbook_case():
    gain = np.array([2.0, 0.5, -1.0])
    found = joint_probabilities(np.zeros(3, np.intp), np.arange(3), gain)
    np.testing.assert_allclose(found, np.exp(gain) / (1.0 + np.exp(gain).sum()))


def test_components_of_every_size_and_order():
    # A chain, a pair and a crowd beyond the limit, their edges mixed up.
    crowd = MOST_SETS + 1
    track = np.concatenate([[0, 0, 1, 1, 2], [50], np.repeat(100 + np.arange(crowd), crowd)])
    plot = np.concatenate([[0, 1, 1, 2, 2], [50], np.tile(100 + np.arange(crowd), crowd)])
    random = np.random.default_rng(1)
    gain, order = random.normal(0.0, 2.0, len(track)), random.permutation(len(track))
    found = np.empty(len(track))
    found[order] = joint_probabilities(track[order], plot[order], gain[order])
    np.testing.assert_allclose(found[:5], event_by_event(track[:5], plot[:5], gain[:5]))
    assert found[5] == pytest.approx(1.0 / (1.0 + np.exp(-gain[5])))
    assert np.isnan(found[6:]).all()


def test_nothing_and_certainty():
    none = np.zeros(0, np.intp)
    assert len(joint_probabilities(none, none, np.zeros(0))) == 0
    sure = joint_probabilities(np.array([0, 1]), np.array([0, 1]), np.array([800.0, -800.0]))
    np.testing.assert_allclose(sure, [1.0, 0.0], atol=1e-12)


def kalman(state, covariance, position, error):
    expected = covariance[:, :2, :2] + error
    gain = covariance[:, :, :2] @ np.linalg.inv(expected)
    innovation = position - state[:, :2]
    return state + (gain @ innovation[:, :, None])[:, :, 0], joseph_update(covariance, gain, error)


@pytest.mark.parametrize("probability", [[0.6, 0.3], [0.95, 0.05], [0.02, 0.01], [0.5, 0.0]])
def test_a_filter_given_the_mixture_does_probabilistic_data_association(probability):
    random = np.random.default_rng(4)
    root = random.normal(0.0, 30.0, (4, 4))
    covariance, error = root @ root.T + np.diag([400.0, 300.0, 9.0, 9.0]), np.diag([900.0, 2500.0])
    state, plots = np.array([10.0, 20.0, 5.0, -3.0]), np.array([[60.0, 0.0], [-20.0, 70.0]])
    beta = np.array(probability)
    # Bar-Shalom and Fortmann 1988, (6.4.16)-(6.4.23).
    expected = covariance[:2, :2] + error
    gain = covariance[:, :2] @ np.linalg.inv(expected)
    innovations = plots - state[:2]
    mean = beta @ innovations
    spread = (innovations.T * beta) @ innovations - np.outer(mean, mean)
    book_state = state + gain @ mean
    book_covariance = covariance - beta.sum() * gain @ expected @ gain.T + gain @ spread @ gain.T

    mixture = mix(
        np.zeros(2, np.intp),
        beta,
        plots,
        np.stack([error, error]),
        state[None, :2],
        covariance[None, :2, :2],
    )
    ours, after = kalman(state[None], covariance[None], mixture.position, mixture.covariance)
    np.testing.assert_allclose(ours[0], book_state, rtol=1e-9)
    np.testing.assert_allclose(
        after[0] + scatter_of_state(after, mixture)[0], book_covariance, rtol=1e-8
    )


def test_a_plot_surely_right_stays_as_it_is():
    place, error = np.array([[3.0, 4.0]]), np.array([[[5.0, 1.0], [1.0, 6.0]]])
    mixture = mix(np.zeros(1, np.intp), np.ones(1), place, error, np.zeros((1, 2)), error)
    np.testing.assert_allclose(mixture.position, place)
    np.testing.assert_allclose(mixture.covariance, error)
    np.testing.assert_allclose(mixture.scatter, 0.0, atol=1e-12)
