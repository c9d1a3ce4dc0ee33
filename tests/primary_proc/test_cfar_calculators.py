# SPDX-License-Identifier: Apache-2.0
"""CFAR calculators: closed forms against quadrature, the published sums and simulation; thresholds and inverses."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.special import comb
from scipy.stats import binom

from primary_proc.calculators.cfar.cfar_detection import (
    detection_probability,
    false_alarm_probability,
    loss_db,
    multiplier_for,
    required_snr_db,
)
from primary_proc.calculators.cfar.cfar_half_laws import GreatestLevel, SmallestLevel
from primary_proc.calculators.cfar.cfar_laws import AverageLevel, KnownLevel, OrderedLevel
from primary_proc.calculators.pulse.target_models import TARGETS

CONFIDENCE = 0.999
LAWS = [
    AverageLevel(8),
    AverageLevel(256),
    GreatestLevel(1),
    GreatestLevel(16),
    GreatestLevel(128),
    SmallestLevel(1),
    SmallestLevel(16),
    SmallestLevel(128),
    OrderedLevel(1, 1),
    OrderedLevel(32, 1),
    OrderedLevel(32, 24),
    OrderedLevel(128, 128),
]
laws = st.one_of(
    st.integers(1, 128).map(AverageLevel),
    st.integers(1, 64).map(GreatestLevel),
    st.integers(1, 64).map(SmallestLevel),
    st.integers(1, 64).flatmap(
        lambda cells: st.integers(1, cells).map(lambda order: OrderedLevel(cells, order))
    ),
)


@pytest.mark.parametrize("law", LAWS, ids=str)
def test_the_closed_forms_are_means_over_the_density(law):
    level, weight = law.quadrature()
    assert weight.sum() == pytest.approx(1.0, abs=1e-12)
    assert level @ weight == pytest.approx(law.mean, rel=1e-11)
    multiplier = np.array([1e-3, 0.1, 1.0, 5.0])
    expected = np.exp(-np.outer(multiplier, level)) @ weight
    assert false_alarm_probability(law, multiplier) == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("half", [1, 4, 16, 32])
def test_the_halves_follow_the_published_sums(half):
    """Gandhi and Kassam's sums, whose terms nearly cancel for greatest-of: at probabilities where digits are left."""
    on_sum = np.array([0.05, 0.3])
    term = np.arange(half)
    smaller = 2.0 * np.sum(
        comb(half - 1 + term, term) * (2.0 + on_sum[:, None]) ** -(half + term), axis=1
    )
    greater = 2.0 * (1.0 + on_sum) ** -half - smaller
    for law, expected in ((GreatestLevel(half), greater), (SmallestLevel(half), smaller)):
        assert false_alarm_probability(law, half * on_sum) == pytest.approx(expected, rel=1e-6)


@settings(deadline=None, max_examples=100)
@given(law=laws, log_probability=st.floats(np.log(1e-10), np.log(0.9)))
def test_multiplier_and_false_alarm_probability_are_inverse(law, log_probability):
    probability = float(np.exp(log_probability))
    multiplier = multiplier_for(law, probability)
    assert false_alarm_probability(law, multiplier) == pytest.approx(probability, rel=1e-9)


@settings(deadline=None, max_examples=40)
@given(
    law=laws,
    log_probability=st.floats(np.log(1e-8), np.log(1e-2)),
    detection=st.floats(0.1, 0.95),
    target=st.sampled_from(list(TARGETS)),
)
def test_the_required_ratio_gives_the_detection_probability(
    law, log_probability, detection, target
):
    probability = float(np.exp(log_probability))
    snr_db = required_snr_db(law, probability, detection, target)
    multiplier = multiplier_for(law, probability)
    found = detection_probability(law, multiplier, snr_db, target)
    assert found == pytest.approx(detection, abs=1e-6)


@settings(deadline=None, max_examples=40)
@given(
    cells=st.sampled_from([4, 8, 16, 32, 64]),
    target=st.sampled_from(["steady", "slow", "slow-dominant"]),
)
def test_losses_are_ordered_and_fall_with_more_cells(cells, target):
    def losses(count):
        half = count // 2
        kinds = AverageLevel(count), GreatestLevel(half), SmallestLevel(half)
        return [loss_db(law, 1e-4, 0.5, target) for law in kinds]

    few, many = losses(cells), losses(2 * cells)
    assert 0.0 < few[0] < few[1] < few[2]
    assert all(more < less for more, less in zip(many, few, strict=True))


def test_very_many_cells_know_the_level():
    for law in (AverageLevel(100_000), GreatestLevel(50_000), OrderedLevel(100_000, 75_000)):
        assert loss_db(law, 1e-4) == pytest.approx(0.0, abs=0.02)
    assert loss_db(KnownLevel(), 1e-4) == 0.0


@pytest.mark.parametrize("target", ["steady", "slow", "fast-dominant"])
@pytest.mark.parametrize("law", [AverageLevel(16), SmallestLevel(8), OrderedLevel(16, 12)], ids=str)
def test_detection_equals_a_simulation(law, target):
    trials, snr_db, probability = 40_000, 12.0, 1e-3
    rng = np.random.default_rng(3)
    cells = rng.exponential(1.0, (trials, 16))
    level = {
        AverageLevel: lambda: cells.mean(axis=1),
        SmallestLevel: lambda: np.minimum(cells[:, :8].mean(axis=1), cells[:, 8:].mean(axis=1)),
        OrderedLevel: lambda: np.sort(cells, axis=1)[:, 11],
    }[type(law)]()
    power = {
        "steady": lambda: np.ones(trials),
        "slow": lambda: rng.exponential(1.0, trials),
        "fast-dominant": lambda: rng.gamma(2.0, 0.5, trials),
    }[target]()
    field = rng.standard_normal((2, trials)) / np.sqrt(2.0)
    field[0] += np.sqrt(power * 10.0 ** (snr_db / 10.0))
    multiplier = multiplier_for(law, probability)
    found = int((np.square(field).sum(axis=0) > multiplier * level).sum())
    expected = float(detection_probability(law, multiplier, snr_db, target))
    low, high = binom.interval(CONFIDENCE, trials, expected)
    assert low <= found <= high


def test_what_makes_no_sense_is_refused():
    for probability in (0.0, 1.0, float("nan")):
        with pytest.raises(ValueError, match="threshold"):
            multiplier_for(AverageLevel(8), probability)
    with pytest.raises(ValueError, match="needs"):
        required_snr_db(AverageLevel(8), 0.1, 0.05, "slow")
