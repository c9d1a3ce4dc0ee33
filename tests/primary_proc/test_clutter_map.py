# SPDX-License-Identifier: Apache-2.0
"""The clutter map: exact in noise while it learns and after, blind to what stays, not to what moves."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.stats import binom

from primary_proc.calculators.cfar.cfar_laws import AverageLevel
from primary_proc.calculators.cfar.map_law import MapLevel, map_false_alarm, map_variance
from primary_proc.normalisers.clutter_map import ClutterMap
from primary_proc.normalisers.map_memory import bins_for

CONFIDENCE = 0.999
BINS, PULSES = 16, 8
TURN = BINS * PULSES
WEIGHT = 0.05


def azimuth(pulses, turn=TURN, first=0):
    return (first + np.arange(pulses) + 0.5) % turn * (2 * np.pi / turn)


def noise(seed, turns, cells, sigma=0.3):
    return np.random.default_rng(seed).rayleigh(sigma, (turns * TURN, cells)).astype(np.float32)


def run(normaliser, video, angle=None):
    out = np.empty(video.shape, np.float32)
    bad = normaliser.ratios(video, azimuth(len(video)) if angle is None else angle, out)
    return out, bad


def settled(weight, samples, turns):
    """Weights of the samples of a map after some turns, the oldest left out."""
    return np.repeat(weight * (1 - weight) ** np.arange(turns) / samples, samples)


def test_a_map_of_one_turn_is_an_average():
    """Equal weights: P_fa = (1 + T / n)^-n."""
    multiplier = np.array([0.0, 1.0, 5.0, 20.0])
    assert map_false_alarm(multiplier, np.full(12, 1 / 12)) == pytest.approx(
        np.exp(AverageLevel(12).log_exceedance(multiplier))
    )


def test_the_map_s_false_alarms_are_those_of_its_weighted_sum():
    """Nitzberg's product against a simulation of the recursion itself."""
    generator, weight, turns, number = np.random.default_rng(1), 0.3, 60, 40_000
    level = np.ones(number)
    for _ in range(turns):
        level += weight * (generator.exponential(size=number) - level)
    weights = settled(weight, 1, turns)
    for multiplier in (2.0, 5.0):
        chance = np.exp(-multiplier * level)
        exact = map_false_alarm(multiplier, weights)
        assert abs(chance.mean() - exact) < 3.3 * chance.std() / np.sqrt(number)


@pytest.mark.parametrize(("weight", "samples"), [(0.2, 4), (0.1, 4), (0.05, 8), (0.005, 16)])
def test_one_variance_stands_for_all_weights(weight, samples):
    """The gamma law with the variance of the sum, where the reference cells are known to be smaller or the same."""
    weights = settled(weight, samples, 2000)
    variance = map_variance(weight, samples, np.inf, 1.0)
    assert variance == pytest.approx(np.square(weights).sum())
    for multiplier in (2.3, 4.4):
        gamma = np.exp(-np.log1p(multiplier * variance) / variance)
        assert gamma == pytest.approx(map_false_alarm(multiplier, weights), rel=0.01)


def test_the_greater_level_is_the_law_s():
    law = MapLevel(20, 0.01)
    generator, number = np.random.default_rng(2), 200_000
    level = np.maximum(generator.gamma(100, 0.01, number), generator.gamma(20, 1 / 20, number))
    assert law.mean == pytest.approx(level.mean(), abs=3.3 * level.std() / np.sqrt(number))
    for multiplier in (0.0, 2.0, 5.0, 12.0):
        chance = np.exp(-multiplier * level)
        expected = np.exp(law.log_exceedance(multiplier))
        assert abs(chance.mean() - expected) <= 3.3 * chance.std() / np.sqrt(number) + 1e-9
    assert np.isfinite(law.log_exceedance(1e9))


def test_what_the_map_has_learned_hardly_moves_its_threshold():
    """Why one threshold serves all turns: the variance is small from the first turn on."""
    chances = [
        np.exp(MapLevel(32, map_variance(WEIGHT, PULSES, turns, 32 * PULSES)).log_exceedance(4.4))
        for turns in (0, 1, 3, 10, 30, np.inf)
    ]
    assert chances == pytest.approx(np.full(6, chances[-1]), rel=1e-3)


@pytest.mark.parametrize("probability", [0.01, 0.1])
def test_noise_exceeds_with_its_probability_while_learning_and_after(probability):
    cells, turns = 1500, 12
    normaliser = ClutterMap(cells, 16, 2, WEIGHT, BINS)
    found, _ = run(normaliser, noise(3, turns, cells))
    ones = found > normaliser.threshold(probability).astype(np.float32)
    counts = ones.reshape(turns, TURN * cells).sum(axis=1)
    confidence = 1.0 - (1.0 - CONFIDENCE) / turns
    low, high = binom.interval(confidence, TURN * cells, probability)
    assert ((counts >= low) & (counts <= high)).all(), "in every turn, the first one too"
    edge = np.r_[0:18, cells - 18 : cells]
    low, high = binom.interval(CONFIDENCE, turns * TURN * len(edge), probability)
    assert low <= ones[:, edge].sum() <= high


def test_in_the_first_turn_strong_echoes_keep_their_strength():
    video = noise(4, 1, 200)
    video[5, 100] = 0.3 * 50.0
    normaliser = ClutterMap(200, 16, 2, WEIGHT, BINS)
    found, _ = run(normaliser, video)
    power = found[5, 100] * normaliser.noise_scale[100]
    assert 10 * np.log10(power) == pytest.approx(10 * np.log10(50.0**2 / 2), abs=2.5)


def test_what_stays_fades_and_what_moves_stays():
    """Ratios of an echo in one cell, and of one that goes on by three cells a turn."""
    turns, cells = 25, 200
    video = noise(5, turns, cells)
    video[:, 50] += 3.0
    for turn in range(turns):
        video[turn * TURN : (turn + 1) * TURN, 70 + 3 * turn] += 3.0
    normaliser = ClutterMap(cells, 16, 2, WEIGHT, BINS)
    found, _ = run(normaliser, video)
    threshold = normaliser.threshold(0.01)[0]
    seen = (found > threshold).reshape(turns, TURN, cells).mean(axis=1)
    assert (seen[:4, 50] == 1.0).all(), "not swallowed at once"
    assert (seen[8:, 50] < 0.01).all(), "gone after ln(1 - 1/T) / ln(1 - weight) = 5 turns"
    assert all(seen[turn, 70 + 3 * turn] == 1.0 for turn in range(turns))


def test_what_was_learned_is_forgotten():
    turns, cells = 110, 60
    video = noise(6, turns, cells)
    video[: 20 * TURN, 30] += 3.0
    normaliser = ClutterMap(cells, 8, 1, 2 * WEIGHT, BINS)
    found, _ = run(normaliser, video)
    ones = (found > normaliser.threshold(0.1)).reshape(turns, TURN, cells)[:, :, 30].mean(axis=1)
    assert ones[21:35].mean() < 0.01, "shadow of an echo that has gone"
    assert ones[100:].mean() == pytest.approx(0.1, abs=0.03)


@settings(deadline=None, max_examples=12)
@given(
    cuts=st.lists(st.integers(1, 3 * TURN - 1), unique=True, max_size=12),
    tremble=st.integers(0, 2),
)
def test_ratios_do_not_depend_on_how_pulses_are_cut(cuts, tremble):
    video = noise(7, 3, 90)
    angle = azimuth(len(video))
    # An encoder that steps back by half a step now and then, also between two bins.
    angle = (angle - 0.5 * (2 * np.pi / TURN) * (np.arange(len(video)) % 5 < tremble)) % (2 * np.pi)
    whole, _ = run(ClutterMap(90, 8, 1, WEIGHT, BINS), video, angle)
    normaliser = ClutterMap(90, 8, 1, WEIGHT, BINS)
    cuts = sorted(cuts)
    parts = [
        run(normaliser, part, where)[0]
        for part, where in zip(np.split(video, cuts), np.split(angle, cuts), strict=True)
    ]
    assert np.array_equal(np.concatenate(parts), whole)


def test_the_map_outlives_a_jump_and_a_change_of_rotation():
    cells = 90
    normaliser = ClutterMap(cells, 8, 1, 0.2, BINS)
    video = noise(8, 20, cells)
    video[:, 45] += 3.0
    run(normaliser, video)
    threshold = normaliser.threshold(0.01)[0]
    for turn, first in ((TURN, 70), (TURN // 2, 3), (3 * TURN, 0)):
        found, _ = run(normaliser, video[: 2 * turn], azimuth(2 * turn, turn, first))
        assert (found[:, 45] > threshold).mean() < 0.05


def test_the_map_outlives_samples_that_are_no_numbers():
    cells = 90
    normaliser = ClutterMap(cells, 8, 1, 0.2, BINS)
    video = noise(9, 12, cells)
    video[TURN : 2 * TURN] = np.nan
    video[3 * TURN + 5, 20:40] = np.inf
    video[4 * TURN : 5 * TURN, 60] = 1e19
    found, bad = run(normaliser, video)
    assert bad == TURN * cells + 20
    ones = (found > normaliser.threshold(0.1)).reshape(12, TURN, cells).mean(axis=1)
    others = np.r_[0:58, 62:90]
    assert ones[-1, others].mean() == pytest.approx(0.1, abs=0.02), "levels lost have come back"
    assert np.isfinite(found[-TURN:]).all()


def test_memory_is_bounded():
    assert bins_for(np.radians(1.4), 1024) * 1024 * 4 < 2.2e6
    assert bins_for(np.radians(0.05), 65536) * 65536 <= 1 << 26
    assert bins_for(np.radians(30.0), 4) >= 16
