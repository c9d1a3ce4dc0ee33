# SPDX-License-Identifier: Apache-2.0
"""Logarithmic video gives the plots of linear video, but for the rounding of its counts."""

from __future__ import annotations

import numpy as np
import pytest

from primary_proc.stream.video_law import expansion

STEP_DB = 0.4
ZERO_DB = -20.0
SIGMA = 0.02


def compressed(video, kind, step_db=STEP_DB):
    counts = 20.0 * np.log10(np.maximum(video / SIGMA, 1e-9)) - ZERO_DB
    counts = np.maximum(counts / step_db, 0.0)
    if kind != np.float32:
        counts = np.minimum(np.rint(counts), np.iinfo(kind).max)
    return counts.astype(kind)


@pytest.mark.parametrize(
    ("kind", "step_db"), [(np.uint8, 0.4), (np.uint16, 0.01), (np.float32, 1.0)]
)
def test_expansion_is_the_inverse_within_half_a_count(kind, step_db):
    video = np.geomspace(0.2 * SIGMA, 1e3 * SIGMA, 1000)
    envelope = expansion("logarithmic", step_db)(compressed(video, kind, step_db))
    assert envelope.dtype == np.float32
    error_db = 20.0 * np.log10(envelope / (video / SIGMA)) + ZERO_DB
    rounding = 1e-4 if kind == np.float32 else step_db / 2.0 + 1e-4
    assert np.abs(error_db).max() <= rounding


def test_linear_video_is_not_touched():
    video = np.arange(12, dtype=np.uint8).reshape(3, 4)
    assert expansion("linear", STEP_DB)(video) is video


@pytest.mark.parametrize("kind", [np.uint8, np.uint16])
@pytest.mark.parametrize("step_db", [1e-3, 10.0])
def test_every_code_has_an_envelope_whose_square_is_finite(kind, step_db):
    codes = np.arange(np.iinfo(kind).max + 1).astype(kind)
    envelope = expansion("logarithmic", step_db)(codes)
    assert np.isfinite(np.square(envelope)).all()
    assert np.all(np.diff(envelope) >= 0.0)
    assert envelope[0] == 1.0


def test_float_samples_that_are_no_numbers_stay_visible_as_such():
    envelope = expansion("logarithmic", 1.0)(np.array([np.nan, np.inf, -np.inf], np.float32))
    np.testing.assert_array_equal(envelope, np.array([np.nan, np.inf, 0.0], np.float32))


@pytest.mark.parametrize("kind", [np.uint8, np.uint16, np.float32])
def test_plots_of_logarithmic_video_are_those_of_linear_video(scene, extract, cut, kind):
    places = [(pulse, cell, 14.0) for pulse in range(60, 1000, 90) for cell in range(20, 240, 40)]
    made = scene(3, 1024, 256, places, sigma=SIGMA)
    step_db = STEP_DB if kind == np.uint8 else 0.01
    linear, _ = extract(made.sectors(*cut(64, made)), false_plots_per_scan=0.01)
    logarithmic = type(made)(compressed(made.video, kind, step_db), made.pulses_per_scan)
    plots, _ = extract(
        logarithmic.sectors(*cut(64, made), kind=kind),
        false_plots_per_scan=0.01,
        video_law="logarithmic",
        db_per_count=step_db,
    )
    assert len(plots) == len(linear) == len(places)
    linear, plots = (
        table[np.lexsort((table["azimuth"], np.rint(table["range"] / 10.0 / made.range_step)))]
        for table in (linear, plots)
    )
    # An envelope off by half a count moves the edge of a burst, at most, to the next pulse.
    azimuth_step = 2.0 * np.pi / made.pulses_per_scan
    assert np.abs(plots["azimuth"] - linear["azimuth"]).max() < 1.1 * azimuth_step
    assert np.abs(plots["snr_db"] - linear["snr_db"]).max() < step_db
    np.testing.assert_allclose(plots["range"], linear["range"], atol=0.05 * made.range_step)
