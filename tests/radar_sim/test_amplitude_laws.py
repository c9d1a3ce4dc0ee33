# SPDX-License-Identifier: Apache-2.0
"""Speckle times texture has exactly the amplitude law that was asked for."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.special import gamma, kv

from radar_sim.clutter.amplitude_laws import texture_quantile

NORMAL = np.linspace(-9.0, 9.0, 40_001)
WEIGHT = np.exp(-np.square(NORMAL) / 2.0)
WEIGHT /= WEIGHT.sum()
SURVIVAL = np.array([0.9, 0.5, 0.1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6])


def exceedance(law, shape, power):
    """Probability that an exponential power times the texture exceeds a power, by integration over the texture."""
    texture = texture_quantile(law, shape, NORMAL)
    with np.errstate(divide="ignore"):
        return np.array([np.exp(-level / texture) @ WEIGHT for level in power])


@pytest.mark.parametrize("law", ["rayleigh", "k", "weibull"])
@pytest.mark.parametrize("shape", [0.3, 0.5, 1.0, 1.5, 1.9, 2.0])
def test_texture_has_mean_one_and_grows_with_its_quantile(law, shape):
    texture = texture_quantile(law, shape, NORMAL)
    assert texture @ WEIGHT == pytest.approx(1.0, abs=2e-3)
    assert np.all(np.diff(texture) >= 0.0)


@pytest.mark.parametrize("shape", [0.3, 0.6, 1.0, 1.4, 1.8, 1.95, 1.99, 2.0])
def test_the_weibull_envelope_is_weibull(shape):
    power = (-np.log(SURVIVAL)) ** (2.0 / shape) / gamma(1.0 + 2.0 / shape)
    np.testing.assert_allclose(exceedance("weibull", shape, power), SURVIVAL, rtol=2e-3)


@pytest.mark.parametrize("shape", [0.1, 0.5, 1.0, 3.0, 20.0])
def test_the_k_envelope_is_k(shape):
    # P(power > w) = 2 (v w)^(v/2) K_v(2 sqrt(v w)) / Gamma(v) at mean power one.
    power = np.geomspace(1e-3, 15.0, 12)
    argument = 2.0 * np.sqrt(shape * power)
    law = 2.0 / gamma(shape) * (argument / 2.0) ** shape * kv(shape, argument)
    np.testing.assert_allclose(exceedance("k", shape, power), law, rtol=1e-3)


def test_both_laws_end_in_rayleigh():
    power = -np.log(SURVIVAL)
    np.testing.assert_allclose(exceedance("weibull", 2.0, power), SURVIVAL, rtol=1e-9)
    # The second moment of the texture is 1 + 1/v: the first correction is (x²/2 - x) / v.
    correction = 1.0 + (np.square(power) / 2.0 - power) / 1e3
    np.testing.assert_allclose(exceedance("k", 1000.0, power), SURVIVAL * correction, rtol=5e-3)


def test_a_spikier_shape_has_the_longer_tail():
    far = np.array([8.0])
    tails = [float(exceedance("weibull", shape, far)[0]) for shape in (0.6, 1.0, 1.4, 2.0)]
    assert tails == sorted(tails, reverse=True)
    assert tails[-1] == pytest.approx(math.exp(-8.0), rel=1e-6)
