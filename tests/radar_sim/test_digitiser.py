# SPDX-License-Identifier: Apache-2.0
"""Samples of every type and law are those of the float envelope, rounded and saturated."""

from __future__ import annotations

import numpy as np
import pytest

from primary_proc.parameters import ExtractorParameters
from primary_proc.stream.video_law import VIDEO_LAWS as EXTRACTOR_LAWS
from primary_proc.stream.video_law import expansion
from radar_sim.digitiser import SAMPLES, VIDEO_LAWS, Digitiser
from radar_sim.radar import Radar

RADAR = Radar(cells=64, noise_level=0.05, full_scale=50.0, gain_swing_db=3.0, db_per_count=0.5)
POWER = np.geomspace(1e-5, 1e7, 40 * 64).reshape(40, 64).astype(np.float32)
LARGEST = {"uint8": 255, "uint16": 65535, "float32": np.inf}


def digitised(sample, law, radar=RADAR):
    video = np.empty(POWER.shape, sample)
    Digitiser(radar, sample, law).digitise(POWER.copy(), video)
    return video


def envelope():
    """Over the level of the noise's quadratures."""
    return np.sqrt(2.0 * POWER.astype(float)) * RADAR.gain()


def test_linear_float_video_is_the_envelope():
    np.testing.assert_allclose(digitised("float32", "linear"), envelope() * 0.05, rtol=1e-6)


@pytest.mark.parametrize("sample", ["uint8", "uint16"])
def test_linear_integers_reach_from_zero_to_full_scale(sample):
    expected = np.minimum(envelope() / 50.0 * LARGEST[sample], LARGEST[sample])
    np.testing.assert_allclose(digitised(sample, "linear"), expected, atol=0.51)
    assert digitised(sample, "linear").max() == LARGEST[sample]


@pytest.mark.parametrize("sample", SAMPLES)
@pytest.mark.parametrize("floor_db", [-20.0, 10.0])
def test_logarithmic_video_counts_steps_from_its_floor(sample, floor_db):
    radar = RADAR.changed({"log_floor_db": floor_db})
    counts = (20.0 * np.log10(envelope()) - floor_db) / 0.5
    expected = np.clip(counts, 0.0, LARGEST[sample])
    rounding = 1e-3 if sample == "float32" else 0.501
    np.testing.assert_allclose(digitised(sample, "logarithmic", radar), expected, atol=rounding)
    assert (counts < 0.0).any()


def test_eight_bits_of_steps_too_small_saturate():
    video = digitised("uint8", "logarithmic", RADAR.changed({"db_per_count": 0.1}))
    assert video.max() == 255
    assert np.count_nonzero(video == 255) > 100


@pytest.mark.parametrize("sample", SAMPLES)
def test_the_extractor_undoes_the_logarithm(sample):
    expanded = expansion("logarithmic", RADAR.db_per_count)(digitised(sample, "logarithmic"))
    error_db = 20.0 * np.log10(expanded / envelope()) + RADAR.log_floor_db
    above = 20.0 * np.log10(envelope()) > RADAR.log_floor_db
    assert np.abs(error_db[above]).max() <= 0.251
    assert VIDEO_LAWS == EXTRACTOR_LAWS
    assert ExtractorParameters().db_per_count == Radar().db_per_count
