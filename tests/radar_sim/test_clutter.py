# SPDX-License-Identifier: Apache-2.0
"""Land, sea, rain and points: their laws, where they are, how long they stay, and that they add up."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy import stats
from scipy.special import gamma, gammainc, kv

from radar_common.frames import wrap_pi
from radar_sim.clutter.area import Area
from radar_sim.clutter.coherence import coherence
from radar_sim.clutter.patch import PatchSection
from radar_sim.clutter.points import PointsSection
from radar_sim.clutter.rain import RainSection
from radar_sim.radar import Radar
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
    wavelength=0.1,
)
# One independent texture in every cell and in every beam: knots of a cell, of pulses far from each other.
FINE = {"grain_range": 100.0, "grain_azimuth_deg": 1.0, "range_exponent": 0.0}
WHOLE = {"range_from": 0.0, "range_to": 10_000.0, **FINE}


def received(section, pulses, radar=RADAR, seed=3, first=0):
    """Signal and added noise of one source alone, shape (pulses, cells)."""
    source = section.disturbance(radar, np.random.default_rng(seed))
    reception = Reception(first, pulses, radar.cells)
    source.add_to(reception)
    echoes, field = reception.signals()
    if field is None:
        field = np.zeros((pulses, radar.cells), complex)
        np.add.at(field, (echoes.pulse - first, echoes.cell), echoes.amplitude)
    noise = reception.noise_power()
    return field, 0.0 if noise is None else noise - 1.0


def power_of(section, pulses, **settings):
    field, noise = received(section, pulses, **settings)
    return np.square(np.abs(field)) / 2.0 + noise


def weibull(shape):
    scale = gamma(1.0 + 2.0 / shape)
    return lambda power: -np.expm1(-((power * scale) ** (shape / 2.0)))


def k_law(shape):
    def cdf(power):
        argument = 2.0 * np.sqrt(shape * np.maximum(power, 1e-12))
        return 1.0 - 2.0 / gamma(shape) * (argument / 2.0) ** shape * kv(shape, argument)

    return cdf


@pytest.mark.parametrize("spectrum", ["gaussian", "exponential"])
@pytest.mark.parametrize(
    ("law", "shape", "cdf"),
    [
        ("weibull", 0.7, weibull(0.7)),
        ("weibull", 1.3, weibull(1.3)),
        ("k", 0.5, k_law(0.5)),
        ("k", 3.0, k_law(3.0)),
        ("rayleigh", 1.0, stats.expon.cdf),
    ],
)
def test_the_amplitude_law_is_the_one_asked_for(spectrum, law, shape, cdf):
    section = PatchSection(law=law, shape=shape, cnr_db=10.0, spectrum=spectrum, **WHOLE)
    # Pulses three degrees apart share no knot of the texture and, at this speed, no speckle; nor do cells.
    power = power_of(section.changed({"speed_spread": 20.0}), 720)[::6] / 10.0
    assert stats.kstest(power[:, ::2].ravel(), cdf).pvalue > IMPROBABLE
    assert stats.kstest(power[:, 1::2].ravel(), cdf).pvalue > IMPROBABLE


@pytest.mark.parametrize("spectrum", ["gaussian", "exponential", "white"])
@pytest.mark.parametrize("law", ["weibull", "k", "rayleigh"])
def test_mean_power_is_the_ratio_and_falls_with_range(spectrum, law):
    section = PatchSection(
        law=law, shape=1.5, cnr_db=12.0, spectrum=spectrum, **WHOLE | {"range_exponent": 2.0}
    )
    power = power_of(section, 2 * 720)
    expected = 10.0**1.2 * ((np.arange(100) + 0.5) / 50.0) ** -2.0
    ratio = (power / expected)[:, 5:].mean(axis=1).reshape(-1, 36).mean(axis=1)
    deviation = ratio.std() / math.sqrt(len(ratio))
    assert ratio.mean() == pytest.approx(1.0, abs=4.0 * deviation + 1e-6)
    assert deviation < 0.03


@pytest.mark.parametrize("spectrum", ["gaussian", "exponential"])
@pytest.mark.parametrize("speed_spread", [0.0, 0.5, 2.0])
def test_pulse_to_pulse_correlation_is_that_of_beam_and_motion(spectrum, speed_spread):
    section = PatchSection(law="rayleigh", spectrum=spectrum, speed_spread=speed_spread, **WHOLE)
    field, _ = received(section, 10 * 720)
    pulses = coherence(RADAR, speed_spread)
    for lag in (1, 3, 8):
        ratio = lag / pulses
        expected = math.exp(-(ratio**2) if spectrum == "gaussian" else -ratio)
        products = (field[lag:] * field[:-lag].conj()).mean(axis=1)
        measured = products.mean().real / np.mean(np.square(np.abs(field)))
        # Pulses a few coherence times apart count as independent samples.
        samples = field.size / (3.0 * max(pulses, 1.0))
        assert measured == pytest.approx(expected, abs=0.012 + 4.0 / math.sqrt(samples))


def test_white_clutter_is_noise_whose_variance_adds_to_the_receivers():
    patch = PatchSection(law="rayleigh", spectrum="white", cnr_db=3.0, **WHOLE)
    other = patch.changed({"cnr_db": 6.0})
    scenario = Scenario(RADAR, disturbances=(patch, other))
    video = next(Simulator(scenario, sectors=1)).sweeps.rows["video"] / RADAR.noise_level
    sigma2 = 1.0 + 10.0**0.3 + 10.0**0.6
    assert (
        stats.kstest(video.ravel(), stats.rayleigh(scale=math.sqrt(sigma2)).cdf).pvalue > IMPROBABLE
    )


def test_correlated_clutter_adds_to_the_noise_as_a_voltage():
    patch = PatchSection(law="rayleigh", cnr_db=3.0, speed_spread=20.0, **WHOLE)
    scenario = Scenario(RADAR, disturbances=(patch,))
    video = next(Simulator(scenario, sectors=1)).sweeps.rows["video"] / RADAR.noise_level
    law = stats.rayleigh(scale=math.sqrt(1.0 + 10.0**0.3))
    assert stats.kstest(video[::3].ravel(), law.cdf).pvalue > IMPROBABLE


def test_a_patch_is_where_its_edges_are_and_as_soft_in_azimuth_as_the_beam():
    section = PatchSection(
        law="rayleigh", cnr_db=40.0, range_from=2000.0, range_to=5000.0,
        azimuth_from_deg=300.0, azimuth_to_deg=400.0, **FINE, speed_spread=20.0,
    )  # fmt: skip
    power = power_of(section, 720)
    azimuth = np.degrees(RADAR.azimuth(np.arange(720)))
    from_middle = np.degrees(wrap_pi(np.radians(azimuth - 350.0)))
    outside = np.abs(from_middle) > 50.0 + math.degrees(RADAR.half_width) * RADAR.beam.extent
    assert not power[:, :20].any()
    assert not power[:, 50:].any()
    assert not power[outside].any()
    inside = np.abs(from_middle) < 50.0 - 3.0 * 4.0
    samples = power[inside, 20:50]
    assert samples.mean() == pytest.approx(1e4, rel=4.0 / math.sqrt(samples.size / 3.0))
    # With the axis on an edge half of the beam's power falls on the patch.
    edge = np.abs(np.abs(from_middle) - 50.0) < 0.3
    assert edge.sum() == 2
    share = Area(section, RADAR).share(np.radians(np.array([300.0, 40.0, 350.0, 100.0])))
    np.testing.assert_allclose(share, [0.5, 0.5, 1.0, 0.0], atol=1e-9)
    # The two-way power exp(-2 a²) is a normal density of standard deviation 1/2.
    before = np.array([-1.0, -0.5, 0.3]) * RADAR.half_width
    share = Area(section, RADAR).share(np.radians(300.0) + before)
    np.testing.assert_allclose(share, stats.norm.cdf(2.0 * before / RADAR.half_width), atol=1e-4)


def textures_of(lifetime, turns):
    section = PatchSection(
        law="k", shape=0.5, cnr_db=20.0, spectrum="white", lifetime=lifetime, **WHOLE
    )
    source = section.disturbance(RADAR, np.random.default_rng(5))
    textures = []
    for turn in turns:
        reception = Reception(720 * turn, 720, RADAR.cells)
        source.add_to(reception)
        textures.append(reception.noise_power() - 1.0)
    return textures


def test_land_keeps_its_texture():
    first, second, third = textures_of(0.0, [0, 1, 2])
    np.testing.assert_array_equal(first, second)
    np.testing.assert_array_equal(first, third)


@pytest.mark.parametrize(("turns", "lag"), [([0, 1], 1), ([0, 1, 2], 2), ([0, 2], 2)])
def test_the_sea_changes_its_texture_in_a_lifetime(turns, lag):
    # Through the normal field: its correlation falls to 1/e in a lifetime, which here is a turn.
    textures = textures_of(1.0, turns)
    first, last = (
        stats.norm.ppf(gammainc(0.5, texture[::2].astype(float) * 0.5 / 100.0))
        for texture in (textures[0], textures[-1])
    )
    finite = np.isfinite(first) & np.isfinite(last)
    measured = np.corrcoef(first[finite], last[finite])[0, 1]
    assert measured == pytest.approx(math.exp(-lag), abs=5.0 / math.sqrt(finite.sum() / 2.0))


def test_grain_is_the_distance_in_which_texture_changes():
    section = PatchSection(
        law="k", shape=2.0, spectrum="white",
        **WHOLE | {"grain_range": 1000.0, "grain_azimuth_deg": 20.0},
    )  # fmt: skip
    texture = np.concatenate([power_of(section, 720, seed=seed) for seed in range(8)])
    texture = texture / texture.mean() - 1.0

    def correlation(pulses, cells):
        one = texture.reshape(8, 720, 100)[:, : 720 - pulses, : 100 - cells]
        other = texture.reshape(8, 720, 100)[:, pulses:, cells:]
        return float(np.mean(one * other) / np.mean(np.square(texture)))

    # 18 x 10 knots in each of 8 fields.
    noise = 4.0 / math.sqrt(8 * 18 * 10)
    for near, half, far in (((1, 0), (20, 0), (81, 0)), ((0, 1), (0, 5), (0, 21))):
        assert correlation(*near) > 0.9
        assert 0.4 < correlation(*half) < 0.9
        assert abs(correlation(*far)) < noise


def test_rain_drifts_with_the_wind():
    section = RainSection(
        x=-3000.0, y=4000.0, radius=800.0, cnr_db=20.0, range_exponent=0.0,
        wind_speed=100.0, wind_course_deg=90.0, speed_spread=20.0,
    )  # fmt: skip
    radar = RADAR.changed({"scan_period": 2.0, "pulse_rate": 360.0})
    source = section.disturbance(radar, np.random.default_rng(1))
    ranges = (np.arange(radar.cells) + 0.5) * radar.range_step
    for turn in range(20):
        reception = Reception(720 * turn, 720, radar.cells)
        source.add_to(reception)
        _, field = reception.signals()
        power = np.square(np.abs(field))
        azimuth = radar.azimuth(np.arange(720 * turn, 720 * (turn + 1)))[:, None]
        east, north = ranges * np.sin(azimuth), ranges * np.cos(azimuth)
        # A polar grid has more samples per area near the antenna.
        weight = power * ranges
        x, y = (float((axis * weight).sum() / weight.sum()) for axis in (east, north))
        time = 2.0 * (turn + float(np.arctan2(x, y) / (2.0 * np.pi)) % 1.0)
        # Within the 20 m by which the rain jumps between passes, and the scatter of the speckle.
        scatter = 4.0 * 800.0 / math.sqrt(np.count_nonzero(power > power.max() / 10.0))
        assert x == pytest.approx(-3000.0 + 100.0 * time, abs=20.0 + scatter)
        assert y == pytest.approx(4000.0, abs=20.0 + scatter)


def test_rain_has_its_ratio_in_the_middle_and_half_of_it_at_its_radius():
    section = RainSection(y=5000.0, radius=1500.0, cnr_db=20.0, range_exponent=0.0, wind_speed=0.0)
    power = np.mean([power_of(section, 40, seed=seed, first=700) for seed in range(100)], axis=0)
    # Pulse 720 looks north; cell 49.5 is the middle, 15 cells are the radius.
    north = power[20]
    error = 4.0 / math.sqrt(100 * 4)
    assert north[48:52].mean() == pytest.approx(100.0, rel=error)
    assert (north[[34, 35, 64, 65]]).mean() == pytest.approx(50.0, rel=error + 0.05)
    assert not north[:19].any()
    assert not north[81:].any()


def test_points_stand_in_the_same_place_and_fluctuate_a_little():
    section = PointsSection(
        number=30, cnr_db=30.0, spread_db=5.0, fluctuation_db=0.5, range_from=1000.0, range_to=9000.0,
        azimuth_from_deg=30.0, azimuth_to_deg=330.0,
    )  # fmt: skip
    field, _ = received(section, 40 * 720)
    turns = field.reshape(40, 720, 100)
    strongest = np.abs(turns[0]) > 20.0
    assert strongest.sum() > 100
    level_db = 20.0 * np.log10(np.abs(turns[:, strongest]))
    # Where two overlap the sum fluctuates as well; most stand alone.
    spread = np.median(level_db.std(axis=0, ddof=1))
    assert spread == pytest.approx(0.5, abs=4.0 * 0.5 / math.sqrt(2.0 * 39.0))
    phase = np.angle(turns[:, strongest] * turns[0, strongest].conj())
    assert np.median(np.abs(phase)) < 1e-6
    peaks = np.abs(turns[0]).max(axis=1)
    azimuth = np.degrees(RADAR.azimuth(np.arange(720)))
    assert not peaks[(azimuth < 15.0) | (azimuth > 345.0)].any()


def test_points_have_the_strengths_asked_for_and_the_burst_of_the_beam():
    one = PointsSection(
        number=1, cnr_db=30.0, spread_db=6.0, fluctuation_db=0.0, range_from=1000.0, range_to=9000.0
    )
    fields = [received(one, 720, seed=seed)[0] for seed in range(150)]
    # Two neighbouring cells share an echo; within half a pulse of the axis the beam takes 0.02 dB of it.
    peak = np.array([np.abs(field).sum(axis=1).max() for field in fields])
    strength = 20.0 * np.log10(peak / math.sqrt(2.0))
    assert strength.mean() == pytest.approx(30.0, abs=0.02 + 4.0 * 6.0 / math.sqrt(150))
    assert strength.std() == pytest.approx(6.0, rel=4.0 / math.sqrt(300))
    alone = PointsSection(
        number=1, cnr_db=30.0, spread_db=0.0, fluctuation_db=0.0, range_from=4949.9, range_to=4950.0,
        azimuth_from_deg=180.0, azimuth_to_deg=180.001,
    )  # fmt: skip
    burst = np.abs(received(alone, 720)[0])[:, 49]
    alpha = (RADAR.azimuth(np.arange(720)) - np.pi) / RADAR.half_width
    expected = math.sqrt(2.0 * 1000.0) * RADAR.beam(alpha)
    np.testing.assert_allclose(burst, expected, rtol=2e-3, atol=1e-2)
