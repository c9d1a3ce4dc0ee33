# SPDX-License-Identifier: Apache-2.0
"""Speckle: normal quadratures with the correlation asked for, the same however pulses are cut."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import stats

from radar_sim.clutter.coherence import coherence, motion_coherence, scanning_coherence
from radar_sim.clutter.speckle import ExponentialSpeckle, GaussianSpeckle
from radar_sim.radar import Radar
from radar_sim.random_phase import ComplexNoise, random_cosines

IMPROBABLE = 1e-4
SPECKLES = {"gaussian": GaussianSpeckle, "exponential": ExponentialSpeckle}
LAWS = {
    "gaussian": lambda lag, coherence: np.exp(-np.square(lag / coherence)),
    "exponential": lambda lag, coherence: np.exp(-lag / coherence),
}


def draw(kind, coherence, pulses, cells, seed=1):
    speckle = SPECKLES[kind](coherence, np.random.default_rng(seed))
    return speckle.signal(0, pulses, cells)


@pytest.mark.parametrize("kind", SPECKLES)
@pytest.mark.parametrize("coherence", [0.4, 1.0, 2.7, 6.0, 14.3, 40.0])
def test_correlation_follows_its_law(kind, coherence):
    cells, pulses = 4000, 160
    signal = draw(kind, coherence, pulses, cells)
    lags = np.unique(np.rint(np.array([0.5, 1.0, 2.0]) * coherence).astype(int))
    for lag in lags[lags > 0]:
        # Cells are independent: a mean over them, and over pairs of pulses far from each other.
        starts = range(0, pulses - lag, max(1, round(3 * coherence)))
        products = np.stack([signal[s + lag] * signal[s].conj() for s in starts]) / 2.0
        size = products.size
        measured = products.mean()
        bound = 4.0 / math.sqrt(size)
        assert measured.real == pytest.approx(LAWS[kind](lag, coherence), abs=bound + 0.01)
        assert abs(measured.imag) < bound


@pytest.mark.parametrize("kind", SPECKLES)
@pytest.mark.parametrize("coherence", [0.4, 3.0, 14.3])
def test_both_quadratures_of_every_pulse_are_standard_normal(kind, coherence):
    signal = draw(kind, coherence, 40, 3000)
    for pulse in (0, 1, 2, 3, 17, 39):
        for quadrature in (signal[pulse].real, signal[pulse].imag):
            assert stats.kstest(quadrature, stats.norm.cdf).pvalue > IMPROBABLE
    across = np.mean(signal[:, 1:] * signal[:, :-1].conj(), axis=1) / 2.0
    assert np.abs(across).max() < 5.0 / math.sqrt(3000)


@settings(max_examples=30, deadline=None)
@given(
    kind=st.sampled_from(sorted(SPECKLES)),
    coherence=st.floats(0.3, 30.0),
    parts=st.lists(st.integers(1, 40), min_size=1, max_size=8),
    cells=st.integers(1, 7),
)
def test_cutting_changes_no_bit(kind, coherence, parts, cells):
    whole = draw(kind, coherence, sum(parts), cells)
    speckle = SPECKLES[kind](coherence, np.random.default_rng(1))
    starts = np.cumsum([0, *parts[:-1]])
    pieces = [speckle.signal(int(s), n, cells) for s, n in zip(starts, parts, strict=True)]
    assert np.concatenate(pieces).tobytes() == whole.tobytes()


@pytest.mark.parametrize("kind", SPECKLES)
def test_after_a_gap_it_begins_anew(kind):
    speckle = SPECKLES[kind](50.0, np.random.default_rng(1))
    before = speckle.signal(0, 5, 4000)[-1]
    after = speckle.signal(6, 1, 4000)[0]
    assert abs(np.mean(after * before.conj()) / 2.0) < 4.0 / math.sqrt(4000)


def test_complex_noise_is_normal_and_its_phases_are_even():
    noise = ComplexNoise(np.random.default_rng(2)).draw(40, 5001)
    assert noise.shape == (40, 5001)
    assert stats.kstest(noise.real.ravel(), stats.norm.cdf).pvalue > IMPROBABLE
    assert stats.kstest(noise.imag.ravel(), stats.norm.cdf).pvalue > IMPROBABLE
    assert abs(np.mean(noise.real * noise.imag)) < 4.0 / math.sqrt(noise.size)
    cosines = random_cosines(40, 5001, np.random.default_rng(3))
    assert abs(cosines.mean()) < 4.0 * math.sqrt(0.5 / cosines.size)
    assert np.square(cosines).mean() == pytest.approx(
        0.5, abs=4.0 * math.sqrt(0.125 / cosines.size)
    )


def test_the_turning_beam_and_the_motion_limit_coherence():
    radar = Radar(pulse_rate=1000.0, wavelength=0.1, beamwidth_deg=1.4)
    # A Gaussian pattern g: g with g moved by d is exp(-d²/2), in half widths of N0 / 2 pulses each.
    expected = math.sqrt(2.0) * radar.pulses_in_beam / 2.0
    assert scanning_coherence(radar) == pytest.approx(expected, rel=1e-2)
    # exp(-2 (2 pi s t / wavelength)²) = 1/e
    seconds = 0.1 / (2.0 * math.pi * math.sqrt(2.0) * 0.5)
    assert motion_coherence(radar, 0.5) == pytest.approx(1000.0 * seconds)
    assert coherence(radar, 0.0) == pytest.approx(scanning_coherence(radar))
    both = 1.0 / scanning_coherence(radar) ** 2 + 1.0 / motion_coherence(radar, 0.5) ** 2
    assert coherence(radar, 0.5) == pytest.approx(both**-0.5)
