# SPDX-License-Identifier: Apache-2.0
"""Normalisers: exact against plain definitions, and their threshold holds its probability in every cell."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad
from scipy.stats import binom

from primary_proc.choices import NORMALISERS
from primary_proc.normalisers.cell_averaging import CellAveraging
from primary_proc.parameters import ExtractorParameters
from primary_proc.quantisers.binary_quantiser import BinaryQuantiser, unpack_cells

CONFIDENCE = 0.999


def ratios(normaliser, video):
    out = np.empty(video.shape, np.float32)
    bad = normaliser.ratios(video, np.zeros(len(video)), out)
    return out, bad


def plain_ratios(video, reference, guard):
    """Definition of cell averaging, cell by cell."""
    power = video.astype(float) ** 2
    cells = power.shape[1]
    expected = np.empty_like(power)
    for cell in range(cells):
        window = [
            c
            for distance in range(guard + 1, guard + reference + 1)
            for c in (cell - distance, cell + distance)
            if 0 <= c < cells
        ]
        expected[:, cell] = power[:, cell] / power[:, window].sum(axis=1)
    return expected


def each_normaliser(cells, sigma):
    """All normalisers by name, set up for noise of a sigma (whose envelope has the rms sqrt(2) sigma)."""
    for name, make in NORMALISERS.items():
        level = float(np.sqrt(2.0) * sigma)
        yield name, make(ExtractorParameters(normaliser=name, noise_level=level), cells)


@settings(deadline=None, max_examples=40)
@given(
    cells=st.integers(12, 90),
    reference=st.integers(2, 40),
    guard=st.integers(0, 5),
    pulses=st.integers(1, 9),
    seed=st.integers(0, 1000),
)
def test_cell_averaging_is_its_definition(cells, reference, guard, pulses, seed):
    video = np.random.default_rng(seed).rayleigh(0.3, (pulses, cells)).astype(np.float32)
    found, bad = ratios(CellAveraging(cells, reference, guard), video)
    assert bad == 0
    assert found == pytest.approx(plain_ratios(video, reference, guard), rel=1e-5)


def test_ratios_do_not_depend_on_how_pulses_are_grouped():
    video = np.random.default_rng(1).rayleigh(0.3, (300, 700)).astype(np.float32)
    whole, _ = ratios(CellAveraging(700, 16, 2), video)
    normaliser = CellAveraging(700, 16, 2)
    parts = [ratios(normaliser, part)[0] for part in np.split(video, [1, 8, 9, 150])]
    assert np.array_equal(np.concatenate(parts), whole)


@pytest.mark.parametrize("probability", [0.01, 0.1])
@pytest.mark.parametrize("name", NORMALISERS)
def test_noise_exceeds_the_threshold_with_its_probability_in_every_part_of_the_range(
    name, probability
):
    pulses, cells, sigma = 20_000, 60, 0.37
    video = np.random.default_rng(3).rayleigh(sigma, (pulses, cells)).astype(np.float32)
    normaliser = dict(each_normaliser(cells, sigma))[name]
    found, _ = ratios(normaliser, video)
    ones = (found > normaliser.threshold(probability).astype(np.float32)).sum(axis=0)
    # One bound for all cells together, and one for each cell with a chance shared between the cells.
    confidence = 1.0 - (1.0 - CONFIDENCE) / cells
    low, high = binom.interval(confidence, pulses, probability)
    assert ((ones >= low) & (ones <= high)).all(), (
        "also where the window is cut by the range's ends"
    )


@pytest.mark.parametrize("name", NORMALISERS)
def test_exceedance_inverts_the_threshold(name):
    normaliser = dict(each_normaliser(50, 1.0))[name]
    for probability in (0.3, 1e-3, 1e-9):
        found = normaliser.exceedance(normaliser.threshold(probability), np.arange(50))
        assert found == pytest.approx(np.full(50, probability))


@pytest.mark.parametrize("name", NORMALISERS)
@pytest.mark.parametrize("kind", [np.float32, np.uint16, np.uint8])
def test_noise_scale_makes_the_mean_noise_power_one(name, kind):
    sigma = 12.0
    video = np.rint(np.random.default_rng(5).rayleigh(sigma, (4000, 64))).astype(kind)
    normaliser = dict(each_normaliser(64, sigma))[name]
    found, _ = ratios(normaliser, video)
    power = found * normaliser.noise_scale
    middle = np.array([32])
    # The mean of a variable is the integral of its exceedance: here the mean of one over the noise level, times one.
    mean = quad(lambda ratio: normaliser.exceedance([ratio], middle)[0], 0.0, np.inf)[0]
    expected = mean * normaliser.noise_scale[32]
    assert expected == pytest.approx(1.0, abs=0.15)
    assert power[:, 20:44].mean() == pytest.approx(expected, abs=6 / np.sqrt(4000 * 24))


@pytest.mark.parametrize("name", NORMALISERS)
def test_samples_that_are_not_finite_count_as_zero(name):
    video = np.random.default_rng(7).rayleigh(1.0, (20, 80)).astype(np.float32)
    clean = video.copy()
    for pulse, cell, value in [(3, 5, np.nan), (3, 40, np.inf), (11, 79, -np.inf), (12, 0, 1e30)]:
        video[pulse, cell], clean[pulse, cell] = value, 0.0
    normaliser = dict(each_normaliser(80, 1.0))[name]
    found, bad = ratios(normaliser, video)
    expected, none = ratios(normaliser, clean)
    assert (bad, none) == (4, 0)
    assert np.array_equal(found, expected)


@pytest.mark.parametrize("name", NORMALISERS)
def test_silence_gives_no_ones(name):
    normaliser = dict(each_normaliser(80, 1.0))[name]
    found, bad = ratios(normaliser, np.zeros((5, 80), np.float32))
    quantiser = BinaryQuantiser(normaliser.threshold(0.01))
    assert bad == 0
    assert not quantiser.quantise(found).any()


def test_cell_averaging_loss_is_the_published_one():
    """Multipliers of the reference file, where it stands beside the repository."""
    normaliser = CellAveraging(1000, 8, 1)
    # N = 16, P_fa = 1e-4: T / N = P^(-1/N) - 1.
    assert normaliser.threshold(1e-4)[500] * 16 == pytest.approx(16 * (1e-4 ** (-1 / 16) - 1))
    assert normaliser.threshold(1e-4)[500] * 16 == pytest.approx(12.4525, abs=1e-3)


def test_a_range_too_short_is_refused():
    with pytest.raises(ValueError, match="reference"):
        CellAveraging(9, 16, 4)


@pytest.mark.parametrize("cells", [1, 63, 64, 65, 200])
def test_bits_are_packed_and_unpacked(cells):
    rng = np.random.default_rng(9)
    found = rng.random((7, cells)).astype(np.float32)
    quantiser = BinaryQuantiser(np.full(cells, 0.6))
    words = quantiser.quantise(found)
    assert words.dtype == np.uint64
    assert words.shape == (7, -(-cells // 64))
    assert quantiser.ones == (found > np.float32(0.6)).sum()
    assert np.array_equal(unpack_cells(words, np.arange(cells)), found > np.float32(0.6))


def test_a_ratio_that_is_no_number_is_a_zero():
    assert not BinaryQuantiser([0.5]).quantise(np.full((3, 1), np.nan, np.float32)).any()
