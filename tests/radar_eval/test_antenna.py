# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from radar_common.frames import TWO_PI, wrap_pi, wrap_two_pi
from radar_eval.antenna import estimate_rotation
from radar_eval.errors import RotationError


def observed(period, duration, rate, *, jitter=0.0, seed=1, start=1.7e9):
    generator = np.random.default_rng(seed)
    time = np.sort(generator.uniform(0.0, duration, generator.poisson(rate * duration)))
    azimuth = TWO_PI * time / period + 1.0 + generator.normal(0.0, jitter, len(time))
    return start + time, wrap_two_pi(azimuth)


@settings(max_examples=15, deadline=None)
@given(st.floats(0.8, 15.0), st.integers(0, 1000))
def test_any_period_is_found(period, seed):
    time, azimuth = observed(period, 40.0 * period, 12.0 / period, jitter=0.01, seed=seed)
    rotation = estimate_rotation(time, azimuth)
    # The peak of the resultant is no wider than the inverse of the duration.
    assert rotation.period == pytest.approx(period, rel=2e-4)
    assert np.median(np.abs(wrap_pi(rotation.azimuth(time) - azimuth))) < 0.02


def test_slow_deviations_are_followed():
    time, azimuth = observed(4.0, 1200.0, 10.0)
    swing = 0.2 * np.sin(TWO_PI * (time - time[0]) / 400.0)
    rotation = estimate_rotation(time, wrap_two_pi(azimuth + swing))
    error = wrap_pi(rotation.azimuth(time) - wrap_two_pi(azimuth + swing))
    assert np.max(np.abs(error)) < 0.03


def test_the_angle_counts_turns():
    time, azimuth = observed(4.0, 200.0, 10.0)
    rotation = estimate_rotation(time, azimuth)
    turned = rotation.angle(time[0] + 80.0) - rotation.angle(time[0])
    assert turned == pytest.approx(20.0 * TWO_PI, abs=0.02)


def test_a_known_period_is_kept():
    time, azimuth = observed(4.0, 3.0, 10.0)
    assert estimate_rotation(time, azimuth, period=4.0).period == 4.0


def test_too_few_plots_are_refused():
    with pytest.raises(RotationError, match="too few"):
        estimate_rotation(np.arange(9.0), np.zeros(9))
    with pytest.raises(RotationError, match="too few"):
        estimate_rotation(np.ones(50), np.zeros(50))


def test_azimuths_without_rotation_are_refused():
    generator = np.random.default_rng(3)
    time = np.sort(generator.uniform(0.0, 400.0, 5000))
    with pytest.raises(RotationError, match="no rotation"):
        estimate_rotation(time, generator.uniform(0.0, TWO_PI, 5000), period=4.0)
