# SPDX-License-Identifier: Apache-2.0
"""The power of an echo follows Swerling's laws, from burst to burst or from pulse to pulse."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy import stats

from radar_sim.fluctuation import FLUCTUATIONS, fluctuate

IMPROBABLE = 1e-4
BURSTS = 4000
# Degrees of freedom of the power, and whether pulses of a burst differ.
SWERLING = {
    "slow": (2, False),
    "fast": (2, True),
    "slow-dominant": (4, False),
    "fast-dominant": (4, True),
}


def factors_of(name, pulses=6):
    return fluctuate(np.full(BURSTS, name), pulses, np.random.default_rng(4))


@pytest.mark.parametrize("name", SWERLING)
def test_the_power_is_chi_squared(name):
    degrees, _ = SWERLING[name]
    power = np.square(np.abs(factors_of(name)))
    law = stats.chi2(degrees, scale=1.0 / degrees)
    for pulse in (0, 3):
        assert stats.kstest(power[:, pulse], law.cdf).pvalue > IMPROBABLE


@pytest.mark.parametrize("name", FLUCTUATIONS)
def test_phases_are_even_and_the_mean_power_is_one(name):
    factors = factors_of(name)
    phase = np.angle(factors[:, 0]) / (2.0 * np.pi) % 1.0
    assert stats.kstest(phase, stats.uniform.cdf).pvalue > IMPROBABLE
    # No model's power spreads wider than its mean.
    assert np.square(np.abs(factors[:, 0])).mean() == pytest.approx(
        1.0, abs=4.0 / math.sqrt(BURSTS)
    )


@pytest.mark.parametrize("name", SWERLING)
def test_pulses_of_a_burst_are_alike_or_independent(name):
    _, fast = SWERLING[name]
    factors = factors_of(name)
    if fast:
        power = np.square(np.abs(factors))
        assert abs(np.corrcoef(power[:, 0], power[:, 1])[0, 1]) < 4.0 / math.sqrt(BURSTS)
    else:
        np.testing.assert_array_equal(factors, np.repeat(factors[:, :1], 6, axis=1))
