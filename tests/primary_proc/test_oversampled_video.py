# SPDX-License-Identifier: Apache-2.0
"""What the extractor makes of video with several samples in a pulse: how often noise passes, and what becomes of it."""

from __future__ import annotations

import numpy as np
import pytest

from primary_proc.calculators.cfar.correlated_reference import (
    averaging_exceedance,
    averaging_threshold,
    effective_reference_cells,
)
from primary_proc.normalisers.cell_averaging import CellAveraging
from primary_proc.parameters import ExtractorParameters
from primary_proc.plot_extractor import PlotExtractor
from radar_common.pulse_response import PULSE_RESPONSES
from radar_sim.radar import Radar
from radar_sim.scenario import Scenario
from radar_sim.simulator import Simulator

SIGMA = 0.02


def sweeps(samples, shape="rectangular", scans=1, seed=6, cells=256):
    radar = Radar(
        samples_per_pulse=samples,
        pulse_shape=shape,
        cells=cells,
        range_step=100.0,
        noise_level=SIGMA,
    )
    for sector in Simulator(Scenario(radar), seed=seed, scans=scans, sectors=8):
        yield sector.sweeps


def false_plots(samples, wanted, **parameters):
    extractor = PlotExtractor(ExtractorParameters(false_plots_per_scan=wanted, **parameters))
    tables = [extractor.process(table) for table in sweeps(samples, scans=2)]
    return (sum(len(table.rows) for table in tables) + len(extractor.flush().rows)) / 2.0


def test_independent_cells_count_in_full():
    assert effective_reference_cells(16, 1, PULSE_RESPONSES["rectangular"]) == pytest.approx(32.0)
    counts = [effective_reference_cells(16, s, PULSE_RESPONSES["gaussian"]) for s in (1, 2, 4, 8)]
    assert np.all(np.diff(counts) < 0.0)
    assert averaging_exceedance(averaging_threshold(0.01, 12.3), 12.3) == pytest.approx(0.01)


@pytest.mark.parametrize(
    ("samples", "shape"),
    [(1, "rectangular"), (2, "rectangular"), (4, "rectangular"), (4, "gaussian")],
)
def test_correlated_reference_cells_raise_the_probability_of_a_one_as_computed(samples, shape):
    probability, reference, guard = 0.02, 16, 2 * samples
    normaliser = CellAveraging(256, reference, guard)
    whole = slice(guard + reference, 256 - guard - reference)
    threshold = normaliser.threshold(probability)
    ones = cells = 0
    for table in sweeps(samples, shape):
        video = table.rows["video"]
        ratios = np.empty(video.shape, np.float32)
        normaliser.ratios(video, np.zeros(len(video)), ratios)
        ones += np.count_nonzero((ratios > threshold)[:, whole])
        cells += ratios[:, whole].size
    effective = effective_reference_cells(reference, samples, PULSE_RESPONSES[shape])
    expected = averaging_exceedance(averaging_threshold(probability, 2.0 * reference), effective)
    # Independent samples are as many times fewer; the gamma law is within 3 % down to eight effective cells.
    scatter = 4.0 * np.sqrt(2.0 * samples / (cells * probability))
    assert ones / cells == pytest.approx(float(expected), rel=0.03 + scatter)


@pytest.mark.parametrize("samples", [1, 4])
def test_with_a_known_level_the_rate_of_false_plots_holds(samples):
    found = false_plots(samples, 60.0, normaliser="fixed-level", noise_level=SIGMA * np.sqrt(2.0))
    # Plots of neighbouring cells are not independent: as if there were four times fewer.
    assert found == pytest.approx(60.0, abs=3.3 * np.sqrt(60.0 * samples / 2.0))


def test_cell_averaging_makes_more_false_plots_than_wanted_until_its_window_grows_with_the_pulse():
    short = false_plots(4, 60.0, guard_cells=8)
    long = false_plots(4, 60.0, guard_cells=8, reference_cells=64)
    assert short > 1.6 * 60.0
    assert long < 0.8 * short
