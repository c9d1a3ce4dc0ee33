# SPDX-License-Identifier: Apache-2.0
"""Video with several samples in a pulse: correlated noise, echoes of the pulse's shape, and the same in any pieces."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import stats

from radar_common.pulse_response import PULSE_RESPONSES
from radar_sim.motion import Path
from radar_sim.radar import Radar
from radar_sim.scenario import Scenario, parse_scenario
from radar_sim.simulator import Simulator
from radar_sim.targets import Target
from radar_sim.waveform_receiver import noise_kernel

SHAPES = sorted(PULSE_RESPONSES)
RADAR = Radar(
    scan_period=1.0,
    pulse_rate=192.0,
    beamwidth_deg=30.0,
    pattern="rectangular",
    range_step=25.0,
    cells=64,
    noise_level=0.05,
    reference_range=800.0,
)
BEAM = slice(89, 104)


def radar(shape="rectangular", samples=4, **changes):
    return RADAR.changed({"pulse_shape": shape, "samples_per_pulse": samples} | changes)


def video(of, targets=(), scans=20, sectors=1, seed=4):
    """Envelope over sigma, shape (pulses, cells)."""
    sectors = Simulator(Scenario(of, tuple(targets)), seed=seed, sectors=sectors, scans=scans)
    rows = np.concatenate([sector.sweeps.rows["video"] for sector in sectors])
    return rows.astype(float) / of.noise_level


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("samples", [1, 2, 5])
def test_the_kernel_gives_the_correlation_of_the_response(shape, samples):
    kernel = noise_kernel(shape, samples)
    lags = np.correlate(kernel, kernel, "full")[len(kernel) - 1 :]
    expected = PULSE_RESPONSES[shape].correlation(np.arange(len(lags)) / samples)
    np.testing.assert_allclose(lags, expected, atol=3e-5)


@pytest.mark.parametrize("shape", SHAPES)
def test_the_power_of_noise_is_correlated_along_range_and_exponential(shape):
    power = np.square(video(radar(shape), scans=60)) / 2.0
    # The correlation of powers is the square of that of quadratures.
    expected = np.square(PULSE_RESPONSES[shape].correlation(np.arange(9) / 4.0))
    deviations = power - 1.0
    for lag in range(9):
        products = deviations[:, : 64 - 8] * deviations[:, lag : 64 - 8 + lag]
        # Every pulse has at least a dozen independent lengths; the pulses are independent.
        scatter = products.mean(axis=1).std() / np.sqrt(len(power))
        assert products.mean() == pytest.approx(expected[lag], abs=4.5 * scatter)
    apart = power[:, ::32].ravel()
    assert stats.kstest(apart, stats.expon.cdf).pvalue > 1e-4


def test_noise_is_independent_from_pulse_to_pulse():
    power = np.square(video(radar(), scans=40))
    one, other = power[1:, ::8].ravel(), power[:-1, ::8].ravel()
    assert abs(np.corrcoef(one, other)[0, 1]) < 4.0 / np.sqrt(one.size)


@pytest.mark.parametrize("shape", SHAPES)
def test_a_strong_echo_has_the_shape_of_the_pulse(shape):
    # Between two cell centres, so that no sample lies at its middle.
    place = 30.3
    target = Target(Path(0.0, -(place + 0.5) * 25.0, 0.0, 0.0), 40.0, "none")
    echo = video(radar(shape), [target], scans=10).reshape(10, 192, 64)[:, BEAM].mean(axis=(0, 1))
    nu = (np.arange(64) - place) / 4.0
    # The sensitivity time control holds it to 40 dB, a = 141; ten bursts of fifteen pulses leave little noise.
    expected = np.sqrt(2e4) * PULSE_RESPONSES[shape].echo(nu)
    seen = np.abs(nu) < 0.6
    np.testing.assert_allclose(echo[seen], expected[seen], rtol=0.02)


def test_signal_and_noise_make_a_rice_envelope():
    target = Target(Path(0.0, -30.5 * 25.0, 0.0, 0.0), 5.0, "none")
    cell = video(radar(), [target], scans=60).reshape(60, 192, 64)[:, BEAM, 30].ravel()
    power = 10.0 ** (0.5 + 4.0 * np.log10(800.0 / (30.5 * 25.0)))
    assert stats.kstest(np.square(cell), stats.ncx2(2, 2.0 * power).cdf).pvalue > 1e-4


@pytest.mark.parametrize("shape", SHAPES)
def test_other_sectors_give_the_same_video(shape):
    target = Target(Path(0.0, -800.0, 20.0, 0.3), 15.0, "fast")
    whole, pieces = (video(radar(shape), [target], scans=2, sectors=n) for n in (1, 7))
    assert whole.tobytes() == pieces.tobytes()
    assert video(radar(shape), [target], scans=2, seed=5).tobytes() != whole.tobytes()


def test_one_sample_in_a_rectangular_pulse_is_the_receiver_of_independent_cells():
    assert RADAR.independent_cells
    assert not radar(samples=2).independent_cells
    assert not radar("gaussian", 1).independent_cells
    power = np.square(video(RADAR, scans=40))
    one, other = power[:, 1:].ravel(), power[:, :-1].ravel()
    assert abs(np.corrcoef(one, other)[0, 1]) < 4.0 / np.sqrt(one.size)


def scene(text):
    head = """
radar: {scan_period: 1.0, pulse_rate: 192.0, beamwidth_deg: 30.0, range_step: 25.0, cells: 64, noise_level: 0.05,
        samples_per_pulse: 4}
"""
    scenario = parse_scenario(head + text)
    rows = [sector.sweeps.rows["video"] for sector in Simulator(scenario, scans=30, sectors=1)]
    return np.concatenate(rows).astype(float) / 0.05


def test_jamming_raises_correlated_noise():
    jammed = scene("interference: {jammers: [{azimuth_deg: 90.0, jnr_db: 30.0}]}")
    at_jammer = np.square(jammed.reshape(30, 192, 64)[:, 48]) / 2.0
    assert at_jammer.mean() == pytest.approx(1001.0, rel=0.3)
    deviations = at_jammer / at_jammer.mean() - 1.0
    beside = np.mean(deviations[:, 1:] * deviations[:, :-1])
    # The square of three quarters, in a few hundred independent pieces.
    assert beside == pytest.approx(0.5625, abs=0.3)


def test_clutter_is_as_long_as_the_pulse():
    patch = "{range_from: 200.0, range_to: 1400.0, cnr_db: 30.0, spectrum: gaussian}"
    power = np.square(scene(f"clutter: {{patches: [{patch}]}}"))[::8, 16:48]
    one, other = power[:, 1:].ravel(), power[:, :-1].ravel()
    assert np.corrcoef(one, other)[0, 1] > 0.5
    far = power[:, 10:].ravel(), power[:, :-10].ravel()
    assert np.corrcoef(*far)[0, 1] < 0.3


def test_point_clutter_and_foreign_pulses_take_the_room_of_the_pulse():
    point = "{range_from: 780.0, range_to: 815.0, number: 1, cnr_db: 40.0, spread_db: 0.0}"
    places = scene(f"clutter: {{points: [{point}]}}").reshape(30, 192, 64).mean(axis=(0, 1))
    assert np.count_nonzero(places > 3.0) in range(5, 9)
    foreign = "{azimuth_deg: 0.0, snr_db: 40.0, pulse_rate: 5000.0, pulse_length: 1.0e-6}"
    hit = scene(f"interference: {{radars: [{foreign}]}}")
    runs = np.diff((hit > 15.0).astype(int), axis=1, prepend=0, append=0)
    length = np.nonzero(runs == -1)[1] - np.nonzero(runs == 1)[1]
    # 150 m are six cells; a filter over four adds up to three more.
    assert 5.0 <= np.median(length) <= 9.0
