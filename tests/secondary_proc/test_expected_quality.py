# SPDX-License-Identifier: Apache-2.0
"""The calculators against what the tracker does with false plots."""

from __future__ import annotations

import numpy as np
import pytest

from radar_common.tables import TrackStatus
from secondary_proc.expected_quality import (
    FalsePlots,
    correct_selection,
    false_tracks_handed_over,
    gate_probability,
)
from secondary_proc.parameters import TrackerParameters
from secondary_proc.tracker import Tracker

SCANS = 150
FALSE = FalsePlots(
    per_scan=250.0,
    nearest=20e3,
    farthest=100e3,
    range_std=20.0,
    azimuth_std=0.002,
    period=4.0,
    maximum_speed=350.0,
    sigmas=3.5,
    quiet_density=0.0,
    gate_density=0.0,
)


def confirmed_among_false_plots(scene, run, **parameters):
    world = scene(seed=21)
    world.clutter(FALSE.per_scan, end=SCANS * 4.0, nearest=FALSE.nearest, farthest=FALSE.farthest)
    tracker = Tracker(TrackerParameters(acceleration=0.0, manoeuvre_acceleration=0.0, **parameters))
    rows, _ = run(tracker, world.messages(sectors=8))
    return len(set(rows["id"][rows["status"] == TrackStatus.CONFIRMED].tolist()))


def test_plain_three_of_four_hands_over_as_many_false_tracks_as_calculated(scene, run):
    expected = SCANS * false_tracks_handed_over(FALSE)
    assert expected > 50.0
    found = confirmed_among_false_plots(scene, run, initiation="l_of_m", confirmed_misses=1)
    # Branches of one start are confirmed together now and then, which widens the Poisson spread a little.
    assert abs(found - expected) < 4.0 * np.sqrt(1.3 * expected)


def test_the_likelihood_ratio_keeps_its_promise(scene, run):
    found = confirmed_among_false_plots(scene, run, false_tracks_per_hour=60.0)
    promised = 60.0 * SCANS * 4.0 / 3600.0
    assert found <= promised + 4.0 * np.sqrt(promised)


def test_equal_small_gates_give_the_formula_of_the_book():
    # Kuzmin 1967, (4.25) for small probabilities: p^2 (3 - 2 p) per plot, with each gate's own p.
    one = false_tracks_handed_over(FALSE)
    twice = false_tracks_handed_over(
        FalsePlots(**{**FALSE.__dict__, "per_scan": 2.0 * FALSE.per_scan})
    )
    assert twice / one == pytest.approx(8.0, rel=0.1)


def test_gate_probability_is_that_of_two_dimensions():
    random = np.random.default_rng(1)
    count = 200_000
    inside = (random.standard_normal((count, 2)) ** 2).sum(axis=1) <= 2.0**2
    expected = gate_probability(2.0)
    assert abs(inside.mean() - expected) < 4 * np.sqrt(expected * (1 - expected) / count)


@pytest.mark.parametrize("density", [0.01, 0.05, 0.2])
def test_nearest_plot_is_the_targets_own_as_often_as_calculated(density):
    random = np.random.default_rng(2)
    sigma = np.array([2.0, 0.7])
    trials, half = 20_000, 12.0
    own = (random.standard_normal((trials, 2)) ** 2).sum(axis=1)
    # False plots in the square of normalised differences; the nearest of a Poisson number.
    count = random.poisson(density * sigma.prod() * (2 * half) ** 2, trials)
    owner = np.repeat(np.arange(trials), count)
    place = random.uniform(-half, half, (count.sum(), 2))
    nearest = np.full(trials, np.inf)
    np.minimum.at(nearest, owner, (place**2).sum(axis=1))
    expected = float(correct_selection(np.array([density]), np.array([sigma.prod() ** 2]))[0])
    share = np.mean(own < nearest)
    assert abs(share - expected) < 4 * np.sqrt(expected * (1 - expected) / trials)
