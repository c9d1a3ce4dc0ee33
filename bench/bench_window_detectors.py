# SPDX-License-Identifier: Apache-2.0
"""Every sliding-window detector in the whole chain against real time: 4096 pulses of 1024 cells in 4 s, one core."""

from __future__ import annotations

import numpy as np
import pytest

from primary_proc.methods.window_methods import WINDOW_METHODS
from primary_proc.parameters import ExtractorParameters
from primary_proc.plot_extractor import PlotExtractor
from radar_common.tables import NANOSECONDS, Table, sweep_dtype

PULSES, CELLS, SECTOR = 4096, 1024, 128
PERIOD = 4.0
ROUNDS = 3


@pytest.fixture(scope="module")
def sectors():
    rng = np.random.default_rng(1)
    rows = np.zeros(PULSES, sweep_dtype(CELLS))
    rows["video"] = rng.rayleigh(0.02, (PULSES, CELLS))
    rows["azimuth"] = np.arange(PULSES) * (2 * np.pi / PULSES)
    rows["range_step"] = 108.0
    rows["time_offset"] = np.arange(PULSES) % SECTOR * (PERIOD / PULSES)
    return np.split(rows, PULSES // SECTOR)


@pytest.mark.benchmark(group="sliding windows, one scan")
@pytest.mark.parametrize("detector", WINDOW_METHODS)
def test_window_detector(benchmark, ratio, sectors, detector):
    extractor = PlotExtractor(ExtractorParameters(detector=detector))
    sector_time = round(PERIOD * NANOSECONDS * SECTOR / PULSES)
    done = 0

    def one_scan():
        nonlocal done
        for part in sectors:
            extractor.process(Table(done * sector_time, part))
            done += 1

    # The first scan also makes the design.
    benchmark.pedantic(one_scan, rounds=ROUNDS, warmup_rounds=1)
    spare = PERIOD / benchmark.stats.stats.min
    ratio(f"chain with {detector}", spare, "times real time, goal 10")
