# SPDX-License-Identifier: Apache-2.0
"""False tracks by calculation against tracks followed plot by plot."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from secondary_proc.calculators.false_initiation import (
    false_initiation,
    initiation_build_up,
    occupied_gate,
    runs_handed_over,
)
from secondary_proc.calculators.false_tracking import (
    false_tracks_kept,
    survival,
    tracking_build_up,
    tracks_by_misses,
)
from secondary_proc.calculators.rule_chain import rule_chain
from secondary_proc.initiation.l_of_m import CONFIRMED, IDLE


def confirms(word, hits, window, misses):
    """Scan of the confirmation by a rule, without any automaton; None where the word ends before."""
    begin = 0
    for scan, symbol in enumerate(word):
        if misses is not None and scan - begin >= misses and not any(word[scan - misses : scan]):
            begin = scan
        if symbol and sum(word[max(begin, scan - window + 1) : scan + 1]) >= hits:
            return scan
    return None


@pytest.mark.parametrize("rule", [(2, 3, None), (3, 4, None), (3, 5, 1), (3, 5, 2), (2, 6, 3)])
def test_the_chain_confirms_every_word_as_the_rule_says(rule):
    hits, window, misses = rule
    chain = rule_chain(hits, window, misses)
    for word in product((0, 1), repeat=9):
        state, found = IDLE, None
        for scan, symbol in enumerate(word):
            state = chain[state, symbol]
            if state == CONFIRMED:
                found = scan
                break
        assert found == confirms(word, hits, window, misses), word


def test_dropping_at_the_first_miss_is_the_rule_of_plots_in_a_row():
    p = 0.3
    # Three in a row, and the tracks that are alive until then.
    expected = p**2 / (1.0 + p * (1.0 + p + p**2))
    assert false_initiation(3, 5, p, 1).handed_over == pytest.approx(expected, rel=1e-12)


@given(p=st.floats(0.001, 0.6), m=st.integers(2, 6))
def test_runs_have_their_closed_form(p, m):
    assert false_initiation(m, m, p).handed_over == pytest.approx(
        float(runs_handed_over(m, p)), rel=1e-9
    )


@given(
    p=st.floats(0.001, 0.7),
    rule=st.sampled_from([(2, 3), (3, 4), (3, 5), (4, 6)]),
    misses=st.sampled_from([None, 1, 2]),
)
def test_every_false_plot_starts_a_track_or_lies_in_a_gate(p, rule, misses):
    steady = false_initiation(*rule, p, misses)
    assert steady.started + p * steady.tentative == pytest.approx(1.0)
    assert 0.0 < steady.handed_over < steady.started


def test_the_build_up_ends_in_the_steady_state():
    tentative, confirmed = initiation_build_up(3, 4, 0.15, 80)
    steady = false_initiation(3, 4, 0.15)
    assert tentative[0] == 1.0
    assert confirmed[:2].tolist() == [0.0, 0.0]
    assert tentative[-1] == pytest.approx(steady.tentative)
    assert confirmed[-1] == pytest.approx(steady.handed_over)


def test_a_larger_first_gate_counts_once():
    narrow, wide = false_initiation(3, 3, [0.1, 0.01]), false_initiation(3, 3, 0.1)
    # One plot in ten survives the second gate that one in a hundred fills.
    assert narrow.handed_over / narrow.started == pytest.approx(1e-3)
    assert narrow.handed_over < wide.handed_over


def test_gates_fill_by_poissons_law():
    random = np.random.default_rng(3)
    n = 100_000
    share = np.mean(random.poisson(0.3, n) > 0)
    assert abs(share - occupied_gate(0.3)) < 4 * np.sqrt(0.25 / n)


@pytest.mark.parametrize(("empty", "misses"), [(0.8, 3), (0.6, 2), (0.9, 4), (1.0, 3)])
def test_tracks_kept_are_those_that_a_simulation_keeps(empty, misses):
    random = np.random.default_rng(misses)
    life, run = np.zeros(20_000), np.zeros(20_000, int)
    alive = np.ones(len(life), bool)
    while alive.any():
        life[alive] += 1
        run = np.where(random.random(len(life)) < empty, run + 1, 0)
        alive &= run < misses
    expected = false_tracks_kept(empty, misses)
    assert abs(life.mean() - expected) <= 4 * life.std() / np.sqrt(len(life)) + 1e-12
    assert survival(empty, misses, 3000).sum() == pytest.approx(expected, rel=1e-6)


def test_balance_of_misses():
    tracks = tracks_by_misses(0.7, 4)
    assert tracks[-1] == pytest.approx(1.0)
    np.testing.assert_allclose(tracks[1:], (1.0 + tracks[0]) * 0.7 ** np.arange(1, 5))
    assert tracks[:-1].sum() + 1.0 == pytest.approx(float(false_tracks_kept(0.7, 4)))


def test_the_build_up_of_tracks_reaches_its_steady_number():
    kept = tracking_build_up(np.full(800, 5.0), 0.8, 3)
    assert np.all(np.diff(kept) >= -1e-9)
    assert kept[0] == 5.0
    assert kept[-1] == pytest.approx(5.0 * float(false_tracks_kept(0.8, 3)))


@pytest.mark.parametrize("rule", [(0, 3, None), (4, 3, None), (3, 4, 0), (6, 11, None)])
def test_impossible_rules_are_refused(rule):
    with pytest.raises(ValueError, match=r"no rule|too many states"):
        rule_chain(*rule)


def test_gates_must_match_the_scans():
    with pytest.raises(ValueError, match="2 gates for 3 scans"):
        false_initiation(3, 4, [0.1, 0.1])
    with pytest.raises(ValueError, match="one scan"):
        false_initiation(1, 1, 0.1)
