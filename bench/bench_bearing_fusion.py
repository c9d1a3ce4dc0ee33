# SPDX-License-Identifier: Apache-2.0
"""A step of the two-channel filter for many targets in one call, against a loop over targets; its growth."""

from __future__ import annotations

import time

import numpy as np
import pytest

from bearing_tracker.fusion import FILTERS, Motion, Reading
from bearing_tracker.fusion.azimuth_channels import azimuth_channel, azimuth_pair
from bearing_tracker.fusion.surveillance import surveillance_motion

CHAIN = ((0.98, 0.02), (0.02, 0.98))
ROUNDS = 20


def step_of(targets, name="dcmp"):
    """A settled filter and its next step: belief, motion and both channels' readings."""
    random = np.random.default_rng(targets)
    channels = azimuth_pair(
        azimuth_channel(CHAIN, (1.0, 100.0), (1.0, 1.0)),
        azimuth_channel(CHAIN, (1.0, 100.0), (1.0, 0.0)),
    )
    tracker = FILTERS[name](channels)
    azimuth = random.uniform(-np.pi, np.pi, targets)
    start = np.stack([azimuth, np.zeros(targets)], axis=1)
    belief = tracker.start(start, np.diag([1e-4, 1e-6]))
    motion = surveillance_motion(random.uniform(1, 4, targets), np.full(targets, 5e4), 2.0, 10.0)

    def reading():
        value = np.mod(azimuth + 0.003 * random.standard_normal(targets), 2 * np.pi)
        covariance = np.full((targets, 1, 1), 0.003**2)
        return Reading(value[:, None], covariance, random.random(targets) < 0.9)

    for _ in range(3):
        belief = tracker.step(belief, motion, reading(), reading())
    return tracker, belief, motion, reading(), reading()


def one_of(step, target):
    """The same step of one target."""
    _, belief, motion, *readings = step
    row = slice(target, target + 1)
    return (
        belief.take(row),
        Motion(motion.transition[row], motion.noise[row]),
        *(Reading(r.value[row], r.covariance[row], r.reported[row]) for r in readings),
    )


def seconds(work, rounds=ROUNDS):
    best = np.inf
    for _ in range(rounds):
        begun = time.process_time()
        work()
        best = min(best, time.process_time() - begun)
    return best


@pytest.mark.parametrize("name", ["dcmp", "gpb2"])
def test_one_call_against_a_loop(benchmark, ratio, name):
    step = step_of(1000, name)
    tracker, *given = step
    singles = [one_of(step, target) for target in range(1000)]

    def loop():
        for single in singles:
            tracker.step(*single)

    benchmark(tracker.step, *given)
    ours = seconds(lambda: tracker.step(*given))
    gained = seconds(loop, 3) / ours
    ratio(f"fusion, 1,000 targets a call, {name}", gained, "times a loop of the same filter")
    assert gained > 50.0


def test_growth_is_linear(benchmark, ratio):
    steps = {targets: step_of(targets) for targets in (100, 1000, 10_000)}
    per_target = {}
    for targets, (tracker, *given) in steps.items():
        per_target[targets] = seconds(lambda f=tracker, g=given: f.step(*g)) / targets
    benchmark(steps[10_000][0].step, *steps[10_000][1:])
    growth = per_target[10_000] / per_target[1000]
    ratio("fusion, 10,000 targets", 1e6 * per_target[10_000], "us a target and step")
    ratio("fusion, 10,000 : 1,000 targets", growth, "time a target, 1 is linear")
    ratio("fusion, 1,000 : 100 targets", per_target[1000] / per_target[100], "the same")
    assert growth < 3.0
    assert per_target[1000] < per_target[100]
