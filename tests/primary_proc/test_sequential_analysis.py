# SPDX-License-Identifier: Apache-2.0
"""Wald's bounds, and the integral equations of his test against simulation."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.special import i0e

from primary_proc.calculators.integration.sequential_analysis import (
    operating_characteristic,
    sequential_quality,
    wald_bounds,
)

RUNS = 8000
AMPLITUDE = 1.5


def simulate(target, bounds, rng):
    """Decisions for the target and numbers of samples of tests on Rician envelopes."""
    lower, upper = np.log(bounds)
    ratio, length = np.zeros(RUNS), np.zeros(RUNS, int)
    for _ in range(500):
        running = np.flatnonzero((ratio > lower) & (ratio < upper))
        if not len(running):
            break
        field = rng.standard_normal((2, len(running)))
        x = np.hypot(field[0] + target, field[1])
        ratio[running] += np.log(i0e(AMPLITUDE * x)) + AMPLITUDE * x - AMPLITUDE**2 / 2.0
        length[running] += 1
    return ratio >= upper, length


def test_bounds():
    lower, upper = wald_bounds(1e-3, 0.1)
    assert (lower, upper) == (pytest.approx(0.1001, abs=5e-5), pytest.approx(900.0))


@pytest.mark.parametrize("false_alarm", [1e-2, 0.1])
def test_quality_is_that_of_simulated_tests(false_alarm):
    rng = np.random.default_rng(8)
    bounds = wald_bounds(false_alarm, 0.1)
    quality = sequential_quality(AMPLITUDE, false_alarm, 0.1)
    for target, detected, length in (
        (0.0, quality.false_alarm, quality.noise_length),
        (AMPLITUDE, 1.0 - quality.miss, quality.target_length),
    ):
        found, lengths = simulate(target, bounds, rng)
        sampling = 3.3 * np.sqrt(detected * (1.0 - detected) / RUNS)
        assert found.mean() == pytest.approx(detected, abs=sampling)
        assert lengths.mean() == pytest.approx(length, abs=3.3 * lengths.std() / np.sqrt(RUNS))


def test_true_errors_are_below_the_wanted_ones():
    """They add up to no more than those asked for (Wald 1947, 3.29)."""
    for amplitude in (0.5, 1.5, 3.0):
        quality = sequential_quality(amplitude, 1e-2, 0.1)
        assert quality.false_alarm + quality.miss <= 0.11
        assert quality.false_alarm < 1e-2 / 0.9


def test_stronger_targets_are_decided_sooner():
    lengths = [sequential_quality(a, 1e-3, 0.1).target_length for a in (1.0, 1.5, 2.0, 3.0)]
    assert (np.diff(lengths) < 0.0).all()


def test_a_target_between_noise_and_the_tests_own_takes_longest():
    decided, length = operating_characteristic(2.0, [0.0, 0.7, 1.2, 2.0, 3.0], 1e-3, 0.1)
    assert (np.diff(decided) > 0.0).all()
    assert length.argmax() == 2


@pytest.mark.parametrize("errors", [(0.0, 0.1), (0.1, 0.0), (0.6, 0.5), (-0.1, 0.2)])
def test_impossible_errors_are_refused(errors):
    with pytest.raises(ValueError, match="error probabilities"):
        wald_bounds(*errors)
