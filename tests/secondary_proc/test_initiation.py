# SPDX-License-Identifier: Apache-2.0
"""Automata against their definition, and the likelihood ratio's two limits."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest

from secondary_proc import score
from secondary_proc.initiation import INITIATIONS, Evidence
from secondary_proc.initiation.l_of_m import CONFIRMED, IDLE, LOfM, automaton


def first_confirmation(table, word):
    state = IDLE
    for scan, symbol in enumerate(word):
        state = table[state, symbol]
        if state == CONFIRMED:
            return scan
    return None


def by_definition(word, hits, window):
    for scan, symbol in enumerate(word):
        if symbol and sum(word[max(0, scan - window + 1) : scan + 1]) >= hits:
            return scan
    return None


@pytest.mark.parametrize(("hits", "window"), [(2, 2), (3, 3), (2, 3), (3, 4), (3, 5), (4, 6)])
def test_automaton_is_l_ones_in_any_m(hits, window):
    table = automaton(hits, window)
    for word in product((0, 1), repeat=10):
        assert first_confirmation(table, word) == by_definition(word, hits, window), word


def test_three_of_four_is_the_graph_of_the_book():
    # Kuzmin 1967, figure 3.16, its state 6 called CONFIRMED here: next states by symbol 0 and 1.
    book = {0: (0, 1), 1: (3, 2), 2: (5, 6), 3: (0, 4), 4: (3, 6), 5: (0, 6)}
    table = automaton(3, 4)
    assert len(table) == 7
    names, waiting = {0: IDLE, 6: CONFIRMED}, [0]
    while waiting:
        state = waiting.pop()
        for symbol, following in enumerate(book[state]):
            ours = int(table[names[state], symbol])
            if following not in names:
                names[following] = ours
                waiting.append(following)
            assert names[following] == ours
    assert len(set(names.values())) == 7


@pytest.mark.parametrize("gap", [1, 2])
def test_rule_of_pairs_remembers_the_scans_between(gap):
    rule = LOfM(3, 4)
    assert rule.longest_gap == 2
    state = rule.opened(np.array([gap]))[0]
    table = automaton(3, 4)
    assert state == (table[IDLE, 1] if gap == 1 else table[table[IDLE, 1], 0])


def evidence(**values):
    usual = {"rule": 0, "found": True, "hits": 4, "misses": 0, "score": 20.0}
    columns = {name: np.atleast_1d(value) for name, value in (usual | values).items()}
    return Evidence(**columns, threshold=12.0)


def test_likelihood_ratio_confirms_by_score_and_hits():
    rule = INITIATIONS["likelihood_ratio"](3, 4, 2)
    verdict = rule.judge(
        evidence(
            rule=np.zeros(4, np.uint8),
            found=np.array([True, True, True, False]),
            hits=np.array([4, 4, 2, 4]),
            misses=np.array([0, 0, 0, 1]),
            score=np.array([12.1, 11.9, 20.0, 20.0]),
        )
    )
    assert list(verdict.confirmed) == [True, False, False, False]
    assert not verdict.dropped.any()


@pytest.mark.parametrize("misses", [1, 2, 3])
def test_likelihood_ratio_drops_by_misses(misses):
    rule = INITIATIONS["likelihood_ratio"](3, 4, 2)
    verdict = rule.judge(evidence(found=False, misses=misses))
    assert verdict.dropped[0] == (misses >= 2)


def test_the_score_confirms_no_more_false_candidates_than_it_promises():
    # A hit in the gate of a false candidate: Poisson plots, uniform over the gate.
    random = np.random.default_rng(3)
    detection, mean_false, gate = 0.85, 0.4, 3.5
    area = np.pi * gate**2
    candidates, scans = 40_000, 12
    total, ever = np.zeros(candidates), np.zeros(candidates, bool)
    bound = score.confirmation_threshold(1000.0, 50.0)
    for _ in range(scans):
        count = random.poisson(mean_false, candidates)
        # Nearest of several is the smallest of uniform draws.
        nearest = area / np.pi * (1.0 - random.random(candidates) ** (1.0 / np.maximum(count, 1)))
        density = mean_false / area
        gain = score.hit(detection, nearest, np.ones(candidates), np.full(candidates, density))
        total += np.where(count > 0, gain, score.miss(detection))
        ever |= total >= bound
    share = ever.mean()
    promised = 50.0 / 1000.0
    assert 0.0 < share <= promised + 4 * np.sqrt(promised / candidates)


def test_threshold_follows_the_wanted_rate():
    strict = score.confirmation_threshold(180_000.0, 0.1)
    assert strict == pytest.approx(np.log(1.8e6))
    assert score.confirmation_threshold(180_000.0, 1.0) < strict
    assert score.confirmation_threshold(0.0, 1.0) == pytest.approx(np.log(10.0))
