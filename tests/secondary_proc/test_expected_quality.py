# SPDX-License-Identifier: Apache-2.0
"""The calculators against what the tracker does with false plots."""

from __future__ import annotations

import numpy as np
import pytest

from radar_common.tables import TrackStatus
from secondary_proc.calculators.track_detection import track_detection
from secondary_proc.expected_quality import (
    FalsePlots,
    correct_selection,
    false_tracks_handed_over,
    gate_probability,
)
from secondary_proc.initiation import DROP_RULES
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


def confirmed_among_false_plots(scene, run, scans=SCANS, **parameters):
    """Confirmed tracks of a scene of false plots alone, each ended by its first miss."""
    world = scene(seed=21)
    world.clutter(FALSE.per_scan, end=scans * 4.0, nearest=FALSE.nearest, farthest=FALSE.farthest)
    settings = {"smoother": "kalman", "acceleration": 0.0, "manoeuvre_acceleration": 0.0}
    tracker = Tracker(TrackerParameters(**(settings | parameters)))
    rows, _ = run(tracker, world.messages(sectors=8))
    return len(set(rows["id"][rows["status"] == TrackStatus.CONFIRMED].tolist()))


def hold_to_the_calculation(scene, run, rule, scans):
    hits, window, misses = rule
    expected = scans * false_tracks_handed_over(FALSE, hits, window, misses)
    found = confirmed_among_false_plots(
        scene,
        run,
        scans,
        initiation="l_of_m",
        confirm_hits=hits,
        confirm_window=window,
        drop_rule="rule" if misses is None else "misses",
        tentative_misses=misses or 2,
        confirmed_misses=1,
    )
    # Branches of one start are confirmed together now and then, which widens the Poisson spread a little; after one
    # turn the antenna's period is known, and the last candidates are cut off.
    assert abs(found - expected) < 4.0 * np.sqrt(1.3 * expected) + 3.0 * expected / scans


@pytest.mark.parametrize(("rule", "scans"), [((2, 2, None), 20), ((3, 4, None), 60)])
def test_rules_hand_over_as_many_false_tracks_as_calculated(scene, run, rule, scans):
    hold_to_the_calculation(scene, run, rule, scans)


@pytest.mark.study
@pytest.mark.parametrize(
    "rule", [(2, 2, None), (2, 3, None), (3, 3, None), (3, 4, None), (3, 5, None), (3, 5, 2)]
)
def test_every_rule_hands_over_as_many_false_tracks_as_calculated(scene, run, rule):
    hold_to_the_calculation(scene, run, rule, SCANS)


def hold_to_the_promise(scene, run, name, scans, rate, **parameters):
    found = confirmed_among_false_plots(
        scene, run, scans, initiation=name, false_tracks_per_hour=rate, **parameters
    )
    promised = rate * scans * 4.0 / 3600.0
    assert found <= promised + 4.0 * np.sqrt(promised)


@pytest.mark.parametrize("name", ["likelihood_ratio", "wald"])
def test_tests_of_the_ratio_keep_their_promise(scene, run, name):
    hold_to_the_promise(scene, run, name, 50, 180.0)


@pytest.mark.study
@pytest.mark.parametrize("name", ["likelihood_ratio", "wald"])
@pytest.mark.parametrize("rate", [10.0, 60.0, 600.0])
@pytest.mark.parametrize("drop_rule", DROP_RULES)
def test_tests_of_the_ratio_keep_any_promise(scene, run, name, rate, drop_rule):
    hold_to_the_promise(scene, run, name, SCANS, rate, drop_rule=drop_rule)


@pytest.mark.parametrize(("hits", "window"), [(3, 3), (3, 4)])
def test_targets_are_confirmed_as_soon_as_calculated(scene, run, hits, window):
    detection, targets, scans = 0.8, 60, 12
    world = scene(seed=5, detection=detection)
    for bearing in np.linspace(0.0, 2 * np.pi, targets, endpoint=False):
        outward = np.array([np.sin(bearing), np.cos(bearing)])
        world.fly(60e3 * outward, 100.0 * outward, begin=0.0, end=4.0 * scans + 1.0)
    # Plots too far away to matter tell the antenna's period before the targets come.
    world.clutter(40.0, begin=-12.0, end=0.0, nearest=150e3, farthest=200e3)
    rule = {"initiation": "l_of_m", "confirm_hits": hits, "confirm_window": window}
    tracker = Tracker(TrackerParameters(scan_period=4.0, **rule))
    rows, times = run(tracker, world.messages(sectors=8))
    confirmed = rows["status"] == TrackStatus.CONFIRMED
    expected = track_detection(np.full(scans, detection), hits, window)
    bearing = np.arctan2(rows["x"], rows["y"])[confirmed]
    target = np.rint(bearing / (2 * np.pi) * targets).astype(int) % targets
    first = np.full(targets, np.inf)
    np.minimum.at(first, target, times[confirmed])
    for scan in range(2, scans):
        found = np.mean(first < 4.0 * (scan + 1))
        share = expected[scan]
        assert abs(found - share) < 4.0 * np.sqrt(share * (1.0 - share) / targets) + 1e-9, scan


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
