# SPDX-License-Identifier: Apache-2.0
"""Wald's test on hits against simulation and its own bounds."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from secondary_proc.calculators.hit_sequence import follow_hit_test, wald_bounds


@settings(max_examples=25)
@given(
    false=st.floats(1e-6, 0.1),
    missed=st.floats(1e-3, 0.2),
    detection=st.floats(0.6, 0.95),
    occupied=st.floats(0.02, 0.3),
)
def test_errors_keep_walds_inequalities(false, missed, detection, occupied):
    low, high = wald_bounds(false, missed)
    noise = follow_hit_test(occupied, detection, occupied, (low, high), 300)
    target = follow_hit_test(detection, detection, occupied, (low, high), 300)
    assert noise.confirmed[-1] + noise.dropped[-1] == pytest.approx(1.0, abs=1e-6)
    # A likelihood ratio of at least B where it confirms, of at most A where it drops.
    assert noise.confirmed[-1] <= target.confirmed[-1] / high + 1e-12
    assert target.dropped[-1] <= low * noise.dropped[-1] + 1e-12


@pytest.mark.parametrize("found", [0.1, 0.8])
def test_the_test_does_what_simulated_tracks_do(found):
    random = np.random.default_rng(5)
    trials, scans = 20_000, 40
    bounds = wald_bounds(1e-3, 0.05)
    seen = random.random((trials, scans)) < found
    ratio = np.cumsum(np.where(seen, np.log(0.8 / 0.1), np.log(0.2 / 0.9)), axis=1)
    over, under = ratio >= np.log(bounds[1]), ratio <= np.log(bounds[0])
    ends = np.argmax(over | under, axis=1)
    share = over[np.arange(trials), ends].mean()
    test = follow_hit_test(found, 0.8, 0.1, bounds, scans)
    expected = test.confirmed[-1]
    assert abs(share - expected) < 4 * np.sqrt(expected * (1 - expected) / trials) + 1e-12
    assert abs(ends.mean() + 1 - test.mean_scans) < 4 * ends.std() / np.sqrt(trials)


def test_impossible_tests_are_refused():
    with pytest.raises(ValueError, match="errors 0 and"):
        wald_bounds(0.0, 0.1)
    with pytest.raises(ValueError, match="tells"):
        follow_hit_test(0.5, 0.2, 0.3, (0.1, 10.0), 5)
