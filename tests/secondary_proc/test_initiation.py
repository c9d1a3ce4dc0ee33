# SPDX-License-Identifier: Apache-2.0
"""Automata against their definition, the rules' limits, and the errors that they promise."""

from __future__ import annotations

from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from secondary_proc import score
from secondary_proc.calculators.hit_sequence import follow_hit_test, wald_bounds
from secondary_proc.calculators.rule_chain import CONFIRMED, IDLE, rule_chain
from secondary_proc.initiation import DROP_RULES, INITIATIONS, Evidence
from secondary_proc.initiation.l_of_m import LOfM
from secondary_proc.parameters import TrackerParameters

PARAMETERS = TrackerParameters()


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
    table = rule_chain(hits, window)
    for word in product((0, 1), repeat=10):
        assert first_confirmation(table, word) == by_definition(word, hits, window), word


def test_three_of_four_is_the_graph_of_the_book():
    # Kuzmin 1967, figure 3.16, its state 6 called CONFIRMED here: next states by symbol 0 and 1.
    book = {0: (0, 1), 1: (3, 2), 2: (5, 6), 3: (0, 4), 4: (3, 6), 5: (0, 6)}
    table = rule_chain(3, 4)
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
    rule = LOfM(PARAMETERS)
    assert rule.longest_gap == 2
    state = rule.opened(np.array([gap]))[0]
    table = rule_chain(3, 4)
    assert state == (table[IDLE, 1] if gap == 1 else table[table[IDLE, 1], 0])


@pytest.mark.parametrize(("hits", "window"), [(2, 2), (3, 3), (3, 4), (2, 5), (4, 7)])
@pytest.mark.parametrize("misses", [1, 2, 3])
def test_misses_in_a_row_end_a_candidate_of_l_of_m(hits, window, misses):
    parameters = replace(
        PARAMETERS,
        confirm_hits=hits,
        confirm_window=window,
        drop_rule="misses",
        tentative_misses=misses,
    )
    rule, alone = LOfM(parameters), LOfM(replace(parameters, drop_rule="rule"))
    for word in product((0, 1), repeat=8):
        state = state_alone = rule.opened(np.array([1]))
        seen = [1]
        for symbol in (1, *word):
            seen.append(symbol)
            verdict = rule.judge(evidence(rule=state, found=bool(symbol)))
            without = alone.judge(evidence(rule=state_alone, found=bool(symbol)))
            assert verdict.confirmed[0] == without.confirmed[0]
            assert verdict.dropped[0] == (without.dropped[0] or not any(seen[-misses:]))
            if verdict.confirmed[0] or verdict.dropped[0]:
                break
            state, state_alone = verdict.rule, without.rule


@pytest.mark.parametrize("name", INITIATIONS)
@pytest.mark.parametrize("drop_rule", DROP_RULES)
def test_a_row_of_misses_ends_every_candidate(name, drop_rule):
    rule = INITIATIONS[name](replace(PARAMETERS, drop_rule=drop_rule))
    memory, total = rule.opened(np.array([1])), 2.0
    memory = rule.judge(evidence(rule=memory, hits=2, score=total)).rule
    for misses in range(1, 8):
        total += score.miss(PARAMETERS.detection_probability)
        verdict = rule.judge(evidence(rule=memory, found=False, hits=2, misses=misses, score=total))
        assert not verdict.confirmed[0]
        if verdict.dropped[0]:
            break
        memory = verdict.rule
    assert verdict.dropped[0]
    assert misses == (2 if drop_rule == "misses" or name == "l_of_m" else misses)


def evidence(**values):
    usual = {"rule": 0, "found": True, "hits": 4, "misses": 0, "score": 20.0}
    columns = {name: np.atleast_1d(value) for name, value in (usual | values).items()}
    return Evidence(**columns, threshold=12.0)


@pytest.mark.parametrize(("name", "bound"), [("likelihood_ratio", 12.0), ("wald", 11.9487)])
def test_tests_of_the_ratio_confirm_by_score_and_hits(name, bound):
    verdict = INITIATIONS[name](PARAMETERS).judge(
        evidence(
            rule=np.zeros(4, np.int64),
            found=np.array([True, True, True, False]),
            hits=np.array([4, 4, 2, 4]),
            misses=np.array([0, 0, 0, 1]),
            score=np.array([bound + 0.001, bound - 0.001, 20.0, 20.0]),
        )
    )
    assert list(verdict.confirmed) == [True, False, False, False]
    assert not verdict.dropped.any()


@pytest.mark.parametrize("name", ["likelihood_ratio", "wald"])
@pytest.mark.parametrize("misses", [1, 2, 3])
def test_misses_end_the_candidates_of_both_tests(name, misses):
    rule = INITIATIONS[name](replace(PARAMETERS, drop_rule="misses"))
    verdict = rule.judge(evidence(found=False, misses=misses))
    assert verdict.dropped[0] == (misses >= 2)


@pytest.mark.parametrize("name", INITIATIONS)
def test_a_low_score_ends_candidates_when_asked_to(name):
    rule = INITIATIONS[name](replace(PARAMETERS, drop_rule="score", missed_targets=0.05))
    for total, dropped in ((-3.1, True), (-2.9, False)):
        state = rule.opened(np.array([1]))
        verdict = rule.judge(evidence(rule=state, found=False, hits=2, score=total))
        assert verdict.dropped[0] == dropped


@pytest.mark.parametrize("found", [0.1, 0.85])
def test_walds_test_does_what_its_calculator_says(found):
    # A gate of which the false plots fill a tenth, for targets and for false plots.
    random = np.random.default_rng(5)
    detection, occupied, missed, false = 0.85, 0.1, 0.05, 1e-3
    rule = INITIATIONS["wald"](
        replace(PARAMETERS, detection_probability=detection, missed_targets=missed)
    )
    mean = -np.log1p(-occupied)
    gain = rule.hit_gain(np.ones(1), np.array([mean / (np.pi * PARAMETERS.gate_sigmas**2)]))[0]
    assert gain == pytest.approx(np.log(detection / occupied))
    tracks, scans = 20_000, 30
    total, hits = np.zeros(tracks), np.full(tracks, 9)
    confirmed, open_ = np.zeros(tracks, bool), np.ones(tracks, bool)
    for _ in range(scans):
        seen = random.random(tracks) < found
        # The exact step of a miss; the tracker's own is lower by the share of gates that false plots fill.
        total += np.where(seen, gain, np.log((1 - detection) / (1 - occupied)))
        verdict = rule.judge(
            Evidence(
                rule=np.zeros(tracks, np.int64),
                found=seen,
                hits=hits,
                misses=np.zeros(tracks, np.int64),
                score=total,
                threshold=-np.log(false),
            )
        )
        confirmed |= verdict.confirmed & open_
        open_ &= ~(verdict.confirmed | verdict.dropped)
    expected = follow_hit_test(found, detection, occupied, wald_bounds(false, missed), scans)
    share = expected.confirmed[-1]
    assert abs(confirmed.mean() - share) < 4 * np.sqrt(share * (1 - share) / tracks) + 1e-9
    assert confirmed.mean() < 4 * false if found < 0.5 else confirmed.mean() > 1.0 - missed


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
