# SPDX-License-Identifier: Apache-2.0
"""Required signal-to-noise ratios of integrated pulses: against closed forms, simulation and the approximations."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.special import gammainc, gammaincc
from scipy.stats import binom, ncx2

from primary_proc.calculators.integration.integrated_pulses import (
    integrated_detection_probability,
    integrated_snr_db,
    integration_threshold,
)
from primary_proc.calculators.integration.snr_approximations import (
    albersheim_snr_db,
    shnidman_snr_db,
)
from primary_proc.calculators.pulse.target_models import TARGETS

CONFIDENCE = 0.999
SNR_DB = np.array([-10.0, -3.0, 0.0, 4.0, 9.0, 15.0])


def closed_form(target, snr, threshold, pulses):
    """Of each case by itself, as textbooks have it."""
    if target == "steady":
        return ncx2.sf(2.0 * threshold, 2 * pulses, 2.0 * pulses * snr)
    if target == "fast":
        return gammaincc(pulses, threshold / (1.0 + snr))
    if target == "slow":
        energy = pulses * snr
        if pulses == 1:
            return np.exp(-threshold / (1.0 + snr))
        beyond = (1.0 + 1.0 / energy) ** (pulses - 1) * np.exp(-threshold / (1.0 + energy))
        kept = gammainc(pulses - 1, threshold / (1.0 + 1.0 / energy))
        return gammaincc(pulses - 1, threshold) + beyond * kept
    raise AssertionError(target)


@pytest.mark.parametrize("false_alarm", [1e-8, 1e-4, 0.1])
@pytest.mark.parametrize("pulses", [1, 2, 10, 100])
@pytest.mark.parametrize("target", ["steady", "slow", "fast"])
def test_the_sum_equals_the_closed_form(target, pulses, false_alarm):
    found = integrated_detection_probability(SNR_DB, false_alarm, pulses, target)
    threshold = integration_threshold(false_alarm, pulses)
    expected = closed_form(target, 10.0 ** (SNR_DB / 10.0), threshold, pulses)
    assert found == pytest.approx(expected, abs=1e-10)


@pytest.mark.parametrize("target", TARGETS)
def test_detection_equals_a_simulation(target):
    trials, pulses, snr, false_alarm = 40_000, 6, 2.0, 1e-3
    rng = np.random.default_rng(5)
    power = {
        "steady": lambda: np.ones((trials, 1)),
        "slow": lambda: rng.exponential(1.0, (trials, 1)),
        "fast": lambda: rng.exponential(1.0, (trials, pulses)),
        "slow-dominant": lambda: rng.gamma(2.0, 0.5, (trials, 1)),
        "fast-dominant": lambda: rng.gamma(2.0, 0.5, (trials, pulses)),
    }[target]()
    field = rng.standard_normal((2, trials, pulses)) / np.sqrt(2.0)
    field[0] += np.sqrt(snr * power)
    total = np.square(field).sum(axis=(0, 2))
    found = int((total > integration_threshold(false_alarm, pulses)).sum())
    snr_db = 10.0 * np.log10(snr)
    expected = float(integrated_detection_probability(snr_db, false_alarm, pulses, target))
    low, high = binom.interval(CONFIDENCE, trials, expected)
    assert low <= found <= high


@settings(deadline=None, max_examples=60)
@given(
    log_false_alarm=st.floats(np.log(1e-9), np.log(1e-2)),
    detection=st.floats(0.05, 0.99),
    pulses=st.integers(1, 60),
    target=st.sampled_from(list(TARGETS)),
)
def test_the_required_ratio_gives_the_detection_probability(
    log_false_alarm, detection, pulses, target
):
    false_alarm = float(np.exp(log_false_alarm))
    snr_db = integrated_snr_db(false_alarm, detection, pulses, target)
    found = integrated_detection_probability(snr_db, false_alarm, pulses, target)
    assert found == pytest.approx(detection, abs=1e-9)


def test_without_a_target_noise_alone_is_detected():
    for target in TARGETS:
        found = integrated_detection_probability(-150.0, 1e-3, 7, target)
        assert found == pytest.approx(1e-3, rel=1e-9)


@settings(deadline=None, max_examples=60)
@given(
    log_false_alarm=st.floats(np.log(1e-7), np.log(1e-3)),
    detection=st.floats(0.3, 0.9),
    pulses=st.integers(1, 100),
    target=st.sampled_from(list(TARGETS)),
)
def test_the_approximations_are_as_near_as_the_documentation_says(
    log_false_alarm, detection, pulses, target
):
    point = float(np.exp(log_false_alarm)), detection, pulses
    exact = integrated_snr_db(*point, target)
    assert shnidman_snr_db(*point, target) == pytest.approx(exact, abs=0.8)
    if target == "steady":
        assert shnidman_snr_db(*point, target) == pytest.approx(exact, abs=0.25)
        assert albersheim_snr_db(*point) == pytest.approx(exact, abs=0.35)


@pytest.mark.parametrize("point", [(0.0, 0.5, 1), (0.6, 0.5, 1), (1e-6, 1.0, 1), (1e-6, 0.5, 0)])
def test_what_makes_no_sense_is_refused(point):
    with pytest.raises(ValueError, match=r"no |needs"):
        integrated_snr_db(*point, "slow")
    with pytest.raises(ValueError, match="no "):
        albersheim_snr_db(*point)
    with pytest.raises(ValueError, match="no "):
        shnidman_snr_db(*point, "slow")


def test_an_approximation_without_a_value_says_so():
    with pytest.raises(ValueError, match="formula"):
        albersheim_snr_db(0.4, 0.01, 1)
    with pytest.raises(ValueError, match="formula"):
        shnidman_snr_db(0.4, 0.3, 1, "slow")
