# SPDX-License-Identifier: Apache-2.0
"""The score's terms against what chance really brings."""

from __future__ import annotations

import numpy as np
from scipy.stats import poisson

from secondary_proc.parameters import TrackerParameters
from secondary_proc.score import false_plots_nearer
from secondary_proc.tracker import Tracker


def test_false_plots_nearer_are_those_that_a_uniform_field_has():
    rng = np.random.default_rng(5)
    covariance = np.array([[900.0, 300.0], [300.0, 400.0]])
    density, half, distance_squared = 2e-4, 200.0, 4.0
    fields = 4000
    points = rng.uniform(-half, half, (rng.poisson(density * 4 * half**2 * fields), 2))
    inside = np.einsum("ni,ij,nj->n", points, np.linalg.inv(covariance), points) < distance_squared
    expected = false_plots_nearer(
        np.array([distance_squared]), np.array([np.linalg.det(covariance)]), np.array([density])
    )[0]
    low, high = poisson.interval(0.999, expected * fields)
    assert low <= np.count_nonzero(inside) <= high


def taken_after_the_end(scene, run, allowed):
    """Plots that tracks take after their targets have gone, among many false ones."""
    world = scene(seed=3)
    for number in range(20):
        turn = 2 * np.pi * number / 20
        world.fly(
            (30e3 * np.sin(turn), 30e3 * np.cos(turn)),
            (150.0 * np.cos(turn), -150.0 * np.sin(turn)),
            end=60.0,
        )
    world.clutter(400, begin=0.0, end=110.0)
    tracker = Tracker(TrackerParameters(false_plots_nearer=allowed, maximum_speed=200.0))
    rows, times = run(tracker, world.messages())
    targets = np.unique(rows["id"][(rows["hits"] > 12) & (times < 60.0)])
    assert len(targets) >= 19
    late = np.isin(rows["id"], targets) & (times > 64.0) & np.isfinite(rows["plot_range"])
    misses = np.isin(rows["id"], targets) & (times > 64.0) & np.isnan(rows["plot_range"])
    return np.count_nonzero(late), np.count_nonzero(late | misses)


def test_tracks_left_alone_take_few_false_plots(scene, run):
    limited, chances = taken_after_the_end(scene, run, 0.02)
    free, _ = taken_after_the_end(scene, run, 1e3)
    assert limited <= poisson.ppf(0.999, 0.02 * chances)
    assert free > 3 * max(limited, 1)
