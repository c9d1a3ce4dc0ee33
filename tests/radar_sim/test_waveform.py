# SPDX-License-Identifier: Apache-2.0
"""Waveforms on a fine grid have the power, the correlation and the pulses that they are made for."""

from __future__ import annotations

import numpy as np
import pytest

from primary_proc.calculators.quantisation.range_delay import crossing_delay_variance
from primary_proc.calculators.quantisation.range_sampling import reconstruct, reconstruction_error
from radar_common.pulse_response import PULSE_RESPONSES
from radar_sim.fluctuation import FLUCTUATIONS
from radar_sim.waveform import WaveformGenerator

SWEEPS = 20_000


def generator(name, start=-1.0, end=1.0, step=0.05, seed=3):
    return WaveformGenerator(PULSE_RESPONSES[name], start, end, step, np.random.default_rng(seed))


@pytest.mark.parametrize("name", sorted(PULSE_RESPONSES))
def test_a_response_is_one_in_its_middle_and_falls_to_both_sides(name):
    response = PULSE_RESPONSES[name]
    nu = np.linspace(-5.0, 5.0, 1001)
    for shape, extent in (
        (response.echo, response.echo_extent),
        (response.correlation, response.noise_extent),
    ):
        assert shape(np.zeros(1)) == 1.0
        np.testing.assert_allclose(shape(nu), shape(-nu))
        assert np.all(np.diff(shape(nu[nu >= 0.0])) <= 0.0)
        assert shape(np.array([extent])) < 1.01e-3
    inner = nu[np.abs(nu) > 0.02]
    slope = (response.echo(inner + 1e-6) - response.echo(inner - 1e-6)) / 2e-6
    away = np.abs(np.abs(inner) - 1.0) > 0.02
    np.testing.assert_allclose(response.slope(inner)[away], slope[away], atol=1e-5)
    curvature = (1.0 - response.correlation(np.array([1e-4]))[0]) * 2e8
    assert np.sqrt(curvature) == pytest.approx(min(response.bandwidth, 141.4), rel=1e-3)


@pytest.mark.parametrize("name", sorted(PULSE_RESPONSES))
def test_noise_has_the_correlation_asked_for_and_independent_quadratures(name):
    made = generator(name)
    noise = made.noise(SWEEPS)
    assert noise.shape == (SWEEPS, len(made.grid))
    correlation = PULSE_RESPONSES[name].correlation(made.grid - made.grid[5])
    # Products of normal quadratures deviate by at most sqrt 2, the mean of n by 1 / sqrt n of it.
    tolerance = 5.0 * np.sqrt(2.0 / SWEEPS)
    for one, other, expected in (
        (noise.real, noise.real, correlation),
        (noise.imag, noise.imag, correlation),
        (noise.real, noise.imag, 0.0 * correlation),
    ):
        products = np.mean(one[:, 5, None] * other, axis=0)
        np.testing.assert_allclose(products, expected, atol=tolerance)


def test_noise_has_unit_power_and_the_exceedance_of_its_law():
    envelope = np.abs(generator("gaussian", 0.0, 0.0, 0.5).noise(200_000))[:, 0]
    assert np.mean(np.square(envelope)) / 2.0 == pytest.approx(1.0, abs=4.0 / np.sqrt(200_000))
    for threshold in (0.5, 2.0, 3.0):
        wanted = np.exp(-np.square(threshold) / 2.0)
        tolerance = 4.0 * np.sqrt(wanted * (1.0 - wanted) / 200_000)
        assert np.mean(envelope > threshold) == pytest.approx(wanted, abs=tolerance)


@pytest.mark.parametrize("fluctuation", sorted(FLUCTUATIONS))
def test_pulses_have_the_power_and_the_place_asked_for(fluctuation):
    made = generator("gaussian")
    pulses = made.pulses(SWEEPS, 3.0, centre=0.25, fluctuation=fluctuation)
    power = np.mean(np.square(np.abs(pulses)), axis=0)
    shape = np.square(PULSE_RESPONSES["gaussian"].echo(made.grid - 0.25))
    # The power of a Rayleigh amplitude deviates by its own mean.
    np.testing.assert_allclose(power, 9.0 * shape, rtol=4.0 / np.sqrt(SWEEPS))
    assert abs(np.mean(pulses[:, 25] / np.abs(pulses[:, 25]))) < 4.0 / np.sqrt(SWEEPS)


@pytest.mark.parametrize("name", ["gaussian", "gaussian-book"])
def test_a_strong_pulse_crosses_the_threshold_as_late_and_as_early_as_computed(name):
    made = generator(name, -1.5, 0.0, 0.01)
    envelope = np.abs(made.noise(4000) + made.pulses(4000, 30.0))
    after = np.argmax(envelope > 15.0, axis=1)
    row = np.arange(4000)
    low, high = envelope[row, after - 1], envelope[row, after]
    moment = made.grid[after - 1] + 0.01 * (15.0 - low) / (high - low)
    model = {"gaussian": "physical", "gaussian-book": "book"}[name]
    expected = float(crossing_delay_variance(15.0, 30.0, model))
    assert moment.var() == pytest.approx(expected, rel=5.0 * np.sqrt(2.0 / 4000) + 0.02)


def test_samples_are_lost_between_as_computed():
    made = generator("gaussian-book", 0.0, 2.0, 0.02)
    noise = made.noise(4000).real
    back = reconstruct(noise[:, ::10], 0.2, made.grid, PULSE_RESPONSES["gaussian-book"].correlation)
    errors = np.square(back - noise)[:, 5:95].mean(axis=1)
    expected = reconstruction_error(PULSE_RESPONSES["gaussian-book"].correlation, 0.2)
    # Ten grid points an interval stand for its mean; the ends of intervals count half too much.
    tolerance = 4.0 * errors.std() / np.sqrt(4000) + 0.03 * expected
    assert errors.mean() == pytest.approx(expected, abs=tolerance)


def test_no_grid_is_refused():
    with pytest.raises(ValueError, match="no grid from 1 to 0"):
        generator("gaussian", 1.0, 0.0)
    with pytest.raises(ValueError, match="in steps of 0"):
        generator("gaussian", 0.0, 1.0, 0.0)
