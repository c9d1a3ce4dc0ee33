# SPDX-License-Identifier: Apache-2.0
"""What every filter owes, whatever its name."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from bearing_tracker.fusion import FILTERS, Reading, join

NAMES = list(FILTERS)
quick = settings(max_examples=4, suppress_health_check=[HealthCheck.function_scoped_fixture])


def wrapped(angle):
    return (angle + np.pi) % (2 * np.pi) - np.pi


def assert_same(one, other, turn=0.0):
    difference = one.mean - other.mean
    difference[:, 0] = wrapped(difference[:, 0] - turn)
    np.testing.assert_allclose(difference, 0.0, atol=1e-10)
    np.testing.assert_allclose(one.covariance, other.covariance, rtol=1e-7, atol=1e-14)
    np.testing.assert_allclose(one.active, other.active, atol=1e-8)
    np.testing.assert_allclose(one.passive, other.passive, atol=1e-8)


@pytest.mark.parametrize("output", ["mmse", "map"])
@pytest.mark.parametrize("name", NAMES)
def test_an_estimate_is_complete(name, output, make_azimuth_scene):
    scene = make_azimuth_scene()
    answer = scene.end(name, output)
    targets = len(scene.mean)
    assert answer.mean.shape == (targets, 2)
    assert (np.abs(answer.mean[:, 0]) <= np.pi).all()
    assert (np.linalg.eigvalsh(answer.covariance) > 0.0).all()
    for probability in (answer.active, answer.passive):
        assert probability.shape == (targets, 2)
        np.testing.assert_allclose(probability.sum(axis=1), 1.0, atol=1e-12)
        assert (probability >= 0.0).all()
    assert set(answer.active_state) | set(answer.passive_state) <= {0, 1}


@pytest.mark.parametrize("name", NAMES)
@quick
@given(
    seed=st.integers(0, 10**6),
    share=st.floats(0.0, 1.0),
    scale=st.floats(1e-4, 30.0),
)
def test_covariances_stay_positive_definite(name, make_azimuth_scene, seed, share, scale):
    scene = make_azimuth_scene(seed, targets=8, steps=6, share=share, scale=scale)
    tracker, beliefs = scene.follow(name)
    for belief in beliefs:
        assert np.isfinite(belief.mean).all()
        np.testing.assert_array_equal(belief.covariance, belief.covariance.swapaxes(-1, -2))
        assert (np.linalg.eigvalsh(belief.covariance) > 0.0).all()
        np.testing.assert_allclose(np.exp(belief.log_probability).sum(axis=1), 1.0, atol=1e-12)
    assert (np.linalg.eigvalsh(tracker.estimate(beliefs[-1], "map").covariance) > 0.0).all()


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("angle", [0.3, np.pi, -np.pi / 2, 3.0 * np.pi + 0.02])
def test_a_rotated_scene_gives_rotated_results(name, make_azimuth_scene, angle):
    scene = make_azimuth_scene(targets=20, steps=5)
    for output in ("mmse", "map"):
        assert_same(scene.rotated(angle).end(name, output), scene.end(name, output), angle)


@pytest.mark.parametrize("name", NAMES)
def test_targets_do_not_know_of_each_other(name, make_azimuth_scene):
    scene = make_azimuth_scene(targets=101, steps=8)
    tracker, beliefs = scene.follow(name)
    parts = [slice(0, 1), slice(1, 40), slice(40, 101)]
    others = join([scene.part(rows).follow(name)[1][-1] for rows in parts])
    whole, split = tracker.estimate(beliefs[-1]), tracker.estimate(others)
    # Older versions of numpy add the same numbers in an order that depends on how many they are.
    for ours, theirs in (
        (others.mean, beliefs[-1].mean),
        (others.covariance, beliefs[-1].covariance),
        (others.log_probability, beliefs[-1].log_probability),
        (split.mean, whole.mean),
    ):
        np.testing.assert_allclose(ours, theirs, rtol=1e-12, atol=1e-15)


@pytest.mark.parametrize("name", NAMES)
def test_a_reading_that_is_missing_is_no_disturbance(name, make_azimuth_scene):
    """Without readings the probabilities follow the chains and the state is predicted, as without the channel."""
    scene = make_azimuth_scene(share=1.0)
    tracker, beliefs = scene.follow(name)
    belief, motion = beliefs[-1], scene.motions[0]
    silent = replace(scene.active[0], reported=np.zeros(len(belief), bool))
    silent = replace(silent, value=np.full_like(silent.value, np.nan))
    heard = scene.passive[3]
    assert_same(
        tracker.estimate(tracker.step(belief, motion, silent, heard)),
        tracker.estimate(tracker.step(belief, motion, None, heard)),
    )
    before, after = (tracker.estimate(b) for b in (belief, tracker.step(belief, motion)))
    if name not in ("kalman", "oracle"):
        chain = scene.channels.active.transition
        np.testing.assert_allclose(after.active, before.active @ chain, atol=1e-12)
    if name in ("bank", "reassignment"):
        return  # They forget the mean of all when a step begins.
    apart = after.mean[:, 0] - before.mean[:, 0] - motion.transition[:, 0, 1] * before.mean[:, 1]
    np.testing.assert_allclose(wrapped(apart), 0.0, atol=1e-9)


def test_some_targets_may_lack_what_others_have(make_azimuth_scene):
    scene = make_azimuth_scene(share=1.0, targets=6)
    tracker = FILTERS["dcmp"](scene.channels)
    start = tracker.start(scene.mean, scene.covariance)
    some = np.array([True, False, True, True, False, False])
    active = replace(scene.active[0], reported=some)
    mixed = tracker.step(start, scene.motions[0], active, scene.passive[0])
    full = tracker.step(start, scene.motions[0], scene.active[0], scene.passive[0])
    none = tracker.step(start, scene.motions[0], None, scene.passive[0])
    np.testing.assert_allclose(mixed.mean, np.where(some[:, None, None], full.mean, none.mean))
    np.testing.assert_allclose(
        mixed.log_probability, np.where(some[:, None], full.log_probability, none.log_probability)
    )


def test_one_channel_alone_does_not_listen_to_the_other(make_azimuth_scene):
    scene = make_azimuth_scene()
    deaf = replace(scene, passive=[None] * len(scene.passive))
    assert_same(scene.end("active"), deaf.end("dcmp"))
    deaf = replace(scene, active=[None] * len(scene.active))
    assert_same(scene.end("passive"), deaf.end("dcmp"))


def test_an_impossible_state_stays_impossible(make_azimuth_scene):
    """A chain with zeros, and a start in one state, do not disturb the others."""
    scene = make_azimuth_scene(targets=4)
    for name in NAMES:
        tracker = FILTERS[name](scene.channels)
        never = np.eye(2)
        motion = replace(scene.motions[0], active_chain=never)
        belief = tracker.start(scene.mean, scene.covariance, active=np.array([1.0, 0.0]))
        active = replace(scene.active[0], state=np.zeros(4, np.intp))
        answer = tracker.estimate(tracker.step(belief, motion, active, scene.passive[0]))
        np.testing.assert_allclose(answer.active, np.tile([1.0, 0.0], (4, 1)), atol=1e-15)
        assert np.isfinite(answer.mean).all()


def test_readings_must_be_finite_and_their_covariances_positive(make_azimuth_scene):
    scene = make_azimuth_scene(share=1.0, targets=3)
    tracker = FILTERS["dcmp"](scene.channels)
    start = tracker.start(scene.mean, scene.covariance)
    reading = scene.active[0]
    with pytest.raises(ValueError, match="not finite"):
        tracker.step(start, scene.motions[0], replace(reading, value=reading.value * np.nan))
    with pytest.raises(ValueError, match="positive definite"):
        tracker.step(start, scene.motions[0], replace(reading, covariance=-reading.covariance))


def test_the_oracle_must_be_told(make_azimuth_scene):
    scene = make_azimuth_scene()
    untold = Reading(scene.active[0].value, scene.active[0].covariance, scene.active[0].reported)
    tracker = FILTERS["oracle"](scene.channels)
    start = tracker.start(scene.mean, scene.covariance)
    with pytest.raises(ValueError, match="told"):
        tracker.step(start, scene.motions[0], untold)


def test_no_target_is_no_trouble(make_azimuth_scene):
    scene = make_azimuth_scene(targets=3).part(slice(0, 0))
    for name in NAMES:
        assert scene.end(name).mean.shape == (0, 2)


def test_targets_are_taken_put_back_and_joined(make_azimuth_scene):
    _, beliefs = make_azimuth_scene(targets=5).follow("dcmp")
    belief = beliefs[-1]
    rows = np.array([3, 1])
    put = belief.put(rows, beliefs[0].take(rows))
    np.testing.assert_array_equal(put.mean[rows], beliefs[0].mean[rows])
    np.testing.assert_array_equal(put.mean[[0, 2, 4]], belief.mean[[0, 2, 4]])
    both = join([belief.take(rows), put])
    assert len(both) == 7
    np.testing.assert_array_equal(both.covariance[:2], belief.covariance[rows])
