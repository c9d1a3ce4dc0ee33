# SPDX-License-Identifier: Apache-2.0
"""Detection of plots and of tracks, by simulation and by every word."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from secondary_proc.calculators.plot_detection import (
    burst_threshold,
    farthest_range,
    many_pulse_detection,
    plot_detection,
    strong_signal_detection,
)
from secondary_proc.calculators.track_detection import (
    approach,
    confirmation_delay,
    printed_track_detection,
    scans_until,
    track_detection,
)


@pytest.mark.parametrize("target", ["steady", "fast"])
def test_plots_are_detected_as_often_as_simulated(target):
    random = np.random.default_rng(5)
    trials, pulses, distance = 20_000, 6, 0.75
    power = 0.5 / distance**4
    noise = random.normal(size=(trials, pulses, 2))
    if target == "steady":
        noise[..., 0] += np.sqrt(2.0 * power)
    else:
        noise *= np.sqrt(1.0 + power)
    root = np.sqrt((noise**2).sum(axis=(1, 2)))
    share = np.mean(root > burst_threshold(1e-2, pulses))
    expected = float(plot_detection(distance, pulses, 1e-2, target))
    assert abs(share - expected) < 4 * np.sqrt(expected * (1 - expected) / trials)


def test_far_away_only_noise_is_detected():
    assert plot_detection(50.0, 8, 1e-3) == pytest.approx(1e-3, rel=1e-2)
    assert np.all(np.diff(plot_detection(np.linspace(0.5, 2, 50), 8, 1e-3)) < 0)


def test_each_approximation_has_its_own_realm():
    distance = np.linspace(0.5, 1.0, 101)
    few, many = plot_detection(distance, 1, 1e-4), plot_detection(distance, 22, 1e-4)
    assert np.abs(strong_signal_detection(distance, 1, 1e-4) - few).max() < 0.006
    assert np.abs(many_pulse_detection(distance, 22, 1e-4) - many).max() < 0.023
    assert np.abs(strong_signal_detection(distance, 22, 1e-4) - many).max() > 0.3


def test_range_follows_the_radar_equation():
    distance = farthest_range(1e6, 2e3, 0.1, 5.0, 1e-13)
    received = 1e6 * 2e3**2 * 0.1**2 * 5.0 / ((4 * np.pi) ** 3 * distance**4)
    assert received == pytest.approx(1e-13)


def test_an_unknown_target_is_refused():
    with pytest.raises(ValueError, match="slow"):
        plot_detection(1.0, 8, 1e-3, "slow")


@settings(max_examples=25)
@given(
    found=st.lists(st.floats(0.0, 1.0), min_size=7, max_size=7),
    rule=st.sampled_from([(2, 2), (2, 3), (3, 4), (3, 5), (4, 4)]),
)
def test_tracks_are_the_sum_over_all_words(found, rule):
    hits, window = rule
    total = 0.0
    for word in product((0, 1), repeat=len(found)):
        if any(sum(word[i : i + window]) >= hits for i in range(len(word))):
            total += np.prod([p if hit else 1 - p for p, hit in zip(found, word, strict=True)])
    assert track_detection(np.array(found), hits, window)[-1] == pytest.approx(total, abs=1e-12)


def test_many_targets_at_once_are_each_on_their_own():
    found = np.random.default_rng(1).random((12, 4, 3))
    together = track_detection(found, 3, 4)
    np.testing.assert_allclose(together[:, 2, 1], track_detection(found[:, 2, 1], 3, 4))


@given(found=st.lists(st.floats(0.0, 1.0), min_size=1, max_size=20), m=st.integers(2, 5))
def test_the_recurrence_for_runs_is_exact(found, m):
    found = np.array(found)
    np.testing.assert_allclose(
        printed_track_detection(found, m, m), track_detection(found, m, m), atol=1e-12
    )


def test_the_recurrence_for_three_of_four_ends_after_six_scans():
    found = np.full(12, 0.8)
    exact, printed = track_detection(found, 3, 4), printed_track_detection(found, 3, 4)
    np.testing.assert_allclose(printed[:6], exact[:6], atol=1e-12)
    assert printed[8] > 1.0 > exact[8]
    with pytest.raises(ValueError, match="2/5"):
        printed_track_detection(found, 2, 5)


@pytest.mark.parametrize("rule", [(2, 2, None), (3, 4, None), (3, 5, 2)])
def test_the_delay_is_that_of_simulated_targets(rule):
    random = np.random.default_rng(7)
    hits, window, misses = rule
    found = random.random((6000, 200)) < 0.6
    found[:, 0] = True
    confirmed = np.zeros(len(found))
    for row, seen in enumerate(found):
        begin = 0
        for scan in range(len(seen)):
            if misses and scan - begin >= misses and not seen[scan - misses : scan].any():
                begin = scan
            if seen[scan] and seen[max(begin, scan - window + 1) : scan + 1].sum() >= hits:
                confirmed[row] = scan
                break
    error = 4 * confirmed.std() / np.sqrt(len(confirmed))
    assert abs(confirmed.mean() - confirmation_delay(0.6, *rule)) < error


def test_a_sure_target_is_confirmed_without_delay():
    np.testing.assert_allclose(confirmation_delay([1.0, 1.0], 3, 4), 2.0)
    assert confirmation_delay(0.5, 1, 3) == 0.0


def test_a_faster_target_is_confirmed_nearer():
    reached = []
    for speed in (0.01, 0.02, 0.05):
        ranges = approach(speed, 100)
        confirmed = track_detection(plot_detection(ranges, 14, 1e-4), 3, 3)
        reached.append(ranges[scans_until(confirmed, 0.9)])
    assert reached == sorted(reached, reverse=True)
    assert scans_until(np.array([0.1, 0.2]), 0.5) is None
    assert approach(0.3, 10).min() > 0.0
