# SPDX-License-Identifier: Apache-2.0
"""The probability of a plot and the density of false plots are learned where they are, no faster than they can be."""

from __future__ import annotations

import numpy as np
import pytest

from secondary_proc.clutter import SECTORS, FalsePlotDensity
from secondary_proc.detection import DetectionByRange
from secondary_proc.parameters import TrackerParameters
from secondary_proc.tracker import Tracker

TWO_PI = 2.0 * np.pi


def test_the_share_of_plots_is_learned_by_range():
    random = np.random.default_rng(1)
    learned = DetectionByRange(TrackerParameters(learn_detection=True))
    truth = {35e3: 0.9, 155e3: 0.6}
    for distance, share in truth.items():
        # Gaps as they are closed by a plot: geometrically distributed.
        gaps = random.geometric(share, 4000) - 1
        learned.observe(np.full(4000, distance), gaps)
    for distance, share in truth.items():
        found = learned.probability(np.array([distance]))
        bound = 4.0 * np.sqrt(share * (1.0 - share) / 4000) + 50.0 / 4000
        assert found == pytest.approx(share, abs=bound)
    assert learned.probability(np.array([300e3])) == pytest.approx(0.85)
    assert list(learned.shares()) == ["0 to 40 km", "120 to 160 km"]


def test_what_is_not_to_be_learned_is_told_all_the_same():
    detection = DetectionByRange(TrackerParameters(detection_probability=0.7))
    detection.observe(np.full(200, 5e3), np.ones(200, int))
    assert detection.probability(np.array([5e3])) == 0.7
    assert detection.shares() == {"0 to 40 km": pytest.approx(0.5)}


def test_old_passages_are_forgotten():
    learned = DetectionByRange(TrackerParameters(learn_detection=True))
    learned.observe(np.full(1000, 5e3), np.full(1000, 3))
    before = float(learned.probability(np.array([5e3]))[0])
    for _ in range(3000):
        learned.forget(1.0)
    assert before < 0.4
    assert learned.probability(np.array([5e3])) == pytest.approx(0.85, abs=0.01)


def field(mapped, scans=60, patch=20, even=100):
    random = np.random.default_rng(2)
    density = FalsePlotDensity(100e3, mapped=mapped)
    for _ in range(scans):
        ranges = random.uniform(1.0, 100e3, even)
        azimuths = random.uniform(0.0, TWO_PI, even)
        ranges = np.r_[ranges, random.uniform(50e3, 55e3, patch)]
        azimuths = np.r_[azimuths, random.uniform(1.0, 1.0 + TWO_PI / SECTORS, patch)]
        density.observe(ranges, azimuths)
        density.forget(1.0)
    return density


def test_a_patch_raises_the_density_within_itself_and_not_across_the_ring():
    ring, mapped = field(False), field(True)
    there, elsewhere = (np.array([52e3]), np.array([1.1])), (np.array([52e3]), np.array([4.0]))
    assert ring.per_area(*there) == ring.per_area(*elsewhere)
    assert mapped.per_area(*there) > 4.0 * ring.per_area(*there)
    assert mapped.per_area(*elsewhere) < ring.per_area(*elsewhere)
    assert mapped.unevenness > 4.0


def test_an_even_field_stays_even():
    mapped = field(True, patch=0)
    azimuths = np.linspace(0.0, TWO_PI, 200, endpoint=False)
    there = mapped.per_area(np.full(200, 52e3), azimuths)
    # Five plots a scan and ring make six in the memory of a cell: within four deviations of its count.
    assert there.max() < 1.8 * there.mean()
    assert there.min() > 0.4 * there.mean()


def test_learning_changes_the_score_but_not_who_is_tracked(scene, run):
    world = scene(seed=3, detection=0.6)
    for flight in (((20e3, 10e3), (-150.0, 60.0)), ((-30e3, 25e3), (120.0, -90.0))):
        world.fly(*flight, end=160.0)
    world.clutter(60.0, end=160.0)
    messages = list(world.messages())
    confirmed, watched = [], []
    for learn in (False, True):
        tracker = Tracker(TrackerParameters(learn_detection=learn, false_plot_map=learn))
        rows, _ = run(tracker, messages)
        confirmed.append(len(set(rows["id"][rows["status"] == 1].tolist())))
        watched.append(tracker.health.watches)
    assert confirmed == [2, 2]
    assert all("plots per passage, 0 to 40 km" in watches for watches in watched)
