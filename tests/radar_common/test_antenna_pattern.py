# SPDX-License-Identifier: Apache-2.0
"""Patterns have their shape, and bursts the number of pulses that the geometry gives."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from radar_common.antenna_pattern import PATTERNS
from radar_common.parameters import ParameterError
from radar_sim.radar import Radar


@pytest.mark.parametrize("name", PATTERNS)
@given(alpha=st.floats(-5.0, 5.0))
def test_a_pattern_is_even_and_never_above_its_peak(name, alpha):
    pattern = PATTERNS[name]
    assert float(pattern(0.0)) == 1.0
    assert 0.0 <= float(pattern(alpha)) <= 1.0
    assert float(pattern(alpha)) == float(pattern(-alpha))


@pytest.mark.parametrize("name", PATTERNS)
def test_a_pattern_falls_to_the_end_of_its_main_lobe(name):
    pattern = PATTERNS[name]
    values = pattern(np.linspace(0.0, pattern.extent, 500))
    assert np.all(np.diff(values) <= 0.0)
    assert float(pattern(pattern.extent * 1.001)) == 0.0


@pytest.mark.parametrize("name", ["gaussian", "sinc", "sinc2"])
def test_half_power_is_where_the_one_way_power_is_one_half(name):
    pattern = PATTERNS[name]
    assert float(pattern(pattern.half_power)) == pytest.approx(0.5, abs=1e-9)


def test_pulses_in_beam_of_the_worked_example():
    # 500 Hz, 10 s, 2 phi = 1.5 deg; for a rectangular pattern 2 phi is the beamwidth.
    radar = Radar(pulse_rate=500.0, scan_period=10.0, beamwidth_deg=1.5, pattern="rectangular")
    assert radar.pulses_in_beam == pytest.approx(20.8, abs=0.04)


@given(rate=st.floats(150.0, 1000.0), period=st.floats(2.0, 20.0), beamwidth=st.floats(1.5, 20.0))
def test_pulses_in_beam_count_azimuth_steps(rate, period, beamwidth):
    radar = Radar(
        pulse_rate=rate, scan_period=period, beamwidth_deg=beamwidth, pattern="rectangular"
    )
    step = 2.0 * math.pi / (rate * period)
    assert radar.pulses_in_beam == pytest.approx(math.radians(beamwidth) / step)


@given(pulse=st.integers(0, 10**9), rate=st.floats(100.0, 1000.0))
def test_the_antenna_turns_clockwise_in_even_steps(pulse, rate):
    radar = Radar(pulse_rate=rate)
    first, second = radar.azimuth([pulse, pulse + 1])
    assert 0.0 <= first < 2.0 * np.pi
    step = 2.0 * np.pi / radar.pulses_per_scan
    assert np.mod(second - first, 2.0 * np.pi) == pytest.approx(step, rel=1e-3)


@pytest.mark.parametrize(
    ("values", "reason"),
    [
        ({"pulse_rate": 10.0, "scan_period": 1.0}, "at least 16"),
        ({"pulse_rate": 100.0, "beamwidth_deg": 0.1}, "at least one"),
        ({"pulse_rate": 5000.0}, "ambiguous"),
    ],
)
def test_an_impossible_radar_is_refused(values, reason):
    with pytest.raises(ParameterError, match=reason):
        Radar(**values)
