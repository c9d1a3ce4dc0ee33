# SPDX-License-Identifier: Apache-2.0
"""The whole extraction chain against scipy's moving-average CFAR alone, one scan of 4096 pulses of 1024 cells."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.ndimage import uniform_filter1d

from primary_proc.automata.program import Program
from primary_proc.detectors.program_detector import ProgramDetector
from primary_proc.normalisers.cell_averaging import CellAveraging
from primary_proc.parameters import ExtractorParameters
from primary_proc.plot_extractor import PlotExtractor
from primary_proc.quantisers.binary_quantiser import BinaryQuantiser
from radar_common.health import Health
from radar_common.tables import NANOSECONDS, Table, sweep_dtype

PULSES, CELLS, SECTOR = 4096, 1024, 128
SCAN_PERIOD = 4.0
TARGETS = 200
PARAMETERS = ExtractorParameters()
BEST = {}


@pytest.fixture(scope="module")
def video():
    rng = np.random.default_rng(1)
    video = rng.rayleigh(0.02, (PULSES, CELLS)).astype(np.float32)
    for pulse, cell in zip(
        rng.integers(20, PULSES - 20, TARGETS), rng.integers(0, CELLS, TARGETS), strict=True
    ):
        video[pulse - 9 : pulse + 10, cell] += 0.2
    return video


@pytest.fixture(scope="module")
def sectors(video):
    """One scan; a run takes the times on, so that the stream never ends."""
    rows = np.zeros(PULSES, sweep_dtype(CELLS))
    rows["video"] = video
    rows["azimuth"] = np.arange(PULSES) * (2 * np.pi / PULSES)
    rows["range_step"] = 108.0
    rows["time_offset"] = np.arange(PULSES) % SECTOR * (SCAN_PERIOD / PULSES)
    return np.split(rows, PULSES // SECTOR)


def moving_average_cfar(video):
    """Cell averaging as one writes it with scipy: window less guard cells, compared with the cell."""
    power = video * video
    reference, guard = PARAMETERS.reference_cells, PARAMETERS.guard_cells
    wide, narrow = 2 * (reference + guard) + 1, 2 * guard + 1
    window = uniform_filter1d(power, wide, axis=1, mode="constant") * wide
    inner = uniform_filter1d(power, narrow, axis=1, mode="constant") * narrow
    return power > 0.15 * (window - inner)


def run(benchmark, name, function):
    benchmark.group = "primary processing of one scan"
    result = benchmark.pedantic(function, rounds=9, warmup_rounds=1)
    BEST[name] = benchmark.stats.stats.min
    return result


def test_peer_cfar_alone(benchmark, video):
    assert run(benchmark, "peer", lambda: moving_average_cfar(video)).any()


def test_whole_chain(benchmark, sectors, ratio):
    extractor = PlotExtractor(PARAMETERS, Health())
    turns = iter(range(1000))

    def turn():
        start = next(turns) * SCAN_PERIOD
        return sum(
            len(extractor.process(_sector(rows, start, number)).rows)
            for number, rows in enumerate(sectors)
        )

    assert run(benchmark, "chain", turn) > TARGETS * 0.8
    ratio(
        "extraction chain / scipy CFAR alone", BEST["peer"] / BEST["chain"], "times faster, 1 core"
    )
    ratio("extraction chain / real time", SCAN_PERIOD / BEST["chain"], "scans of 4 s in 4 s")
    ratio("cells a second", PULSES * CELLS / BEST["chain"], "1/s")


@pytest.mark.parametrize("stage", ["normalise", "quantise", "detect"])
def test_share_of_a_stage(benchmark, video, ratio, stage):
    """What is left of the chain is checking, merging and estimation."""
    normaliser = CellAveraging(CELLS, PARAMETERS.reference_cells, PARAMETERS.guard_cells)
    quantiser = BinaryQuantiser(normaliser.threshold(0.01))
    detector = ProgramDetector(Program(3, 4, 2), CELLS, 100)
    blocks = np.split(video, PULSES // SECTOR)
    azimuth = np.zeros(SECTOR)
    ratios = [np.empty((SECTOR, CELLS), np.float32) for _ in blocks]
    for block, out in zip(blocks, ratios, strict=True):
        normaliser.ratios(block, azimuth, out)
    words = [quantiser.quantise(out) for out in ratios]
    work = {
        "normalise": lambda: [normaliser.ratios(block, azimuth, ratios[0]) for block in blocks],
        "quantise": lambda: [quantiser.quantise(ratios[0]) for _ in blocks],
        "detect": lambda: [detector.detect(bits, n * SECTOR) for n, bits in enumerate(words)],
    }
    run(benchmark, stage, work[stage])
    ratio(f"share of the chain: {stage}", BEST[stage] / BEST["chain"], "of 1")


def _sector(rows, start, number):
    stamp = start + number * SECTOR * SCAN_PERIOD / PULSES
    return Table(round(stamp * NANOSECONDS), rows)
