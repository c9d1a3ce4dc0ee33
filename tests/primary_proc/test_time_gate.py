# SPDX-License-Identifier: Apache-2.0
"""What a gate sees of a waveform, what the quantiser circuit sees, and both against simulated video."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from primary_proc.calculators.quantisation.noise_excursions import (
    crossing_rate,
    false_detection_in_gate,
    long_crossing_rate,
    long_excursions,
    mean_excursion,
    video_model,
)
from primary_proc.calculators.quantisation.pulse_in_gate import (
    crossing_correction,
    detection_in_gate,
    detection_in_gates,
    pulse_crossing_rate,
)
from primary_proc.quantisers.time_gate import circuit_ones, gate_levels, threshold_step
from radar_sim.waveform import WaveformGenerator

MODELS = ["book", "physical"]


def triggers_one_by_one(envelope, threshold, period):
    """The circuit of § 2.4.4 with its two triggers, sample by sample."""
    ones = []
    first = second = False
    before = envelope[0] > threshold
    for number in range(len(envelope) // period * period + 1):
        if number % period == 0:
            second = first
            ones.append(second)
        elif number % period == period // 2 and second:
            first = second = False
        if number < len(envelope):
            now = envelope[number] > threshold
            first |= now and not before
            before = now
    return ones


@given(
    envelope=arrays(float, st.integers(1, 60), elements=st.sampled_from([0.0, 2.0])),
    half=st.integers(1, 3),
)
def test_the_circuit_is_that_of_its_two_triggers(envelope, half):
    ones = circuit_ones(envelope[None], 1.0, 2 * half)
    if len(envelope) % (2 * half) == 0:
        assert ones[0].tolist() == triggers_one_by_one(envelope, 1.0, 2 * half)
    assert ones.shape == (1, len(envelope) // (2 * half) + 1)


@given(envelope=arrays(float, (3, 40), elements=st.floats(0.0, 4.0)), threshold=st.floats(0.1, 3.9))
def test_a_one_of_the_circuit_is_a_one_of_the_gate_before(envelope, threshold):
    circuit = circuit_ones(envelope, threshold, 4)[:, 1:]
    gate = gate_levels(envelope, [threshold], 4) == 1
    assert not np.any(circuit & ~gate)


def test_a_level_that_is_high_at_the_start_makes_a_one_only_in_the_gate():
    envelope = np.full((1, 12), 2.0)
    envelope[0, :2] = 0.0
    assert gate_levels(envelope, [1.0], 4).tolist() == [[1, 1, 1]]
    assert circuit_ones(envelope, 1.0, 4).tolist() == [[False, True, False, False]]


def test_a_rise_is_lost_while_the_output_is_on():
    # Rises at 3, late in gate 0, and at 5, early in gate 1.
    envelope = np.array([[0.0, 0, 0, 2, 0, 2, 0, 0, 0, 0, 0, 0]])
    assert circuit_ones(envelope, 1.0, 4).tolist() == [[False, True, False, False]]
    # One sample later it is after the reset.
    assert circuit_ones(np.roll(envelope, 1), 1.0, 4).tolist() == [[False, False, True, False]]


def test_levels_count_the_thresholds_exceeded():
    envelope = np.array([[0.5, 1.5, 0.2, 3.5, 2.5, 1.0, 9.0]])
    assert gate_levels(envelope, [1.0, 2.0, 3.0], 2).tolist() == [[1, 3, 2]]


def test_gates_need_samples_and_a_middle():
    with pytest.raises(ValueError, match="at least one sample"):
        gate_levels(np.ones((1, 4)), [1.0], 0)
    with pytest.raises(ValueError, match="no middle"):
        circuit_ones(np.ones((1, 4)), 1.0, 3)


def test_the_threshold_control_finds_the_allowed_number():
    rng = np.random.default_rng(5)
    for sigma in (0.7, 1.0, 1.6):
        threshold = 2.5
        for _ in range(40):
            rate = 4000.0 * np.exp(-np.square(threshold / sigma) / 2.0)
            threshold = threshold_step(threshold, rng.poisson(rate), 40.0)
        # Forty counts scatter by a sixth, half of which moves x^2.
        assert 4000.0 * np.exp(-np.square(threshold / sigma) / 2.0) == pytest.approx(40.0, rel=0.6)


@pytest.fixture(scope="module", params=MODELS)
def noise(request):
    """Envelopes of noise over twenty pulse lengths, a hundred points in each: model and samples."""
    generator = WaveformGenerator(
        video_model(request.param), 0.0, 20.0, 0.01, np.random.default_rng(11)
    )
    return request.param, np.abs(generator.noise(1500))


def test_noise_crosses_as_often_as_computed(noise):
    model, envelope = noise
    for threshold in (1.0, 2.0, 3.0):
        over = envelope > threshold
        rises = np.count_nonzero(over[:, 1:] & ~over[:, :-1], axis=1) / 20.0
        # The grid misses pairs of crossings nearer than a step; the rest is the scatter between sweeps.
        tolerance = 4.0 * rises.std() / np.sqrt(len(rises)) + 0.005 * rises.mean()
        assert rises.mean() == pytest.approx(float(crossing_rate(threshold, model)), abs=tolerance)
        stay = over.mean() / rises.mean()
        assert stay == pytest.approx(float(mean_excursion(threshold, model)), rel=0.06)


def test_excursions_last_as_rice_has_it(noise):
    model, envelope = noise
    duration = 0.5 * float(mean_excursion(3.0, model))
    edges = np.diff((envelope > 3.0).astype(np.int8), axis=1, prepend=0, append=0)
    length = 0.01 * (np.nonzero(edges == -1)[1] - np.nonzero(edges == 1)[1])
    share = np.mean(length > duration)
    assert share == pytest.approx(float(long_excursions(duration, 3.0, model)), abs=0.05)
    assert abs(share - long_excursions(duration, 3.0, model, "kuzmin")) > 0.1


def test_a_long_excursion_is_a_share_of_all():
    for law in ("rice", "kuzmin"):
        assert long_crossing_rate(0.0, 2.0, law=law) == pytest.approx(float(crossing_rate(2.0)))
    with pytest.raises(ValueError, match="neither rice nor kuzmin"):
        long_excursions(1.0, 2.0, law="poisson")


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("signal", [0.0, 1.0, 2.0, 3.0])
def test_the_hazard_form_follows_simulated_video(model, signal):
    rng = np.random.default_rng(7)
    generator = WaveformGenerator(video_model(model), -0.5, 0.5, 0.02, rng)
    envelope = np.abs(generator.noise(6000) + generator.pulses(6000, signal))
    measured = np.mean(gate_levels(envelope, [2.0], envelope.shape[1]))
    computed = detection_in_gate(-0.5, 1.0, signal, 2.0, model=model)
    assert measured == pytest.approx(computed, rel=0.06 + 4.0 * np.sqrt(0.25 / 6000))
    if signal:
        poisson = detection_in_gate(-0.5, 1.0, signal, 2.0, model=model, form="poisson")
        assert poisson < measured - 0.04


@pytest.mark.parametrize("model", MODELS)
def test_crossings_of_a_pulse_are_where_the_correction_puts_them(model):
    generator = WaveformGenerator(video_model(model), -0.6, 0.6, 0.01, np.random.default_rng(2))
    over = np.abs(generator.noise(8000) + generator.pulses(8000, 2.0)) > 2.0
    rises = over[:, 1:] & ~over[:, :-1]
    middle = (generator.grid[1:] + generator.grid[:-1]) / 2.0
    for part in (slice(0, 40), slice(40, 80), slice(80, 120)):
        count = np.count_nonzero(rises[:, part], axis=1)
        expected = float(pulse_crossing_rate(middle[part], 2.0, 2.0, model).sum() * 0.01)
        assert count.mean() == pytest.approx(expected, abs=4.0 * count.std() / np.sqrt(8000) + 3e-3)


@given(kappa=st.floats(0.0, 60.0), slope=st.floats(-3.0, 3.0))
def test_series_and_integral_agree(kappa, slope):
    integral = crossing_correction(kappa, slope)
    # Falling edges leave a small difference of large terms.
    assert crossing_correction(kappa, slope, "series") == pytest.approx(float(integral), abs=1e-9)
    assert integral > 0.0
    assert crossing_correction(kappa, 0.0) == pytest.approx(1.0)


def test_without_a_signal_the_pulse_is_noise():
    for model in MODELS:
        rate = pulse_crossing_rate(np.array([-0.3, 0.0, 0.9]), 0.0, 1.7, model)
        np.testing.assert_allclose(rate, crossing_rate(1.7, model), rtol=1e-12)
        gate = detection_in_gate(0.2, 0.8, 0.0, 1.7, model=model, form="poisson")
        assert gate == pytest.approx(float(false_detection_in_gate(1.7, 0.8, model)), rel=1e-9)


def test_several_gates_miss_together():
    assert detection_in_gates([0.5, 0.5]) == pytest.approx(0.75)
    np.testing.assert_allclose(detection_in_gates([[0.0, 0.3], [1.0, 0.0]]), [0.3, 1.0])


def test_unknown_names_are_refused():
    with pytest.raises(ValueError, match="neither book nor physical"):
        crossing_rate(2.0, "mixed")
    with pytest.raises(ValueError, match="none of integral"):
        crossing_correction(1.0, 1.0, "long")
    with pytest.raises(ValueError, match="neither hazard nor poisson"):
        detection_in_gate(0.0, 1.0, 1.0, 2.0, form="exact")
