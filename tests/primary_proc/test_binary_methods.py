# SPDX-License-Identifier: Apache-2.0
"""Every way to detect on bits: the rate it is set up for, and its own detector against its own predictions."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import binom, poisson

from primary_proc.automata.automaton_chain import start_end_distribution
from primary_proc.calculators.azimuth.azimuth_accuracy import error_of
from primary_proc.calculators.pulse.burst_shape import burst_shape
from primary_proc.calculators.pulse.single_pulse import steady_probability, threshold_for
from primary_proc.choices import find_method
from primary_proc.detectors.program_detector import ProgramDetector
from primary_proc.methods.requirements import Requirements
from primary_proc.methods.rule_method import SettledRule
from primary_proc.methods.sequential_method import MISS
from primary_proc.normalisers.fixed_level import FixedLevel

NO_LIMIT = 10**6
CONFIDENCE = 0.999
RINGS, PULSES = 1024, 2048
BLOCK = 128
METHODS = {
    "3/4-2": {},
    "2/4-2": {},
    "3/5-3": {},
    "accumulator-between-zeros": {},
    "accumulator-from-first-one": {"end_zeros": 3},
    "accumulator-from-first-one, 9": {"second_threshold": 9},
    "sequential": {},
}


def requirements(name, **changes):
    asked = {
        "false_plots": 300.0,
        "rings": RINGS,
        "pulses_per_scan": float(PULSES),
        "gap": 5,
        "pattern": "gaussian",
        "pulses": 11.0,
    }
    return Requirements(**(asked | METHODS[name] | changes))


def settle(name, **changes):
    return find_method(name.partition(",")[0]).settle(requirements(name, **changes))


@pytest.fixture(scope="module", params=METHODS)
def settled(request):
    return settle(request.param)


def detect(settled, packed, one, rings, rng):
    """Bursts in random bits, and those left open; probability of a one on each pulse, shape (pulses,)."""
    detector, closed = settled.detector(rings, NO_LIMIT), []
    for first in range(0, len(one), BLOCK):
        part = one[first : first + BLOCK, None]
        closed.append(detector.detect(packed(rng.random((len(part), rings)) < part), first))
    return np.concatenate(closed), detector.open_bursts()


def test_the_rate_asked_for_is_met(settled):
    assert settled.false_plots == pytest.approx(300.0, rel=1e-3)
    assert settled.false_starts * RINGS * PULSES >= 299.0


def test_false_starts_on_random_bits(settled, packed):
    """Starts are rare and far apart: their number is Poisson distributed."""
    rng = np.random.default_rng(41)
    noise, warm, pulses = settled.noise_probability, 100, 1500
    closed, going = detect(settled, packed, np.full(pulses, noise), RINGS, rng)
    starts = np.concatenate([closed["start"], going["start"]])
    count = int(np.count_nonzero(starts >= warm))
    low, high = poisson.interval(CONFIDENCE, (pulses - warm) * RINGS * settled.false_starts)
    assert low <= count <= high


@pytest.mark.parametrize("snr_db", [5.0, 8.0])
def test_detection_on_random_bits(settled, packed, snr_db):
    """A steady target at the offset of -1/8 step; the prediction is the mean over four offsets, which it differs from
    by less than the sampling error.
    """
    asked = requirements("3/4-2")
    shape = burst_shape(asked.pattern, asked.pulses, -0.125, book=False)
    noise, before, rings = settled.noise_probability, 600, 8192
    amplitude = np.sqrt(2.0) * 10.0 ** (snr_db / 20.0)
    signal = steady_probability(threshold_for(noise), amplitude * shape)
    one = np.concatenate([np.full(before, noise), signal])
    closed, going = detect(settled, packed, one, rings, np.random.default_rng(7))
    found = np.concatenate([closed, going])
    detected = len(np.unique(found["ring"][found["start"] >= before]))
    expected = float(settled.detection_probability(snr_db, "steady"))
    low, high = binom.interval(CONFIDENCE, rings, expected)
    assert low <= detected <= high


def test_azimuth_of_random_bits(settled, packed):
    """Bias and spread of the middle of the bursts declared on the target."""
    asked = requirements("3/4-2")
    # Tests in noise run in step with each other at first; ones bring them out of it.
    rings, before, after, offset = 8192, 600, 60, 0.125
    noise = settled.noise_probability
    signal = steady_probability(
        threshold_for(noise), 5.0 * burst_shape(asked.pattern, asked.pulses, offset)
    )
    one = np.concatenate([np.full(before, noise), signal, np.full(after, noise)])
    closed, _ = detect(settled, packed, one, rings, np.random.default_rng(5))
    position = closed["start"] - before + 1
    ours = closed[(position >= 1) & (position <= len(signal))]
    middle = (ours["start"] + ours["end"]) / 2.0 - before + 1
    error = middle - (len(signal) + 1) / 2.0 - offset

    joint = start_end_distribution(settled.rule.automaton, noise, signal)
    expected = error_of(joint, len(signal), offset)
    place = (joint.start[:, None] + joint.end) / 2.0 - (len(signal) + 1) / 2.0 - offset
    fourth = (joint.probability * (place - expected.bias) ** 4).sum() / expected.bursts
    count, variance = len(error), expected.std**2
    assert count / rings == pytest.approx(expected.bursts, abs=0.02)
    assert abs(error.mean() - expected.bias) < 3.3 * expected.std / np.sqrt(count)
    assert abs(error.var() - variance) < 3.3 * np.sqrt((fourth - variance**2) / count)


def test_quality_falls_from_one_to_nothing(settled):
    quality = settled.quality(np.array([0.0, 0.3, 0.7, 1.0, 50.0]) * settled.noise_probability)
    assert quality[0] == pytest.approx(1.0)
    assert (np.diff(quality[:4]) < 0.0).all()
    assert quality[3:] == pytest.approx(0.0, abs=1e-9)


def test_quality_of_false_bursts_is_uniform(settled, packed):
    """Peaks are drawn for the ones of false bursts; of K ones the strongest is exceeded by chance u^(1/K)."""
    rng = np.random.default_rng(12)
    noise, rings, pulses = settled.noise_probability, 4096, 600
    bits = rng.random((pulses, rings)) < noise
    detector = settled.detector(rings, NO_LIMIT)
    closed = detector.detect(packed(bits), 0)
    closed = closed[closed["start"] > 100]
    assert len(closed) > 200
    first = closed["start"] - settled.rule.memory
    count = [
        bits[a : b + 1, ring].sum()
        for a, b, ring in zip(first, closed["end"], closed["ring"], strict=True)
    ]
    strongest = 1.0 - rng.random(len(closed)) ** (1.0 / np.maximum(count, 1))
    quality = settled.quality(strongest * noise)
    # Kolmogorov's bound at 99.9 %, and what ones before the burst proper are allowed to shift.
    gap = np.abs(np.sort(quality) - (np.arange(len(quality)) + 0.5) / len(quality)).max()
    assert gap < 1.95 / np.sqrt(len(quality)) + 0.03


def test_threshold_of_an_accumulator_follows_the_burst():
    for pulses, threshold in ((11.0, 5), (16.0, 6), (40.0, 9)):
        assert settle("accumulator-from-first-one", pulses=pulses).rule.threshold == threshold
    asked = settle("accumulator-between-zeros", second_threshold=8, end_zeros=3)
    assert (asked.rule.threshold, asked.rule.zeros) == (8, 3)


def test_out_of_reach_is_refused_with_the_reason():
    with pytest.raises(ValueError, match="out of reach"):
        settle("accumulator-between-zeros", end_zeros=3, second_threshold=5, false_plots=1e-2)
    with pytest.raises(ValueError, match="threshold"):
        settle("accumulator-between-zeros", end_zeros=5)
    with pytest.raises(ValueError, match="states"):
        settle("accumulator-from-first-one", end_zeros=50, second_threshold=1000)
    with pytest.raises(ValueError, match="sequential"):
        find_method("sequentially")


def test_programs_run_in_parallel_where_they_can():
    for name, parallel in (
        ("3/4-2", True),
        ("3/5-3", True),
        ("2/4-2", False),
        ("sequential", False),
    ):
        assert isinstance(settle(name).detector(8, 20), ProgramDetector) == parallel


@pytest.mark.parametrize(("pulses", "target"), [(4.0, "steady"), (11.0, "slow"), (30.0, "fast")])
def test_the_sequential_test_is_made_for_the_target_that_it_detects(pulses, target):
    settled = settle("sequential", pulses=pulses, target=target)
    assert isinstance(settled, SettledRule)
    snr_db = np.linspace(-5.0, 25.0, 61)
    found = settled.detection_probability(snr_db, target)
    assert found[-1] > 1.0 - MISS
    program = settle("3/4-2", pulses=pulses, target=target).detection_probability(snr_db, target)
    ours, theirs = (snr_db[np.argmax(curve > 0.8)] for curve in (found, program))
    assert ours <= theirs + 0.5


def test_longer_bursts_gain_most_from_the_sequential_test():
    gain = []
    for pulses in (8.0, 15.0, 30.0):
        snr_db = np.linspace(0.0, 12.0, 121)
        ours, theirs = (
            snr_db[
                np.argmax(settle(name, pulses=pulses).detection_probability(snr_db, "steady") > 0.9)
            ]
            for name in ("sequential", "3/4-2")
        )
        gain.append(theirs - ours)
    assert gain[0] > -0.5
    assert gain[2] > gain[1] > gain[0]


def test_quantiser_counts_ones_of_the_noise_probability(settled):
    rng = np.random.default_rng(2)
    video = rng.rayleigh(3.0, (256, 512)).astype(np.float32)
    normaliser = FixedLevel(512, 3.0 * np.sqrt(2.0))
    ratios = np.empty(video.shape, np.float32)
    normaliser.ratios(video, np.zeros(256), ratios)
    quantiser = settled.quantiser(normaliser)
    quantiser.quantise(ratios)
    low, high = binom.interval(CONFIDENCE, video.size, settled.noise_probability)
    assert low <= quantiser.ones <= high
