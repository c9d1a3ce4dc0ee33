# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from itertools import permutations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from radar_common.tables import PLOT
from radar_eval.antenna import estimate_rotation
from radar_eval.bag_tables import TimedRows
from radar_eval.labelling import FALSE, Gates, assign, label_plots
from radar_eval.truth_paths import TruthPaths

GATES = Gates(400.0, np.radians(1.5), 0.4)


def labelled(world, plots, truth=None):
    rotation = estimate_rotation(plots.time, plots.rows["azimuth"])
    paths = TruthPaths(world.truth() if truth is None else truth, longest_gap=40.0)
    looks = paths.looks(rotation)
    return paths, looks, label_plots(plots, paths, looks, GATES)


def joined(*parts):
    rows = np.concatenate([part.rows for part in parts])
    time = np.concatenate([part.time for part in parts])
    order = np.argsort(time, kind="stable")
    return TimedRows(rows[order], time[order], 1)


def false_plots(world, number, seed=2):
    generator = np.random.default_rng(seed)
    time = np.sort(generator.uniform(0.0, world.scans * 4.0, number))
    rows = np.zeros(number, PLOT)
    rows["range"] = generator.uniform(2e3, 40e3, number)
    rows["azimuth"] = 2.0 * np.pi * time / 4.0 % (2.0 * np.pi)
    return TimedRows(rows, time, 1)


def test_each_pass_of_the_antenna_is_found_once(world):
    paths, looks, _ = labelled(world, world.plots())
    target, time = world.crossings()
    assert len(looks) == len(target)
    order = np.lexsort((time, target))
    assert np.array_equal(looks.target, target[order])
    # The estimated rotation may be off by a hundredth of a degree or so.
    assert looks.time == pytest.approx(time[order], abs=0.01)
    assert list(paths.ids) == [1, 2, 3, 4, 5, 6]


def test_dense_truth_gives_the_same_passes_as_one_row_a_scan(world):
    plots = world.plots()
    rotation = estimate_rotation(plots.time, plots.rows["azimuth"])
    dense = np.arange(0.0, world.scans * 4.0, 0.125)
    target = np.repeat(np.arange(len(world.start)), len(dense))
    time = np.tile(dense, len(world.start))
    truth = world.truth()
    rows = np.zeros(len(time), truth.rows.dtype)
    x, y = world.at(target, time).T
    rows["x"], rows["y"], rows["id"] = x, y, target + 1
    rows["range"], rows["azimuth"] = np.hypot(x, y), np.arctan2(x, y) % (2.0 * np.pi)
    looks = TruthPaths(TimedRows(rows, time, 1), longest_gap=40.0).looks(rotation)
    sparse = TruthPaths(truth, longest_gap=40.0).looks(rotation)
    counts, expected = (np.bincount(found.target) for found in (looks, sparse))
    assert np.max(np.abs(counts - expected)) <= 1


def test_a_gap_in_the_truth_gives_no_passes(world):
    truth = world.truth()
    there = (truth.time < 40.0) | (truth.time > 90.0)
    truth = TimedRows(truth.rows[there], truth.time[there], 1)
    _, looks, _ = labelled(world, world.plots(), truth)
    assert not np.any((looks.time > 45.0) & (looks.time < 85.0))


def test_perfect_plots_are_labelled_without_an_error(world):
    plots = world.plots()
    _, _, labels = labelled(world, plots)
    assert np.array_equal(labels.target, world.owner(plots))
    assert not np.any(labels.plot_of_look == FALSE)


def test_false_plots_are_hardly_ever_taken_for_a_target(world):
    plots = joined(world.plots(), false_plots(world, 6000))
    _, _, labels = labelled(world, plots)
    true = np.isin(plots.time, world.plots().time)
    assert np.array_equal(labels.target[true], world.owner(world.plots()))
    assert np.all(labels.target[~true] == FALSE)


def test_a_missing_plot_is_a_pass_without_one(world):
    plots = world.plots(keep=lambda target, time: ~((target == 2) & (time < 60.0)))
    _, looks, labels = labelled(world, plots)
    missed = labels.plot_of_look == FALSE
    assert np.all(looks.target[missed] == 2)
    assert np.sum(missed) == 15


def test_close_targets_are_labelled_as_a_whole(world):
    """Shifted plots lie nearer to the neighbour, but only the right labels give a plot to both."""
    world.start[4] = world.start[3] + np.array([0.0, -300.0])
    world.velocity[4] = world.velocity[3]
    plots = world.plots(range_error=160.0)
    _, _, labels = labelled(world, plots)
    assert np.array_equal(labels.target, world.owner(plots))


def test_targets_crossing_north_are_followed(world):
    world.start[5], world.velocity[5] = np.array([2e3, 18e3]), np.array([-60.0, 0.0])
    plots = world.plots()
    azimuth = world.truth().rows["azimuth"][world.truth().rows["id"] == 6]
    assert azimuth.min() < 0.1
    assert azimuth.max() > 6.2
    _, looks, labels = labelled(world, plots)
    assert np.sum(looks.target == 5) == pytest.approx(world.scans, abs=1)
    assert np.sum(labels.target == 5) == np.sum(looks.target == 5)


@settings(max_examples=60)
@given(st.integers(1, 5), st.integers(1, 5), st.integers(0, 10_000))
def test_assignment_equals_the_best_of_all(rows, columns, seed):
    generator = np.random.default_rng(seed)
    allowed = np.argwhere(generator.random((rows, columns)) < 0.6)
    if not len(allowed):
        return
    row, column = allowed.T
    cost = generator.uniform(0.0, 2.0, len(row))
    chosen = assign(row, column, cost)
    assert len(np.unique(row[chosen])) == len(np.unique(column[chosen])) == np.sum(chosen)
    table = {(r, c): value for r, c, value in zip(row, column, cost, strict=True)}
    best = (0, 0.0)
    padded = list(range(columns)) + [None] * rows
    for order in set(permutations(padded, rows)):
        pairs = [(r, c) for r, c in enumerate(order) if (r, c) in table]
        best = max(best, (len(pairs), -sum(table[pair] for pair in pairs)))
    assert np.sum(chosen) == best[0]
    assert np.sum(cost[chosen]) == pytest.approx(-best[1])
