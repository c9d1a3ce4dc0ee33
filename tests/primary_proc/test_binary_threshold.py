# SPDX-License-Identifier: Apache-2.0
"""The first threshold by three criteria, the uniform quantiser, the grid and the delay."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad

from primary_proc.calculators.pulse.amplitude_laws import envelope_law, pulse_law, synchronous_law
from primary_proc.calculators.quantisation.binary_threshold import (
    average_risk,
    information,
    information_kept,
    least_risk_threshold,
    most_information_threshold,
    neyman_pearson_threshold,
    whole_information,
)
from primary_proc.calculators.quantisation.range_delay import (
    best_delay_threshold,
    crossing_delay_variance,
    potential_delay_variance,
)
from primary_proc.calculators.quantisation.range_sampling import (
    reconstruct,
    reconstruction_error,
    triangular_reconstruction_error,
    widened_probabilities,
)
from primary_proc.calculators.quantisation.surveillance_grid import SurveillanceGrid
from primary_proc.calculators.quantisation.uniform_quantiser import (
    characteristic_function,
    grouped_moments,
    quantised,
    sheppard_variance,
    widest_step,
)
from radar_common.parameters import ParameterError

LAWS = ["envelope", "fluctuating", "synchronous"]


@pytest.mark.parametrize("law", LAWS)
@given(probability=st.floats(1e-9, 0.9))
def test_noise_exceeds_its_threshold_as_often_as_wanted(law, probability):
    threshold = neyman_pearson_threshold(probability, law)
    assert pulse_law(law, 0.0).exceedance(threshold) == pytest.approx(probability, rel=1e-6)


@given(
    law=st.sampled_from(LAWS),
    signal=st.floats(0.3, 8.0),
    prior=st.floats(0.02, 0.98),
    miss=st.floats(0.1, 10.0),
    false=st.floats(0.1, 10.0),
)
def test_no_threshold_has_less_risk(law, signal, prior, miss, false):
    costs = {"law": law, "prior": prior, "miss_cost": miss, "false_cost": false}
    best = least_risk_threshold(signal, **costs)
    others = np.linspace(0.0 if law != "synchronous" else -20.0, 30.0, 2001)
    assert average_risk(best, signal, **costs) <= average_risk(others, signal, **costs).min() + 1e-9


@pytest.mark.parametrize("signal", [0.01, 0.1, 1.0, 5.0, 30.0])
def test_an_envelope_has_the_least_risk_between_the_two_limits(signal):
    threshold = least_risk_threshold(signal)
    assert max(np.sqrt(2.0), signal / 2.0) <= threshold + 1e-6
    assert threshold < np.sqrt(2.0) + signal / 2.0
    assert least_risk_threshold(signal, law="synchronous") == pytest.approx(signal / 2.0)


def test_where_a_signal_is_all_but_certain_every_envelope_is_one():
    assert least_risk_threshold(1.0, prior=0.9) == 0.0
    assert least_risk_threshold(0.5, prior=0.9, law="fluctuating") == 0.0


@settings(max_examples=30)
@given(law=st.sampled_from(LAWS), signal=st.floats(0.2, 6.0), prior=st.floats(0.05, 0.95))
def test_no_threshold_carries_more_information_and_none_more_than_the_sample(law, signal, prior):
    best = most_information_threshold(signal, law=law, prior=prior)
    most = information(best, signal, law=law, prior=prior)
    others = information(np.linspace(-3.0, 15.0, 1001), signal, law=law, prior=prior)
    assert most >= others.max() - 1e-12
    assert 0.0 < most < whole_information(signal, law=law, prior=prior)


def test_a_strong_signal_is_told_by_one_bit():
    assert whole_information(20.0) == pytest.approx(1.0, abs=1e-9)
    assert information_kept(20.0) == pytest.approx(1.0, abs=1e-6)
    assert information_kept(2.0) == pytest.approx(0.73, abs=0.005)


@pytest.mark.parametrize(
    "bad", [{"signal": 0.0}, {"signal": 1.0, "prior": 1.0}, {"signal": 1.0, "law": "video"}]
)
def test_impossible_values_are_refused(bad):
    for choose in (least_risk_threshold, most_information_threshold):
        with pytest.raises(ValueError, match=r"must be positive|none of"):
            choose(**bad)


@pytest.mark.parametrize("law", [envelope_law(0.0), envelope_law(3.0), synchronous_law(1.0)])
def test_quantised_samples_have_the_grouped_moments(law):
    rng = np.random.default_rng(3)
    grid = np.linspace(*law.support, 20_001)
    samples = np.interp(rng.random(100_000), 1.0 - law.exceedance(grid), grid)
    for step, offset in ((0.5, 0.0), (1.0, 0.3)):
        mean, variance = grouped_moments(law, step, offset)
        values = quantised(samples, step, offset)
        # The variance of a variance is at most 3 of its squares here.
        assert values.mean() == pytest.approx(mean, abs=4.0 * np.sqrt(variance / 1e5))
        assert values.var() == pytest.approx(variance, rel=4.0 * np.sqrt(3.0 / 1e5))


@given(step=st.floats(0.05, 1.0), offset=st.floats(-1.0, 1.0))
def test_sheppards_correction_is_exact_for_steps_up_to_sigma(step, offset):
    mean, variance = grouped_moments(synchronous_law(0.0), step, offset)
    assert mean == pytest.approx(0.0, abs=1e-8)
    assert sheppard_variance(variance, step) == pytest.approx(1.0, abs=2e-7)


def test_a_normal_density_needs_steps_of_one_sigma():
    law = synchronous_law(0.0)
    frequency = np.array([0.0, 0.2, 0.5])
    expected = np.exp(-2.0 * np.square(np.pi * frequency))
    np.testing.assert_allclose(characteristic_function(law, frequency), expected, atol=1e-12)
    assert widest_step(law, 0.0072) == pytest.approx(1.0, abs=1e-3)


@given(gamma=st.floats(1.0, 50.0))
def test_the_triangle_has_a_closed_form(gamma):
    numerical = reconstruction_error(lambda lag: 1.0 - np.abs(lag), 1.0 / gamma)
    assert numerical == pytest.approx(float(triangular_reconstruction_error(gamma)), rel=1e-9)


def test_a_sample_is_its_own_reconstruction():
    samples = np.array([[1.0, -2.0, 0.5], [0.0, 1.0, 4.0]])
    back = reconstruct(samples, 0.5, [0.0, 0.5, 1.0, 0.6], lambda lag: np.exp(-np.square(lag)))
    np.testing.assert_allclose(back[:, :3], samples)
    np.testing.assert_allclose(back[:, 3], samples[:, 1] * np.exp(-0.01))


@given(signal=st.floats(0.0, 1.0), noise=st.floats(0.0, 1.0), factor=st.integers(1, 6))
def test_a_wider_quantum_is_several_narrow_ones(signal, noise, factor):
    wide = widened_probabilities(signal, noise, factor)
    missed = (1.0 - signal) * np.prod(np.full(factor - 1, 1.0 - noise))
    assert wide[0] == pytest.approx(1.0 - missed)
    assert wide[1] == pytest.approx(1.0 - np.prod(np.full(factor, 1.0 - noise)))


def test_the_two_ways_to_count_the_pulses_of_a_burst_agree():
    grid = SurveillanceGrid(2e-6, 1.0 / 500.0, 10.0, 300e3)
    rotation = 2.0 * np.pi / 10.0
    width = np.radians(1.5)
    assert grid.pulses_in_burst(width) == pytest.approx(500.0 * width / rotation)
    assert grid.cells == pytest.approx(grid.range_cells * 500.0 * 10.0)
    with pytest.raises(ParameterError, match="must be positive"):
        SurveillanceGrid(0.0, 1.0, 1.0, 1.0)


@pytest.mark.parametrize(("model", "loss"), [("book", np.e / 2.0), ("physical", np.e)])
@given(signal=st.floats(0.5, 50.0), level=st.floats(0.01, 0.99))
def test_no_threshold_times_better_than_the_steepest_point(model, loss, signal, level):
    least = crossing_delay_variance(best_delay_threshold(signal), signal, model)
    assert least / potential_delay_variance(signal) == pytest.approx(loss)
    assert crossing_delay_variance(level * signal, signal, model) >= least * (1.0 - 1e-12)
    assert np.isnan(crossing_delay_variance(1.01 * signal, signal, model))


def test_whole_information_is_the_integral():
    with_signal, noise = envelope_law(2.0), envelope_law(0.0)

    def each(x):
        one, other = with_signal.density(x), noise.density(x)
        both = (one + other) / 2.0
        return (one * np.log2(one / both) + other * np.log2(other / both)) / 2.0

    assert whole_information(2.0) == pytest.approx(quad(each, 1e-9, 10.0, limit=200)[0], rel=1e-7)
