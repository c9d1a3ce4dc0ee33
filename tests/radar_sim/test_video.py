# SPDX-License-Identifier: Apache-2.0
"""The video follows the laws of noise, of signal in noise, and of the digitiser."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import stats

from radar_sim.motion import Path
from radar_sim.radar import Radar
from radar_sim.scenario import Scenario
from radar_sim.simulator import Simulator
from radar_sim.targets import Target

# A fair test would fail once in ten thousand seeds; the seeds are fixed.
IMPROBABLE = 1e-4
NOISE_LEVEL = 0.037

# One burst of 16 pulses a turn, in a rectangular beam that points south at its centre.
RADAR = Radar(
    scan_period=1.0,
    pulse_rate=192.0,
    beamwidth_deg=30.0,
    pattern="rectangular",
    range_step=100.0,
    cells=8,
    noise_level=NOISE_LEVEL,
    reference_range=450.0,
)
CELL = 4
IN_BEAM = slice(89, 104)


def target(fluctuation, snr_db):
    return Target(Path(0.0, -450.0, 0.0, 0.0), snr_db, fluctuation)


def video(targets, scans=400, radar=RADAR, seed=5, sample="float32"):
    simulator = Simulator(
        Scenario(radar, tuple(targets)), seed=seed, sectors=1, scans=scans, sample=sample
    )
    return np.stack([sector.sweeps.rows["video"] for sector in simulator])


def bursts(fluctuation, snr_db, **settings):
    """Normalised envelope of the target's cell, shape (bursts, pulses)."""
    return video([target(fluctuation, snr_db)], **settings)[:, IN_BEAM, CELL] / NOISE_LEVEL


def power_of(fluctuation, snr_db, **settings):
    return np.square(bursts(fluctuation, snr_db, **settings)) / 2.0


def test_noise_is_rayleigh_with_the_level_given():
    samples = video([], scans=100).ravel()
    assert stats.kstest(samples, stats.rayleigh(scale=NOISE_LEVEL).cdf).pvalue > IMPROBABLE
    # The power of an envelope is exponential: the mean of n deviates by 1 / sqrt(n) of itself.
    level = np.sqrt(np.mean(np.square(samples, dtype=float)) / 2.0)
    assert level == pytest.approx(NOISE_LEVEL, rel=4.0 / 2.0 / np.sqrt(samples.size))


@pytest.mark.parametrize("shift", [(0, 1), (1, 0), (1, 1)], ids=["range", "azimuth", "both"])
def test_noise_is_independent_from_cell_to_cell_and_pulse_to_pulse(shift):
    power = np.square(video([], scans=200).reshape(-1, RADAR.cells).astype(float))
    pulses, cells = shift
    one = power[pulses:, cells:].ravel()
    other = power[: len(power) - pulses, : RADAR.cells - cells].ravel()
    assert abs(np.corrcoef(one, other)[0, 1]) < 4.0 / np.sqrt(one.size)


def test_gain_acts_on_noise_and_signal_alike():
    flat = video([target("none", 20.0)], scans=50)
    radar = RADAR.changed({"gain_swing_db": 6.0, "gain_swing_length": 800.0})
    swinging = video([target("none", 20.0)], scans=50, radar=radar)
    np.testing.assert_allclose(swinging, flat * radar.gain(), rtol=1e-5)
    assert radar.gain().max() / radar.gain().min() > 3.0


def test_a_steady_target_makes_a_rice_envelope():
    # x² is non-central chi-square with two degrees of freedom and non-centrality a² = 2 snr (1.34).
    snr_db = 6.0
    x = bursts("none", snr_db).ravel()
    law = stats.ncx2(2, 2.0 * 10.0 ** (snr_db / 10.0))
    assert stats.kstest(np.square(x), law.cdf).pvalue > IMPROBABLE


def test_a_fast_target_makes_a_wider_rayleigh_envelope_of_independent_pulses():
    # Rayleigh with parameter sqrt(1 + k²), k² = snr (1.39).
    x = bursts("fast", 6.0)
    law = stats.rayleigh(scale=np.sqrt(1.0 + 10.0**0.6))
    assert stats.kstest(x.ravel(), law.cdf).pvalue > IMPROBABLE
    power = np.square(x)
    within = np.corrcoef(power[:, 0], power[:, 1])[0, 1]
    assert abs(within) < 4.0 / np.sqrt(len(power))


def test_a_slow_target_keeps_one_exponential_power_through_a_burst():
    # At 40 dB the noise is nothing beside the signal: its power is the draw of the burst itself.
    power = power_of("slow", 40.0) / 1e4
    assert stats.kstest(power.mean(axis=1), stats.expon.cdf).pvalue > IMPROBABLE
    strong = power.mean(axis=1) > 0.1
    # What is left within a burst is noise: relative rms of the power 2 / a = sqrt(2 / (1e4 power)).
    spread = power[strong].std(axis=1) / power[strong].mean(axis=1)
    assert spread.max() < 4.0 * np.sqrt(2.0 / 1e3)
    successive = np.corrcoef(power[:-1, 0], power[1:, 0])[0, 1]
    assert abs(successive) < 4.0 / np.sqrt(len(power))


@pytest.mark.parametrize("fluctuation", ["none", "slow", "fast"])
@pytest.mark.parametrize("snr_db", [-3.0, 3.0, 13.0])
def test_all_models_have_the_mean_power_of_their_ratio(fluctuation, snr_db):
    power = power_of(fluctuation, snr_db).mean(axis=1)
    expected = 1.0 + 10.0 ** (snr_db / 10.0)
    deviation = power.std() / np.sqrt(len(power))
    assert power.mean() == pytest.approx(expected, abs=4.0 * deviation)


def test_targets_in_one_cell_add_as_complex_amplitudes():
    # Two equal steady targets of random phase: powers add in the mean, and the sum beats between 0 and 4.
    pair = [target("none", 30.0), target("none", 30.0)]
    power = np.square(video(pair)[:, IN_BEAM, CELL] / NOISE_LEVEL).mean(axis=1) / 2.0 / 1e3
    # 2 + 2 cos(phase) has the standard deviation sqrt 2.
    assert power.mean() == pytest.approx(2.0, abs=4.0 * np.sqrt(2.0 / len(power)))
    assert power.std() == pytest.approx(np.sqrt(2.0), rel=0.1)
    assert power.min() < 0.1
    assert power.max() > 3.9


def test_cells_without_a_target_hold_only_noise():
    pieces = video([target("none", 40.0)])
    others = np.delete(pieces, CELL, axis=2).astype(float)
    level = np.sqrt(np.mean(np.square(others)) / 2.0)
    assert level == pytest.approx(NOISE_LEVEL, rel=4.0 / 2.0 / np.sqrt(others.size))


@pytest.mark.parametrize(("sample", "largest"), [("uint8", 255), ("uint16", 65535)])
def test_integer_video_is_the_rounded_float_video_and_saturates(sample, largest):
    targets = [target("slow", 36.0)]
    analogue, digital = (video(targets, scans=100, sample=s) for s in ("float32", sample))
    assert digital.dtype == sample
    codes = analogue / (NOISE_LEVEL * RADAR.full_scale) * largest
    error = digital - np.minimum(codes, largest)
    assert np.abs(error).max() <= 0.5 + 1e-6 * largest
    assert digital.max() == largest
    assert codes.max() > largest
