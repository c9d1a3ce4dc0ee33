# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
import pytest

from bearing_tracker.fusion import Belief, Loss
from bearing_tracker.fusion.decision import decide, estimate


def random_belief(random, targets, hypotheses=4, components=2):
    factor = random.standard_normal((targets, hypotheses, components, components))
    probability = random.dirichlet(np.ones(hypotheses), targets)
    return Belief(
        random.standard_normal((targets, hypotheses, components)),
        factor @ factor.swapaxes(-1, -2) + 0.01 * np.eye(components),
        np.log(probability),
    )


def test_the_rule_finds_the_least_risk():
    """The risk of every decision added up from the loss (23), and the printed plus sign beside it."""
    belief = random_belief(np.random.default_rng(3), 2000)
    probability = np.exp(belief.log_probability)
    error = np.trace(belief.covariance, axis1=-2, axis2=-1)
    loss = Loss(1.05 * 0.1 * error.max(), 0.1)
    risk = np.empty_like(probability)
    for decided in range(4):
        cost = np.full(probability.shape, loss.wrong)
        cost[:, decided] = loss.squared_error * error[:, decided]
        risk[:, decided] = (probability * cost).sum(axis=1)
    np.testing.assert_array_equal(decide(belief, loss), risk.argmin(axis=1))
    printed = (probability * (loss.wrong + loss.squared_error * error)).argmax(axis=1)
    assert np.count_nonzero(printed != risk.argmin(axis=1)) > 100


def test_without_weight_on_the_error_the_most_probable_wins():
    belief = random_belief(np.random.default_rng(4), 100)
    np.testing.assert_array_equal(decide(belief, Loss()), belief.log_probability.argmax(axis=1))


@pytest.mark.parametrize("loss", [Loss(1.0, 5.0), Loss(0.0, 0.0), Loss(-1.0, 0.0)])
def test_a_loss_that_would_prefer_the_improbable_is_refused(loss):
    with pytest.raises(ValueError, match="must cost more"):
        decide(random_belief(np.random.default_rng(5), 50), loss)


@pytest.mark.parametrize("output", ["mmse", "map"])
def test_the_covariance_is_the_second_moment_about_the_answer(output, make_linear_scene):
    """(25) against samples of the mixture, five standard errors of their mean."""
    channels = make_linear_scene(targets=1).channels
    random = np.random.default_rng(6)
    belief = random_belief(random, 1, channels.hypotheses, 3)
    answer = estimate(channels, belief, output, Loss())
    drawn = random.choice(channels.hypotheses, 100_000, p=np.exp(belief.log_probability[0]))
    factor = np.linalg.cholesky(belief.covariance[0])[drawn]
    white = random.standard_normal((len(drawn), 3))
    error = belief.mean[0, drawn] + np.einsum("nij,nj->ni", factor, white) - answer.mean[0]
    squares = error[:, :, None] * error[:, None]
    bound = 5.0 * squares.std(axis=0) / np.sqrt(len(drawn))
    assert (np.abs(squares.mean(axis=0) - answer.covariance[0]) < bound).all()
    if output == "mmse":
        assert (np.abs(error.mean(axis=0)) < 5.0 * error.std(axis=0) / np.sqrt(len(drawn))).all()


def test_channel_states_are_sums_over_the_other_channel(make_linear_scene):
    channels = make_linear_scene(targets=1).channels
    belief = random_belief(np.random.default_rng(7), 20, channels.hypotheses, 3)
    answer = estimate(channels, belief, "mmse", Loss())
    probability = np.exp(belief.log_probability)
    np.testing.assert_allclose(answer.active[:, 1], probability[:, 2] + probability[:, 3])
    np.testing.assert_allclose(answer.passive[:, 1], probability[:, 1::2].sum(axis=1))
    chosen = answer.active_state * 2 + answer.passive_state
    np.testing.assert_array_equal(chosen, probability.argmax(axis=1))


def test_an_unknown_output_is_refused(make_linear_scene):
    channels = make_linear_scene(targets=1).channels
    belief = random_belief(np.random.default_rng(8), 2, channels.hypotheses, 3)
    with pytest.raises(ValueError, match="mmse or map"):
        estimate(channels, belief, "median", Loss())
