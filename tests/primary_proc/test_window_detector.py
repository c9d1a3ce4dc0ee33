# SPDX-License-Identifier: Apache-2.0
"""The sliding-window detector against a plain loop over rings and pulses, and against itself in pieces."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from primary_proc.detectors.window_detector import WindowDetector
from primary_proc.normalisers.fixed_level import FixedLevel
from primary_proc.quantisers.amplitude_quantiser import (
    ENVELOPE_STEPS,
    STEPS_PER_SIGMA,
    AmplitudeQuantiser,
)
from primary_proc.quantisers.level_quantiser import LevelQuantiser

NO_LIMIT = 10**6


def run(detector, scores, cuts=()):
    """Feed scores of one channel in pieces; bursts as (ring, start, end, overflow, centre), and those left open."""
    found, first = [], 0
    for part in filter(len, np.split(scores.astype(np.float32)[:, None], cuts)):
        found.append(detector.detect(part, first))
        first += len(part)
    table = np.concatenate(found)
    names = ["ring", "start", "end", "overflow", "centre"]
    return sorted(table[names].tolist()), sorted(detector.open_bursts()[["ring", "start"]].tolist())


def plain(scores, taps, threshold, longest, first_peak):
    """The same by the letter: one ring, one pulse after the other."""
    closed, still_open = [], []
    for ring, column in enumerate(scores.T):
        start, sums, done = None, [], False
        for pulse in range(len(column)):
            past = column[max(pulse - len(taps) + 1, 0) : pulse + 1]
            total = float(past @ taps[len(taps) - len(past) :])
            if start is None:
                if total >= threshold:
                    start, sums, done = pulse, [total], False
            elif total < threshold:
                if not done:
                    closed.append((ring, start, pulse, False, peak(sums, start, taps, first_peak)))
                start = None
            elif not done and pulse - start >= longest:
                closed.append((ring, start, pulse, True, peak(sums, start, taps, first_peak)))
                done = True
            else:
                sums.append(total)
        if start is not None and not done:
            still_open.append((ring, start))
    return sorted(closed), still_open


def peak(sums, start, taps, first_peak):
    if first_peak:
        falls = [i for i in range(1, len(sums)) if sums[i] < sums[i - 1]]
        sums = sums[: falls[0]] if falls else sums
    best = [start + i for i, value in enumerate(sums) if value == max(sums)]
    return (best[0] + best[-1]) / 2.0 - (len(taps) - 1) / 2.0


@settings(deadline=None, max_examples=80)
@given(data=st.data())
def test_it_does_what_the_plain_loop_does_however_the_pulses_are_cut(data):
    rng = np.random.default_rng(data.draw(st.integers(0, 2**32)))
    rings, pulses = data.draw(st.integers(1, 30)), data.draw(st.integers(1, 120))
    taps = rng.integers(0, 8, data.draw(st.integers(1, 9))).astype(float)
    scores = rng.integers(0, data.draw(st.sampled_from([2, 8])), (pulses, rings)).astype(float)
    scores *= rng.random(scores.shape) < data.draw(st.sampled_from([0.1, 0.5, 0.9]))
    threshold = 1.0 + rng.random() * max(taps.sum() * scores.max(initial=1.0) * 0.6, 1.0)
    longest = data.draw(st.sampled_from([1, 3, 10, NO_LIMIT]))
    first_peak = data.draw(st.booleans())
    cuts = sorted(data.draw(st.lists(st.integers(1, pulses), unique=True, max_size=6)))

    def detector():
        return WindowDetector(taps[None], threshold, rings, longest, first_peak=first_peak)

    expected = plain(scores, taps, threshold, longest, first_peak)
    assert run(detector(), scores) == expected
    assert run(detector(), scores, cuts) == expected


def test_channels_add_up_exactly():
    """Two channels of large scores: the sums lose no digit, wherever a message begins."""
    rng = np.random.default_rng(1)
    taps = rng.integers(-100, 127, (2, 19)).astype(float)
    scores = rng.integers(0, 3000, (200, 2, 40)).astype(np.float32)
    exact = sum(
        np.apply_along_axis(np.convolve, 0, scores[:, c].astype(np.int64), t[::-1].astype(np.int64))
        for c, t in enumerate(taps)
    )[:200]
    threshold = float(np.quantile(exact, 0.9))
    for cut in (1, 7, 32, 200):
        detector = WindowDetector(taps, threshold, 40, NO_LIMIT)
        sums = [
            detector._sums(np.concatenate([detector._past, part]), len(part))
            for part in [scores[:cut]]
        ]
        assert (sums[0] == exact[:cut]).all()


def test_equal_sums_have_their_middle_and_a_first_peak_is_kept():
    scores = np.array([0, 3, 5, 5, 4, 6, 3, 0, 0], float)[:, None]
    whole = WindowDetector([[1.0]], 3, 1, NO_LIMIT)
    first = WindowDetector([[1.0]], 3, 1, NO_LIMIT, first_peak=True)
    assert run(whole, scores, [4])[0] == [(0, 1, 7, False, 5.0)]
    assert run(first, scores, [4])[0] == [(0, 1, 7, False, 2.5)]


def test_reset_forgets():
    detector = WindowDetector([[1.0, 1.0, 1.0]], 2, 3, NO_LIMIT)
    detector.detect(np.ones((5, 1, 3), np.float32), 0)
    assert len(detector.open_bursts()) == 3
    detector.reset()
    assert len(detector.open_bursts()) == 0
    assert len(detector.detect(np.zeros((3, 1, 3), np.float32), 5)) == 0


def test_levels_have_their_scores_and_nan_the_lowest():
    quantiser = LevelQuantiser([[1.0, 1.0], [2.0, 3.0]], [0, 4, 9], counted=1)
    ratios = np.array([[0.5, 1.5], [2.5, 2.5], [np.nan, np.inf]], np.float32)
    assert quantiser.quantise(ratios)[:, 0].tolist() == [[0, 4], [9, 4], [0, 9]]
    assert quantiser.ones == 2


@pytest.mark.parametrize(
    ("envelope", "step"), [(0.0, 0), (1.51, 48), (31.99, 1023), (1e6, 1023), (np.nan, 0)]
)
def test_the_envelope_is_looked_up_in_steps_of_a_sigma(envelope, step):
    table = np.arange(2 * ENVELOPE_STEPS).reshape(2, -1)
    quantiser = AmplitudeQuantiser(FixedLevel(3, 1.0), table, counted=47)
    with np.errstate(over="ignore"):
        ratios = np.full((1, 3), np.square(np.float32(envelope)) / 2, np.float32)
    samples = quantiser.quantise(ratios)
    assert samples.shape == (1, 2, 3)
    assert samples[0, :, 0].tolist() == [step, step + ENVELOPE_STEPS]
    assert quantiser.ones == (3 if envelope * STEPS_PER_SIGMA >= 48 else 0)
