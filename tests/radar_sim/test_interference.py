# SPDX-License-Identifier: Apache-2.0
"""Jammers follow the antenna pattern and their switch; another radar's pulses come at their own rate."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy import stats

from radar_common.frames import wrap_pi
from radar_sim.interference.jammer import JammerSection
from radar_sim.interference.other_radar import OtherRadarSection
from radar_sim.radar import SPEED_OF_LIGHT, Radar
from radar_sim.reception import Reception
from radar_sim.scenario import Scenario
from radar_sim.simulator import Simulator

IMPROBABLE = 1e-4
RADAR = Radar(
    scan_period=1.0,
    pulse_rate=720.0,
    beamwidth_deg=4.0,
    range_step=100.0,
    cells=100,
    side_lobe_db=-25.0,
)


def noise_of(section, turns=1, radar=RADAR):
    """Noise power over the receiver's, of each pulse."""
    source = section.disturbance(radar, np.random.default_rng(1))
    reception = Reception(0, round(turns * radar.pulses_per_scan), radar.cells)
    source.add_to(reception)
    return np.broadcast_to(reception.noise_power(), (reception.pulses, 1))[:, 0]


def arrivals_of(section, turns=1, radar=RADAR, seed=1):
    source = section.disturbance(radar, np.random.default_rng(seed))
    reception = Reception(0, round(turns * radar.pulses_per_scan), radar.cells)
    source.add_to(reception)
    return reception.signals()[0]


@pytest.mark.parametrize("pattern", ["gaussian", "sinc", "sinc2", "rectangular"])
def test_a_jammer_is_received_by_the_one_way_pattern_and_the_side_lobes(pattern):
    radar = RADAR.changed({"pattern": pattern})
    power = noise_of(JammerSection(azimuth_deg=90.0, jnr_db=40.0), radar=radar) - 1.0
    off_axis = np.degrees(wrap_pi(radar.azimuth(np.arange(720)) - np.pi / 2.0))
    assert power[180] == pytest.approx(1e4, rel=1e-5)
    main_lobe = np.abs(off_axis) < math.degrees(radar.half_width) * radar.beam.extent
    lobes = 1e4 * 10.0**-2.5
    np.testing.assert_allclose(power[~main_lobe], lobes, rtol=1e-4)
    # The two-way amplitude is the one-way power.
    gain = radar.beam(np.radians(off_axis[main_lobe]) / radar.half_width)
    np.testing.assert_allclose(power[main_lobe], np.maximum(1e4 * gain, lobes), rtol=1e-4)
    if pattern != "rectangular":
        at_half_width = np.interp([-2.0, 2.0], off_axis[170:190], power[170:190])
        np.testing.assert_allclose(at_half_width, 5e3, rtol=0.02)


def test_jamming_is_noise_whose_variance_adds():
    jammers = (
        JammerSection(azimuth_deg=0.0, jnr_db=20.0),
        JammerSection(azimuth_deg=180.0, jnr_db=30.0),
    )
    scenario = Scenario(RADAR, disturbances=jammers)
    video = np.stack(
        [sector.sweeps.rows["video"] for sector in Simulator(scenario, sectors=1, scans=20, seed=2)]
    )
    lobes = 10.0**-2.5
    for pulse, sigma2 in (
        (0, 1.0 + 100.0 + 1000.0 * lobes),
        (360, 1.0 + 1000.0 + 100.0 * lobes),
        (180, 1.0 + 1100.0 * lobes),
    ):
        samples = video[:, pulse].ravel() / RADAR.noise_level
        law = stats.rayleigh(scale=math.sqrt(sigma2))
        assert stats.kstest(samples, law.cdf).pvalue > IMPROBABLE
    power = np.square(video[:, 0].astype(float))
    along = np.corrcoef(power[:, 1:].ravel(), power[:, :-1].ravel())[0, 1]
    assert abs(along) < 4.0 / math.sqrt(power.size)


def test_a_jammer_is_switched_on_and_off_and_blinks():
    section = JammerSection(jnr_db=20.0, begins=1.5, ends=9.5, on_time=1.0, off_time=2.0)
    on = noise_of(section, turns=12) > 1.0 + 1e-4
    time = np.arange(12 * 720) / 720.0
    expected = (time >= 1.5) & (time < 9.5) & ((time - 1.5) % 3.0 < 1.0)
    # At the switch itself a rounding may decide.
    assert np.count_nonzero(on != expected) <= 3
    assert on.sum() == pytest.approx(3 * 720, abs=3)


def test_pulses_of_another_radar_come_at_its_rate():
    section = OtherRadarSection(
        azimuth_deg=40.0, snr_db=40.0, pulse_rate=5000.0, pulse_length=2.0 * 100.0 / SPEED_OF_LIGHT
    )
    echoes = arrivals_of(section, turns=3)
    time = echoes.pulse / 720.0 + 2.0 * (echoes.cell + 0.5) * 100.0 / SPEED_OF_LIGHT
    # Each pulse fills parts of two neighbouring cells; their amplitudes tell where it began.
    late = (time * 5000.0) % 1.0
    assert (
        np.ptp(np.angle(np.exp(2j * np.pi * late)))
        < 2.0 * np.pi * 5000.0 * 4.0 * 100.0 / SPEED_OF_LIGHT
    )
    heard = np.unique(np.rint(time * 5000.0))
    # The video covers 66.7 of the 1389 microseconds between two pulses of this radar.
    share = 2.0 * 100 * 100.0 / SPEED_OF_LIGHT * 720.0
    assert len(heard) == pytest.approx(3 * 5000 * share, abs=4.0 * math.sqrt(3 * 5000 * share))


def test_its_pulses_are_as_long_as_they_are_and_spare_the_next_pulse():
    length = 5.5 * 2.0 * 100.0 / SPEED_OF_LIGHT
    section = OtherRadarSection(snr_db=60.0, pulse_rate=700.0, pulse_length=length, stagger=1.0)
    echoes = arrivals_of(section, turns=20)
    field = np.zeros((20 * 720, 100))
    np.add.at(field, (echoes.pulse, echoes.cell), np.abs(echoes.amplitude))
    gain = np.sqrt(RADAR.one_way_gain(RADAR.azimuth(np.arange(20 * 720)), 0.0))
    cells = field.sum(axis=1) / (gain * math.sqrt(2.0) * 1e3)
    whole = (cells > 0.0) & (field[:, 0] == 0.0) & (field[:, -1] == 0.0)
    assert whole.sum() > 200
    single = whole & (cells < 6.0)
    assert single.sum() > 0.9 * whole.sum()
    # The matched filter keeps the area of a pulse.
    np.testing.assert_allclose(cells[single], 5.5, rtol=1e-9)
    # From one pulse of this radar to the next the place is another.
    place = np.argmax(field > 0.0, axis=1)
    running = single[1:] & single[:-1]
    assert np.mean(np.abs(np.diff(place)[running]) > 2) > 0.8


def test_it_is_strongest_in_its_direction():
    section = OtherRadarSection(
        azimuth_deg=250.0, snr_db=50.0, pulse_rate=20_000.0, pulse_length=2e-6
    )
    echoes = arrivals_of(section, turns=5)
    azimuth = np.degrees(RADAR.azimuth(echoes.pulse))
    # Cells that a pulse fills hold its amplitude.
    strongest = {
        name: np.abs(echoes.amplitude[chosen]).max() ** 2 / 2.0
        for name, chosen in (
            ("towards", np.abs(azimuth - 250.0) < 0.3),
            ("half", np.abs(np.abs(azimuth - 250.0) - 2.0) < 0.1),
            ("away", np.abs(azimuth - 250.0) > 30.0),
        )
    }
    assert strongest["towards"] == pytest.approx(1e5, rel=0.02)
    assert strongest["half"] == pytest.approx(0.5e5, rel=0.05)
    assert strongest["away"] == pytest.approx(1e5 * 10.0**-2.5, rel=1e-6)


def test_pulses_far_below_the_noise_are_left_out():
    section = OtherRadarSection(snr_db=-10.0, pulse_rate=20_000.0, azimuth_deg=250.0)
    azimuth = np.degrees(RADAR.azimuth(arrivals_of(section).pulse))
    assert len(azimuth)
    assert np.abs(azimuth - 250.0).max() < 10.0
