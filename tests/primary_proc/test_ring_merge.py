# SPDX-License-Identifier: Apache-2.0
"""Merging of rings: what is near makes one plot, and nothing is given out while something may still join it."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from primary_proc.detectors.burst_detector import bursts
from primary_proc.plots.ring_merge import RingMerger

LONGEST = 50


def table(*rows):
    ring, start, end = np.array(rows or np.zeros((0, 3)), int).T
    return bursts(ring, start, end, False)


def sets(groups):
    """Groups as sets of (ring, start)."""
    assert np.array_equal(groups.first, np.unique(groups.first))
    found = np.split(groups.bursts, groups.first[1:]) if len(groups) else []
    return {frozenset((int(b["ring"]), int(b["start"])) for b in group) for group in found}


def plain_groups(rows, gap):
    """Definition: closure of nearness in ring and azimuth."""
    groups = [{row} for row in rows]
    for one, other in itertools.combinations(rows, 2):
        near = abs(one[0] - other[0]) <= 1 and max(one[1], other[1]) - min(one[2], other[2]) <= gap
        if near:
            first = next(g for g in groups if one in g)
            second = next(g for g in groups if other in g)
            if first is not second:
                first |= second
                groups.remove(second)
    return {frozenset((ring, start) for ring, start, _ in group) for group in groups}


@st.composite
def scenes(draw):
    """Bursts that do not overlap within their ring, as a detector gives them."""
    rows = []
    for ring in range(draw(st.integers(1, 5))):
        position = 0
        for pause, length in draw(
            st.lists(st.tuples(st.integers(1, 12), st.integers(2, 9)), max_size=5)
        ):
            rows.append((ring, position + pause, position + pause + length))
            position += pause + length
    return rows


@settings(deadline=None, max_examples=200)
@given(rows=scenes(), gap=st.integers(0, 6), cuts=st.lists(st.integers(1, 100), max_size=4))
def test_groups_are_those_of_the_definition_however_the_stream_is_cut(rows, gap, cuts):
    merger = RingMerger(1000, gap)
    found, before = set(), -1
    for now in sorted({*cuts, 120}):
        closed = [row for row in rows if before < row[2] <= now]
        going = [row for row in rows if row[1] <= now < row[2]]
        found |= sets(merger.add(table(*closed), table(*going), now))
        before = now
    assert found == plain_groups(rows, gap)
    assert len(merger.waiting) == 0


def test_a_group_waits_for_a_neighbour_that_is_still_open():
    merger = RingMerger(LONGEST, 3)
    closed, going = table((7, 10, 20)), table((8, 15, -1))
    assert len(merger.add(closed, going, 30)) == 0
    assert len(merger.add(table(), going, 35)) == 0
    assert sets(merger.add(table((8, 15, 38)), table(), 45)) == {frozenset({(7, 10), (8, 15)})}


def test_a_group_waits_for_the_gap_to_pass():
    merger = RingMerger(LONGEST, 5)
    assert len(merger.add(table((7, 10, 20)), table(), 24)) == 0
    assert len(merger.add(table(), table(), 25)) == 1


def test_other_rings_do_not_wait():
    merger = RingMerger(LONGEST, 0)
    found = merger.add(table((3, 10, 20), (9, 10, 20)), table((8, 15, -1)), 30)
    assert sets(found) == {frozenset({(3, 10)})}
    assert sets(merger.finish()) == {frozenset({(9, 10)})}
    assert len(merger.finish()) == 0


def chain_of_bursts(merger, steps):
    """Bursts of two rings in turn, each beginning before the one before it ends; what comes of them, step by step."""
    for step in range(steps):
        ring, start = step % 2, 20 * step
        closed = table((ring, start, start + 25)) if step else table()
        going = table(((step + 1) % 2, start + 20, -1))
        yield merger.add(closed, going, start + 25)
        assert len(merger.waiting) * 20 <= 2 * LONGEST + 40


def test_an_endless_chain_is_given_out_once():
    merger = RingMerger(LONGEST, 0)
    groups = [found for found in chain_of_bursts(merger, 40) if len(found)]
    assert [len(found) for found in groups] == [1]
    length = groups[0].bursts["end"].max() - groups[0].bursts["start"].min()
    assert 2 * LONGEST - 25 <= length <= 2 * LONGEST + 25
    assert merger.left_out == 1


def test_a_ring_is_heard_again_after_an_endless_chain():
    merger = RingMerger(LONGEST, 3)
    list(chain_of_bursts(merger, 40))
    assert len(merger.add(table((0, 800, 810)), table(), 900)) == 0, "the end of the chain"
    assert merger.left_out == 1
    assert sets(merger.add(table((0, 890, 903)), table(), 910)) == {frozenset({(0, 890)})}
    assert merger.left_out == 0


def test_other_bursts_are_not_left_out_with_an_endless_chain():
    merger = RingMerger(LONGEST, 0)
    list(chain_of_bursts(merger, 20))
    going = table((0, 400, -1))
    found = merger.add(table((1, 380, 405), (3, 380, 400)), going, 406)
    assert sets(found) == {frozenset({(3, 380)})}


@pytest.mark.parametrize("gap", [0, 4])
def test_first_and_last_ring_have_no_neighbours_across(gap):
    merger = RingMerger(LONGEST, gap)
    found = merger.add(table((0, 10, 20), (1023, 10, 20)), table(), 50)
    assert len(found) == 2
