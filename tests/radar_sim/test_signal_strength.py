# SPDX-License-Identifier: Apache-2.0
"""The radar equation and the one convention of signal-to-noise ratio."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from radar_sim.radar import Radar
from radar_sim.signal_strength import amplitude_from_snr, range_of_snr, snr_db_at_range

RADAR = Radar(reference_range=50_000.0, max_snr_db=40.0)


def test_the_ratio_is_as_given_at_the_reference_range():
    assert float(snr_db_at_range(RADAR, 13.0, 50_000.0)) == pytest.approx(13.0)


@given(distance=st.floats(30_000.0, 5e5))
def test_twice_the_range_costs_twelve_decibels(distance):
    near, far = snr_db_at_range(RADAR, 13.0, [distance, 2.0 * distance])
    assert near - far == pytest.approx(40.0 * np.log10(2.0))


@given(distance=st.floats(1.0, 1e6))
def test_the_ratio_is_limited_at_short_range(distance):
    assert float(snr_db_at_range(RADAR, 13.0, distance)) <= 40.0
    assert float(snr_db_at_range(RADAR, 13.0, 1_000.0)) == 40.0


@given(snr_db=st.floats(0.0, 30.0), wanted=st.floats(-20.0, 39.0))
def test_the_range_of_a_ratio_is_the_inverse(snr_db, wanted):
    distance = range_of_snr(RADAR, snr_db, wanted)
    assert float(snr_db_at_range(RADAR, snr_db, distance)) == pytest.approx(wanted)


def test_amplitude_over_noise_rms_squares_to_twice_the_power_ratio():
    # The power ratio is a²/2: 0 dB is a = sqrt 2, and a = 3 is 6.53 dB.
    assert float(amplitude_from_snr(0.0)) == pytest.approx(np.sqrt(2.0))
    assert float(amplitude_from_snr(6.5321)) == pytest.approx(3.0, rel=1e-4)
