# SPDX-License-Identifier: Apache-2.0
"""The whole extraction chain against scipy's moving-average CFAR alone, one scan of 4096 pulses of 1024 cells."""

from __future__ import annotations

from time import perf_counter

import numpy as np
import pytest
from scipy.ndimage import uniform_filter1d

from primary_proc import extraction_chain
from primary_proc.detectors.program_detector import ProgramDetector
from primary_proc.normalisers.cell_averaging import CellAveraging
from primary_proc.parameters import ExtractorParameters
from primary_proc.plot_extractor import PlotExtractor
from primary_proc.plots.power_meter import PowerMeter
from primary_proc.plots.ring_merge import RingMerger
from primary_proc.quantisers.binary_quantiser import BinaryQuantiser
from primary_proc.stream.sweep_stream import SweepStream
from radar_common.health import Health
from radar_common.tables import NANOSECONDS, Table, sweep_dtype

PULSES, CELLS, SECTOR = 4096, 1024, 128
SCAN_PERIOD = 4.0
TARGETS = 200
PARAMETERS = ExtractorParameters()
BEST = {}
STAGES = {
    "order": (SweepStream, "take"),
    "normalise": (CellAveraging, "ratios"),
    "quantise": (BinaryQuantiser, "quantise"),
    "detect": (ProgramDetector, "detect"),
    "measure": (PowerMeter, "measure"),
    "merge": (RingMerger, "add"),
    "form plots": (extraction_chain, "form_plots"),
}


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


def test_share_of_each_stage(sectors, ratio, monkeypatch):
    """Where the time of the chain itself goes; what is left are the steps between the stages, and counting."""
    spent = dict.fromkeys(STAGES, 0.0)
    for stage, (owner, name) in STAGES.items():
        monkeypatch.setattr(owner, name, _timed(getattr(owner, name), stage, spent))
    extractor = PlotExtractor(PARAMETERS, Health())
    best = None
    for turn in range(12):
        spent.update(dict.fromkeys(STAGES, 0.0))
        begin = perf_counter()
        for number, rows in enumerate(sectors):
            extractor.process(_sector(rows, turn * SCAN_PERIOD, number))
        whole = perf_counter() - begin
        if turn and (best is None or whole < best[0]):
            best = whole, dict(spent)
    whole, spent = best
    assert 0.0 < sum(spent.values()) < whole
    for stage, seconds in spent.items():
        ratio(f"share of the chain: {stage}", seconds / whole, "of 1")
    ratio("share of the chain: rest", 1.0 - sum(spent.values()) / whole, "of 1")


def _timed(function, stage, spent):
    def timed(*arguments):
        begin = perf_counter()
        result = function(*arguments)
        spent[stage] += perf_counter() - begin
        return result

    return timed


def _sector(rows, start, number):
    stamp = start + number * SECTOR * SCAN_PERIOD / PULSES
    return Table(round(stamp * NANOSECONDS), rows)
