# SPDX-License-Identifier: Apache-2.0
"""Bounds of the azimuth error: against their definitions, the book's working formulas, and each other."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.stats import ncx2

from primary_proc.calculators.azimuth.amplitude_accuracy import (
    rice_information,
    swerling_bound,
    unquantised_bound,
)
from primary_proc.calculators.azimuth.posterior_mean import posterior_mean
from primary_proc.calculators.azimuth.potential_accuracy import (
    bound_by_enumeration,
    bound_of_bits,
    quantised_bound,
)
from primary_proc.calculators.pulse.burst_shape import burst_shape
from primary_proc.calculators.pulse.burst_slope import ones_and_slopes, pattern_slope
from radar_common.antenna_pattern import PATTERNS


@pytest.mark.parametrize("fluctuation", ["steady", "fast"])
@pytest.mark.parametrize("pattern", ["gaussian", "sinc2"])
def test_slopes_are_differences_of_the_probabilities(pattern, fluctuation):
    """(3.27) and (3.33) against moving the target by a hundredth of a step."""
    half, step = 5.5, 0.01
    position = np.arange(11) - 5.0

    def ones(target):
        alpha = (position - target) / half
        shape, slope = PATTERNS[pattern](alpha), -pattern_slope(pattern, alpha) / half
        return ones_and_slopes(2.0, 2.5, shape, slope, fluctuation)

    difference = (ones(0.2 + step).probability - ones(0.2 - step).probability) / (2 * step)
    assert ones(0.2).slope == pytest.approx(difference, rel=1e-3, abs=1e-6)
    assert ones(0.2).zero == pytest.approx(1.0 - ones(0.2).probability, abs=1e-12)


@given(
    st.lists(st.tuples(st.floats(0.05, 0.95), st.floats(-1.0, 1.0)), min_size=1, max_size=8).filter(
        lambda pairs: max(abs(slope) for _, slope in pairs) > 0.01
    )
)
def test_the_sum_is_the_information_of_all_sequences(pairs):
    probability, slope = np.array(pairs).T
    assert float(bound_of_bits(probability, slope)) == pytest.approx(
        bound_by_enumeration(probability, slope), rel=1e-9
    )


def test_the_enumeration_of_seven_pulses():
    shape = burst_shape("gaussian", 7)
    alpha = (np.arange(7) - 3) / 3.5
    bits = ones_and_slopes(2.0, 2.5, shape, -pattern_slope("gaussian", alpha) / 3.5)
    assert bound_by_enumeration(bits.probability, bits.slope) == pytest.approx(1.118099, abs=1e-6)
    with pytest.raises(ValueError, match="at most 16"):
        bound_by_enumeration(np.full(17, 0.5), np.ones(17))


def test_strong_targets_have_no_overflow_and_no_false_precision():
    """Also of a strong target only the few bits at the edges tell anything."""
    strong = quantised_bound("gaussian", 11, 2.0, np.array([10.0, 30.0, 100.0]), book=False)
    assert (strong > 0.4).all()
    assert (strong < 0.9).all()
    assert np.isinf(quantised_bound("gaussian", 11, 2.0, 1000.0))
    assert np.isinf(quantised_bound("rectangular", 11, 2.0, 3.0))


def test_gaussian_working_formula_is_exact():
    strength = np.array([0.5, 1.0, 3.0, 6.0])
    for pulses in (7, 11, 15, 41):
        book = quantised_bound("gaussian", pulses, 2.0, strength, model="kuzmin")
        assert book == pytest.approx(quantised_bound("gaussian", pulses, 2.0, strength), rel=1e-9)


def test_names_are_checked():
    for wrong in (
        lambda: quantised_bound("gaussian", 11, 2.0, 3.0, "slow"),
        lambda: quantised_bound("gaussian", 11, 2.0, 3.0, model="guess"),
        lambda: quantised_bound("gaussian", 12, 2.0, 3.0, model="kuzmin"),
        lambda: quantised_bound("sinc", 11, 2.0, 3.0, model="kuzmin"),
        lambda: unquantised_bound("gaussian", 11, 3.0, "slow"),
        lambda: unquantised_bound("gaussian", 11, 3.0, model="guess"),
        lambda: swerling_bound("gaussian", 11, 3.0, "slow"),
    ):
        with pytest.raises(ValueError, match=r"neither|no form|no bound"):
            wrong()


@pytest.mark.parametrize("amplitude", [0.0, 0.7, 2.0, 6.0])
def test_rice_information_is_that_of_the_density(amplitude):
    """Mean square of a numerical derivative of the log density of scipy's non-central chi-squared."""
    step, x = 1e-4, np.linspace(1e-3, amplitude + 9.0, 40001)

    def log_density(a):
        return ncx2.logpdf(x**2, 2, max(a, 1e-9) ** 2) + np.log(2 * x)

    score = (log_density(amplitude + step) - log_density(abs(amplitude - step))) / (2 * step)
    density = np.exp(log_density(amplitude))
    expected = np.sum(density * score**2) * (x[1] - x[0])
    assert rice_information(amplitude) == pytest.approx(expected, abs=2e-4)
    assert rice_information(1000.0) == pytest.approx(1.0, abs=1e-3)


def test_quantising_never_adds_information():
    """Bits allow no better than the amplitudes that they were made of, whatever the threshold."""
    strength = np.array([1.0, 2.0, 4.0, 8.0])
    for fluctuation in ("steady", "fast"):
        whole = unquantised_bound("sinc2", 20, strength, fluctuation) * 10.0
        for threshold in (1.0, 2.0, 3.0):
            bits = quantised_bound("sinc2", 20, threshold, strength, fluctuation)
            assert (bits > whole).all()


def test_many_pulses_are_the_integral():
    for fluctuation in ("steady", "fast"):
        strength = np.array([3.0, 10.0])
        assert swerling_bound("sinc2", 200, strength, fluctuation) == pytest.approx(
            unquantised_bound("sinc2", 200, strength, fluctuation, model="gaussian"), rel=1e-3
        )


def test_posterior_mean_of_normal_data():
    """Flat prior: the mean of the data; normal prior: drawn towards it as far as the variances say."""
    grid = np.linspace(-8.0, 8.0, 4001)
    data = np.array([[1.0, 2.0, 3.0], [0.5, 0.5, -1.0]])
    log_likelihood = -0.5 * ((data[:, :, None] - grid) ** 2).sum(axis=1)
    mean, std = posterior_mean(grid, log_likelihood)
    assert mean == pytest.approx(data.mean(axis=1), abs=1e-6)
    assert std == pytest.approx(np.full(2, 1 / np.sqrt(3.0)), abs=1e-6)
    mean, _ = posterior_mean(grid, log_likelihood, np.exp(-(grid**2)))
    assert mean == pytest.approx(data.sum(axis=1) / 5.0, abs=1e-6)
