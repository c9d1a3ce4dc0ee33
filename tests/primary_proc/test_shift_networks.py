# SPDX-License-Identifier: Apache-2.0
"""Networks of shifted arrays compute what they say, in few buffers, and nothing that is not used."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from primary_proc.normalisers.shift_network import SOURCE, ShiftNetwork
from primary_proc.normalisers.sliding_windows import ordered_of_two, sorted_window, window_sum


def run(network, result, values):
    """The places of a result that are not void."""
    plan = network.plan(result)
    buffers = [np.zeros_like(values) for _ in range(plan.buffers)]
    buffers[0][:] = values
    for operation, one, other, target in plan.bind(buffers, len(values)):
        operation(one, other, out=target)
    assert np.array_equal(buffers[0], values), "the source is left as it is"
    return buffers[plan.result]


@settings(deadline=None, max_examples=60)
@given(length=st.integers(1, 40), seed=st.integers(0, 100))
def test_sums_of_windows(length, seed):
    values = np.random.default_rng(seed).integers(0, 1000, 100).astype(float)
    network = ShiftNetwork()
    found = run(network, window_sum(network, length), values)
    expected = np.lib.stride_tricks.sliding_window_view(values, length).sum(axis=1)
    assert np.array_equal(found[: len(expected)], expected)


@settings(deadline=None, max_examples=60)
@given(length=st.integers(1, 24), rank=st.integers(0, 23), seed=st.integers(0, 100))
def test_sorted_windows(length, rank, seed):
    values = np.random.default_rng(seed).integers(0, 50, 80)
    network, rank = ShiftNetwork(), rank % length
    found = run(network, sorted_window(network, length)[rank], values)
    windows = np.lib.stride_tricks.sliding_window_view(values, length)
    expected = np.sort(windows, axis=1)[:, rank]
    assert np.array_equal(found[: len(expected)], expected)


@settings(deadline=None, max_examples=60)
@given(
    length=st.integers(1, 12),
    gap=st.integers(0, 5),
    order=st.integers(1, 24),
    seed=st.integers(0, 100),
)
def test_ordered_values_of_two_windows(length, gap, order, seed):
    values = np.random.default_rng(seed).integers(0, 50, 80)
    network, order = ShiftNetwork(), 1 + (order - 1) % (2 * length)
    before = sorted_window(network, length)
    behind = [signal.ahead(length + gap) for signal in before]
    found = run(network, ordered_of_two(network, before, behind, order), values)
    windows = np.lib.stride_tricks.sliding_window_view(values, 2 * length + gap)
    both = np.delete(windows, np.s_[length : length + gap], axis=1)
    expected = np.sort(both, axis=1)[:, order - 1]
    assert np.array_equal(found[: len(expected)], expected)


def test_equal_expressions_are_computed_once():
    network = ShiftNetwork()
    pair = network.combine(np.minimum, SOURCE, SOURCE.ahead(1))
    assert network.combine(np.minimum, SOURCE.ahead(1), SOURCE) == pair
    assert network.combine(np.minimum, SOURCE.ahead(3), SOURCE.ahead(4)) == pair.ahead(3)


@pytest.mark.parametrize(("half", "rank", "steps", "buffers"), [(16, 24, 76, 12), (16, 32, 5, 3)])
def test_the_plan_holds_what_the_result_needs(half, rank, steps, buffers):
    """Of the 76 operations that sort 16 cells and 17 that select, or of those of a maximum alone."""
    network = ShiftNetwork()
    before = sorted_window(network, half)
    behind = [signal.ahead(half + 5) for signal in before]
    plan = network.plan(ordered_of_two(network, before, behind, rank))
    assert (len(plan.steps), plan.buffers) == (steps, buffers)
