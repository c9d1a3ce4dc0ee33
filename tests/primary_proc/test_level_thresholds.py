# SPDX-License-Identifier: Apache-2.0
"""Level quantisers: Max's tables, the conditions of the least error, and what levels cost in detection."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import trapezoid
from scipy.stats import rice

from primary_proc.calculators.pulse.amplitude_laws import (
    PULSE_LAWS,
    envelope_law,
    pulse_law,
    rice_density,
    strong_signal_density,
    synchronous_law,
)
from primary_proc.calculators.quantisation.level_thresholds import LEVEL_KINDS, level_thresholds
from primary_proc.calculators.quantisation.lloyd_max import lloyd_max
from primary_proc.calculators.quantisation.quantisation_loss import (
    multilevel_gain_db,
    weak_signal_loss_db,
)

KINDS = sorted(LEVEL_KINDS)


@pytest.mark.parametrize("name", sorted(PULSE_LAWS))
@pytest.mark.parametrize("signal", [0.0, 0.7, 3.0, 12.0])
def test_density_is_the_slope_of_exceedance(name, signal):
    law = pulse_law(name, signal)
    x = np.linspace(*law.support, 20_001)
    assert law.exceedance(law.support[0]) == pytest.approx(1.0, abs=1e-12)
    assert law.exceedance(law.support[1]) == pytest.approx(0.0, abs=1e-12)
    # Both integrals by the trapezoidal rule, its error below the square of the step.
    mass = np.concatenate([[0.0], np.cumsum((law.density(x)[1:] + law.density(x)[:-1]) / 2)])
    np.testing.assert_allclose(1.0 - mass * (x[1] - x[0]), law.exceedance(x), atol=1e-6)


def test_rice_is_scipys():
    x = np.linspace(0.01, 30.0, 500)
    for a in (0.3, 2.0, 9.0, 25.0):
        np.testing.assert_allclose(rice_density(x, a), rice(a).pdf(x), rtol=1e-9, atol=1e-300)


def test_the_strong_signal_form_is_near_from_three_on():
    for a in (3.0, 4.0, 5.0):
        x = np.linspace(0.3, a + 6.0, 1000)
        exact = rice_density(x, a)
        assert (
            np.abs(strong_signal_density(x, a) / exact.max() - exact / exact.max()).max() < 1.3e-3
        )


def test_an_unknown_law_is_refused():
    with pytest.raises(ValueError, match="none of envelope"):
        pulse_law("video", 1.0)


def test_max_published_the_gaussian_quantiser_of_four_levels():
    quantiser = lloyd_max(synchronous_law(0.0).density, (-9.0, 9.0), 4)
    np.testing.assert_allclose(quantiser.thresholds, [-0.9816, 0.0, 0.9816], atol=5e-5)
    np.testing.assert_allclose(quantiser.outputs, [-1.510, -0.4528, 0.4528, 1.510], atol=5e-4)
    assert quantiser.distortion == pytest.approx(0.1175, abs=5e-5)


@settings(max_examples=8)
@given(levels=st.integers(1, 12), signal=st.floats(0.0, 6.0))
def test_shooting_ends_at_the_conditions_of_the_least_error(levels, signal):
    law = envelope_law(signal)
    quantiser = lloyd_max(law.density, law.support, levels)
    middles = (quantiser.outputs[1:] + quantiser.outputs[:-1]) / 2.0
    np.testing.assert_allclose(quantiser.thresholds, middles, atol=1e-9)
    edges = np.concatenate([[law.support[0]], quantiser.thresholds, [law.support[1]]])
    assert np.all(np.diff(edges) > 0.0)
    for low, high, output in zip(edges[:-1], edges[1:], quantiser.outputs, strict=True):
        x = np.linspace(low, high, 4001)
        centroid = trapezoid(x * law.density(x), x) / trapezoid(law.density(x), x)
        assert output == pytest.approx(centroid, abs=1e-5)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("levels", [2, 3, 8])
def test_thresholds_increase_and_more_levels_lose_less(kind, levels):
    thresholds = level_thresholds(kind, levels)
    assert thresholds.shape == (levels - 1,)
    assert np.all(np.diff(thresholds) > 0.0)
    assert thresholds[0] > 0.0
    assert weak_signal_loss_db(level_thresholds(kind, levels + 1)) <= weak_signal_loss_db(
        thresholds
    )


@pytest.mark.parametrize("levels", [2, 3, 5, 8])
def test_no_thresholds_lose_less_than_those_for_weak_signals(levels):
    best = weak_signal_loss_db(level_thresholds("weak-signal", levels))
    rng = np.random.default_rng(levels)
    others = np.sort(rng.uniform(0.2, 5.0, (200, levels - 1)), axis=1)
    assert best <= min(map(weak_signal_loss_db, others)) + 1e-9
    near = level_thresholds("weak-signal", levels) + rng.normal(0.0, 0.01, (50, levels - 1))
    assert best <= min(map(weak_signal_loss_db, near)) + 1e-9


def test_equal_probability_shares_the_law_given():
    law = envelope_law(2.0)
    shares = law.exceedance(level_thresholds("equal-probability", 5, law=law))
    np.testing.assert_allclose(shares, [0.8, 0.6, 0.4, 0.2], atol=1e-9)


def test_uniform_thresholds_are_multiples_of_the_step():
    np.testing.assert_allclose(level_thresholds("uniform", 5, step=0.7), [0.7, 1.4, 2.1, 2.8])


@pytest.mark.parametrize(
    ("kind", "levels", "step", "reason"),
    [
        ("logarithmic", 4, 1.0, "none of uniform"),
        ("uniform", 1, 1.0, "levels must be"),
        ("lloyd-max", 65, 1.0, "levels must be"),
        ("uniform", 4, 0.0, "step must be positive"),
        ("uniform", 4, float("nan"), "step must be positive"),
    ],
)
def test_impossible_levels_are_refused(kind, levels, step, reason):
    with pytest.raises(ValueError, match=reason):
        level_thresholds(kind, levels, step=step)


def test_binary_quantisation_costs_a_decibel():
    assert multilevel_gain_db(16, 1e-5) == pytest.approx(1.04, abs=0.005)
    assert weak_signal_loss_db([1.785]) == pytest.approx(0.943, abs=0.0005)
