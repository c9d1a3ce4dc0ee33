# SPDX-License-Identifier: Apache-2.0
"""Laws of sliding and single sums against enumeration, closed forms and each other."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.stats import binom, chi2, ncx2

from primary_proc.calculators.integration.binary_integration import (
    count_probability,
    detection_by_count,
    one_probability,
    required_snr_db,
    weighted_sum_probability,
)
from primary_proc.calculators.integration.burst_weights import (
    binary_threshold,
    binary_weights,
    level_probabilities,
    level_weights,
    weight_bits,
    whole_weights,
)
from primary_proc.calculators.integration.decision_criteria import likelihood_sum_threshold
from primary_proc.calculators.integration.envelope_sums import envelope_sum_law, square_sum_law
from primary_proc.calculators.integration.integration_loss import (
    integration_loss_db,
    level_sum_snr_db,
    linear_sum_snr_db,
    quantisation_loss_db,
)
from primary_proc.calculators.integration.second_threshold import best_threshold, kuzmin_threshold
from primary_proc.calculators.integration.window_law import start_rate, sum_law
from primary_proc.calculators.pulse.single_pulse import steady_probability, threshold_for


def enumerated_starts(scores, probability, threshold):
    """P(s_(j-1) < L <= s_j) over all words of levels."""
    pulses, levels = scores.shape
    total = 0.0
    for word in itertools.product(range(levels), repeat=pulses + 1):
        before = sum(scores[k][level] for k, level in enumerate(word[:-1]))
        now = sum(scores[k][level] for k, level in enumerate(word[1:]))
        total += np.prod(probability[list(word)]) * (before < threshold <= now)
    return total


@settings(deadline=None, max_examples=30)
@given(data=st.data())
def test_starts_are_those_of_all_words(data):
    rng = np.random.default_rng(data.draw(st.integers(0, 2**32)))
    pulses, levels = data.draw(st.integers(1, 5)), data.draw(st.integers(2, 4))
    steps = np.cumsum(rng.integers(0, 4, (pulses, levels)), axis=1).astype(float)
    scores = steps - steps[:, :1]
    if data.draw(st.booleans()):
        scores[:] = scores[0]
    probability = rng.dirichlet(np.ones(levels))
    rate = start_rate(scores, probability)
    for threshold in (1.0, 2.5, scores.max(axis=1).sum()):
        if threshold > 0.0:
            expected = enumerated_starts(scores, probability, threshold)
            assert rate.at(threshold) == pytest.approx(expected, abs=1e-13)
    assert rate.at(scores.max(axis=1).sum() + 1.0) == pytest.approx(0.0, abs=1e-15)


def test_smoothed_starts_are_the_exact_ones():
    """The same window with scores so fine that it is smoothed, and so coarse that it is not."""
    edges = np.linspace(0.3, 5.0, 24)
    probability = -np.diff(np.concatenate([[1.0], np.exp(-(edges**2) / 2), [0.0]]))
    level = np.arange(25)
    taps = np.array([2, 4, 5, 4, 2])
    exact = start_rate(np.outer(taps, level), probability)
    smooth = start_rate(np.outer(taps, level) + 1e-9, probability)
    assert exact.whole
    assert not smooth.whole
    for threshold in (150.0, 190.0, 230.0, 260.0):
        # The smooth law has the middles of its steps between the whole numbers.
        assert smooth.at(threshold - 0.5) == pytest.approx(exact.at(threshold), rel=0.02)
    wanted = exact.at(200.0)
    assert exact.threshold_for(wanted) == 200.0
    assert smooth.threshold_for(wanted) == pytest.approx(199.5, abs=1.0)


def test_a_rate_out_of_reach_is_said():
    rate = start_rate(np.outer(np.ones(5), [0.0, 1.0]), [0.9, 0.1])
    with pytest.raises(ValueError, match="no threshold of the sum"):
        rate.threshold_for(1e-9)
    with pytest.raises(ValueError, match="it can be"):
        rate.threshold_for(0.5)


def test_the_law_of_a_sum_of_ones_is_binomial():
    law = sum_law(np.outer(np.ones(16), [0, 1]), [0.8, 0.2])
    assert law == pytest.approx(binom.pmf(np.arange(17), 16, 0.2), abs=1e-15)


def test_a_weighted_sum_of_ones_is_that_of_all_words():
    rng = np.random.default_rng(2)
    weights, one = rng.random(8) * 3, rng.random(8)
    words = np.array(list(itertools.product((0, 1), repeat=8)))
    chance = np.where(words, one, 1 - one).prod(axis=1)
    threshold = 5.0
    expected = chance[words @ weights >= threshold].sum()
    # Weights are rounded to a thousandth of the largest, which moves few words across the threshold.
    assert weighted_sum_probability(weights, one, threshold) == pytest.approx(expected, abs=0.01)
    whole = np.rint(weights)
    expected = chance[words @ whole >= threshold].sum()
    assert weighted_sum_probability(whole, one, threshold) == pytest.approx(expected, abs=1e-13)
    with pytest.raises(ValueError, match="neither"):
        weighted_sum_probability(whole, one, threshold, "normal")


def test_counts_and_their_inverse():
    for count, pulses, probability in ((1, 16, 1e-12), (6, 16, 1e-5), (16, 16, 0.5)):
        one = one_probability(count, pulses, probability)
        assert float(count_probability(count, pulses, one)) == pytest.approx(probability, rel=1e-9)


@pytest.mark.parametrize("target", ["steady", "slow", "fast", "slow-dominant", "fast-dominant"])
def test_the_signal_that_is_required_gives_the_detection_wanted(target):
    snr_db = required_snr_db(12, 5, 1e-5, 0.7, target)
    noise = one_probability(5, 12, 1e-5)
    assert detection_by_count(12, 5, noise, snr_db, target) == pytest.approx(0.7, abs=1e-9)


def test_one_pulse_is_one_threshold():
    """A window of one pulse is a single threshold, whose signal is known in closed form."""
    snr_db = required_snr_db(1, 1, 1e-4, 0.6, "fast")
    ratio = np.log(1e-4) / np.log(0.6) - 1.0
    assert snr_db == pytest.approx(10 * np.log10(ratio), abs=1e-9)


def test_the_best_threshold_needs_the_least_signal():
    best = best_threshold(16, 1e-5, 0.9)
    needed = {c: required_snr_db(16, c, 1e-5, 0.9) for c in range(1, 17)}
    assert needed[best] == min(needed.values())
    assert needed[kuzmin_threshold(16)] - needed[best] < 0.2


def test_sums_of_squares_are_chi_squared():
    weights = np.full(9, 1.7)
    law = square_sum_law(weights)
    for probability in (0.5, 1e-3, 1e-7):
        threshold = law.threshold(probability)
        assert threshold == pytest.approx(1.7 * chi2.isf(probability, 18), rel=1e-6)
    amplitude = np.linspace(0.5, 2.0, 9)
    found = square_sum_law(weights, amplitude).exceedance(60.0)
    assert found == pytest.approx(ncx2.sf(60.0 / 1.7, 18, (amplitude**2).sum()), rel=1e-8)
    fast = square_sum_law(weights, 2.0, fast=True).exceedance(60.0)
    assert fast == pytest.approx(chi2.sf(60.0 / 1.7 / 3.0, 18), rel=1e-8)


def test_the_general_law_is_that_of_squares():
    weights = np.array([1.0, 0.7, 0.4])
    amplitude = np.array([2.0, 1.5, 1.0])

    def scores(envelope):
        return np.outer(weights, envelope**2)

    for target, fast in (("steady", False), ("fast", True)):
        law = envelope_sum_law(scores, amplitude, target)
        exact = square_sum_law(weights, amplitude, fast=fast)
        for threshold in (5.0, 12.0, 25.0):
            assert law.exceedance(threshold) == pytest.approx(exact.exceedance(threshold), rel=2e-3)


def test_level_weights_are_the_likelihood_ratio():
    thresholds = np.array([0.5, 1.5, 2.5])
    weights = level_weights(thresholds, np.array([1.0, 3.0]))
    assert weights.shape == (2, 4)
    assert (np.diff(weights, axis=1) > 0).all()
    noise = level_probabilities(thresholds, 0.0)
    assert (np.exp(weights) * noise).sum(axis=1) == pytest.approx([1.0, 1.0])
    # Two levels differ by the weight of a one.
    pair = level_weights([1.5], 2.0)
    one = binary_weights(float(np.exp(-(1.5**2) / 2)), 2.0)
    assert pair[1] - pair[0] == pytest.approx(float(one))


def test_thresholds_of_the_ratio_and_of_the_sum_of_ones_say_the_same():
    """Every word lies on the same side of both."""
    noise, signal = 0.1, np.array([0.3, 0.6, 0.8, 0.5])
    threshold = float(threshold_for(noise))
    amplitude = np.array([1.2, 1.9, 2.6, 1.6])
    signal = steady_probability(threshold, amplitude)
    weights = binary_weights(noise, amplitude)
    limit = binary_threshold(np.log(3.0), noise, signal)
    for word in itertools.product((0, 1), repeat=4):
        bits = np.array(word)
        ratio = np.where(bits, signal / noise, (1 - signal) / (1 - noise)).prod()
        assert (ratio >= 3.0) == (bits @ weights >= limit)
    assert likelihood_sum_threshold(0.5, [1.0, 2.0]) == pytest.approx(3.0)


def test_bits_of_a_weight():
    assert weight_bits(0.1) == 3
    weights = whole_weights([0.2, 1.4, 2.0], 3)
    assert weights.tolist() == [1.0, 5.0, 7.0]
    assert np.abs(weights / 7 - np.array([0.1, 0.7, 1.0])).max() <= 0.1


def test_losses_have_their_order():
    """More levels need less signal; the sum of envelopes less than counting."""
    two, four, many = (
        level_sum_snr_db(8, np.linspace(*span), 1e-4, 0.7)
        for span in ((2.0, 2.0, 1), (0.8, 3.2, 3), (0.4, 4.4, 15))
    )
    assert two > four > many
    assert abs(many - linear_sum_snr_db(8, 1e-4, 0.7)) < 0.1
    assert 0.9 < integration_loss_db(8, kuzmin_threshold(8), 1e-4, 0.7) < 1.6
    assert 0.9 < quantisation_loss_db(8, np.linspace(0.6, 4.2, 10), 1e-4, 0.7) < 1.4
