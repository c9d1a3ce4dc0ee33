# SPDX-License-Identifier: Apache-2.0
"""The tracker with every choice of association, gates and evidence: the same life of tracks, and what each adds."""

from __future__ import annotations

import numpy as np
import pytest

from radar_common.parameters import ParameterError
from radar_common.tables import TrackStatus
from secondary_proc.association import ASSOCIATIONS
from secondary_proc.gating import SelectionWatch
from secondary_proc.gating.three_sizes import narrowed
from secondary_proc.initiation import INITIATIONS
from secondary_proc.initiation.strength import StrengthRatio
from secondary_proc.parameters import TrackerParameters
from secondary_proc.tracker import Tracker

CHOICES = [
    *({"association": name} for name in ASSOCIATIONS),
    *({"initiation": name} for name in INITIATIONS),
    {"gate_shape": "three_sizes"},
    {"amplitude_likelihood": True},
    {"association": "jpda", "smoother": "kalman"},
]


def crossing(scene, seed=3):
    world = scene(seed=seed, detection=0.95)
    world.fly((-8e3, 30e3), (150.0, 20.0), end=100.0)
    world.fly((8e3, 30e3), (-150.0, 20.0), end=100.0)
    world.clutter(20.0, end=100.0)
    return world


@pytest.mark.parametrize("choice", CHOICES, ids=lambda c: "-".join(map(str, c.values())))
def test_two_targets_cross_and_stay_two(scene, run, choice):
    world = crossing(scene)
    tracker = Tracker(TrackerParameters(**choice))
    rows, times = run(tracker, world.messages(sectors=4))
    settled = (times > 36.0) & (rows["status"] == TrackStatus.CONFIRMED)
    rows, times = rows[settled], times[settled]
    place = np.stack([rows["x"], rows["y"]], axis=1).astype(float)
    away = np.array(
        [
            np.hypot(*(place - position - velocity * times[:, None]).T)
            for position, velocity in world.truths
        ]
    ).min(axis=0)
    assert np.mean(away < 300.0) > 0.9
    long = [label for label in set(rows["id"].tolist()) if np.sum(rows["id"] == label) > 10]
    assert 2 <= len(long) <= 4
    assert np.isfinite(rows["x"]).all()


def test_joint_association_keeps_its_covariance_honest(scene, run):
    # Where nothing competes it hardly differs from one plot a track; in a crowd it is less sure.
    sizes = []
    for per_scan in (0.0, 100.0):
        world = scene(seed=4)
        world.fly((-6e3, 20e3), (120.0, 0.0), end=100.0)
        world.clutter(per_scan, end=100.0, nearest=18e3, farthest=23e3)
        tracker = Tracker(TrackerParameters(association="jpda", smoother="kalman"))
        rows, _ = run(tracker, world.messages(sectors=4))
        confirmed = rows[rows["status"] == TrackStatus.CONFIRMED]
        own = np.abs(confirmed["y"] - 20e3) < 500.0
        assert np.count_nonzero(own) > 10
        sizes.append(np.median(confirmed["covariance"][own][:, 0]))
    assert sizes[0] < sizes[1] < 4.0 * sizes[0]


@pytest.mark.parametrize("smoother", ["alpha_beta", "speed_course"])
def test_joint_association_refuses_smoothers_that_weigh_nothing(smoother):
    with pytest.raises(ParameterError, match="weighs plots"):
        TrackerParameters(association="jpda", smoother=smoother)


def test_the_smallest_gate_with_a_plot_counts():
    track = np.array([0, 0, 1, 2, 2])
    straight = np.array([True, True, True, False, False])
    difference = np.array([[10.0, 0.0], [200.0, 0.0], [200.0, 0.0], [10.0, 0.0], [200.0, 0.0]])
    quiet = np.broadcast_to(np.diag([900.0, 400.0]), (5, 2, 2))
    tried = narrowed(track, straight, difference, quiet, 3.5)
    # The first track has a plot in its narrow gate, the second only in its medium one, the third has no narrow gate.
    assert list(tried.kept) == [True, False, True, True, True]
    assert list(tried.narrow) == [True, False, False, False, False]
    assert tried.distance_squared[0] == pytest.approx(100.0 / 900.0)
    assert tried.determinant[0] == pytest.approx(360_000.0)


def test_strength_is_learned_and_its_ratio_is_one_of_densities():
    random = np.random.default_rng(8)
    ratio = StrengthRatio()
    assert (ratio.ratio(np.array([3.0, np.nan])) == 1.0).all()
    for _ in range(200):
        ratio.forget(0.5)
        ratio.observe(random.normal(12.0, 2.0, 50), np.zeros(50, bool))
        ratio.observe(random.normal(20.0, 3.0, 20), np.ones(20, bool))
    weak, equal, strong, unknown = ratio.ratio(np.array([10.0, 15.4, 20.0, np.nan]))
    assert weak > 10.0
    assert 1 / 2 < equal < 2.0
    assert strong < 0.1
    assert unknown == 1.0
    # False plots gain nothing by it on average, which is what the promised rate of false tracks rests on.
    false = random.normal(12.0, 2.0, 20_000)
    assert np.mean(1.0 / ratio.ratio(false)) < 1.1


def test_strength_confirms_targets_sooner_and_false_plots_not(scene, run):
    def delays(enabled):
        world = scene(seed=9, detection=0.9)
        for north in np.linspace(-40e3, 40e3, 10):
            world.fly((20e3, north), (100.0, 30.0), begin=0.0, end=60.0)
            world.fly((-20e3, north), (-100.0, 30.0), begin=60.0, end=100.0)
        targets = len(world.times)
        world.clutter(80.0, end=100.0, farthest=60e3)
        random = np.random.default_rng(1)
        strength = random.normal(13.0, 1.0, len(world.times))
        strength[:targets] += 8.0
        order = np.argsort(world.times, kind="stable")
        position = 0
        tracker = Tracker(TrackerParameters(amplitude_likelihood=enabled))

        def messages():
            nonlocal position
            for table in world.messages(sectors=4):
                table.rows["snr_db"] = strength[order[position : position + len(table.rows)]]
                position += len(table.rows)
                yield table

        rows, times = run(tracker, messages())
        late = (times > 60.0) & (rows["status"] == TrackStatus.CONFIRMED)
        _, first = np.unique(rows["id"][late], return_index=True)
        begun = rows["hits"][late][first]
        near = rows["x"][late][first] < -15e3
        return begun[near & (begun < 8)]

    without, with_strength = delays(False), delays(True)
    assert len(with_strength) >= 8
    assert with_strength.mean() < without.mean()


@pytest.mark.parametrize("density", [1e-9, 3e-6, 2e-5])
def test_the_watch_of_selection_agrees_with_the_design(density):
    # Gates filled by the law that the watch assumes: own plot in 85 of 100 scans, false ones by Poisson's law.
    random = np.random.default_rng(11)
    detection, sigmas, root = 0.85, 3.5, 2500.0
    watch = SelectionWatch(sigmas, detection)
    tracks = 4000
    own = np.flatnonzero(random.random(tracks) < detection)
    square = random.chisquare(2, len(own))
    false = random.poisson(np.pi * sigmas**2 * root * density, tracks)
    track = np.concatenate([own, np.repeat(np.arange(tracks), false)])
    distance = np.concatenate([square, sigmas**2 * random.random(false.sum())])
    inside = distance < sigmas**2
    track, distance = track[inside], distance[inside]
    ratio = detection / (1 - detection) / (2 * np.pi * root * density)
    gain = np.log(ratio) - distance / 2.0
    order = np.lexsort((distance, track))
    taken = order[np.unique(track[order], return_index=True)[1]]
    assert watch.shares is None
    watch.observe(track, gain, np.full(len(track), density), np.full(len(track), root**2), taken)
    expected, observed = watch.shares
    spread = np.sqrt(0.25 / len(taken))
    assert abs(expected - observed) < 4.0 * spread
    assert (expected > 0.999) == (density < 1e-8)
