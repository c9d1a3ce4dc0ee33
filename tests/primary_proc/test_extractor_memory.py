# SPDX-License-Identifier: Apache-2.0
"""The extractor remembers about a sector, however long it runs and however many sectors a turn has."""

from __future__ import annotations

import tracemalloc

import numpy as np

from primary_proc.parameters import ExtractorParameters
from primary_proc.plot_extractor import PlotExtractor
from radar_common.health import Health
from radar_common.tables import Table

SCAN = 1024


def test_memory_is_that_of_a_sector(scene, cut):
    made = scene(9, 2 * SCAN, 128, [(p, 60.5, 12.0) for p in range(50, 2000, 70)])
    extractor = PlotExtractor(ExtractorParameters(beamwidth_deg=3.0), Health())
    for table in made.sectors(*cut(16, made)):
        extractor.process(table)
        chain = extractor._chain
        assert chain is None or len(chain._log._azimuth) < 200
        assert chain is None or len(chain._history.ratios) < 200


def test_memory_grows_neither_with_time_nor_with_the_pulses_of_a_scan(scene):
    """What a long run holds, and the most it ever held, is what the first turn needed."""
    peaks = {}
    for pulses_per_scan in (512, 1024):
        made = scene(13, 512, 256, [(p, 60.5, 12.0) for p in range(50, 500, 90)])
        sectors = np.split(made.rows(), 8)
        extractor = PlotExtractor(
            ExtractorParameters(beamwidth_deg=3.0 * 1024 / pulses_per_scan), Health()
        )

        def turn(first, extractor=extractor, sectors=sectors, pulses_per_scan=pulses_per_scan):
            for number in range(first, first + pulses_per_scan // 64):
                pulse = number * 64 + np.arange(64)
                rows = sectors[number % 8]
                rows["azimuth"] = pulse * (2 * np.pi / pulses_per_scan) % (2 * np.pi)
                rows["time_offset"] = np.arange(64) * 1e-3
                extractor.process(Table(number * 64 * 10**6, rows))

        turn(0)
        tracemalloc.start()
        start, _ = tracemalloc.get_traced_memory()
        for scan in range(1, 6):
            turn(scan * pulses_per_scan // 64)
        held, peak = tracemalloc.get_traced_memory()
        tracemalloc.stop()
        assert held - start < 100_000
        peaks[pulses_per_scan] = peak - start
    sector = 64 * 256 * 4
    assert max(peaks.values()) < 4 * sector
    assert peaks[1024] < 1.1 * peaks[512] + 10_000
