# SPDX-License-Identifier: Apache-2.0
"""Binary detectors alone on one scan of 4096 pulses of 1024 cells: by the table of their automaton, and in parallel."""

from __future__ import annotations

import numpy as np
import pytest

from primary_proc.automata.accumulator import Accumulator
from primary_proc.automata.program import Program
from primary_proc.automata.sequential_rule import SequentialTest
from primary_proc.detectors.program_detector import ProgramDetector
from primary_proc.detectors.table_detector import TableDetector

PULSES, CELLS, SECTOR = 4096, 1024, 128
SCAN_PERIOD = 4.0
DETECTORS = {
    "3/4-2, 64 rings an operation": (ProgramDetector, Program(3, 4, 2)),
    "3/5-3, 64 rings an operation": (ProgramDetector, Program.parse("3/5-3")),
    "3/4-2 by its table": (TableDetector, Program(3, 4, 2)),
    "accumulator by its table": (TableDetector, Accumulator(6, 2, from_first_one=True)),
    "sequential test by its table": (TableDetector, SequentialTest(13, 3, 62, 13, 20)),
}


@pytest.fixture(scope="module")
def sectors():
    rng = np.random.default_rng(1)
    bits = rng.random((PULSES, CELLS)) < 0.02
    for pulse, cell in zip(
        rng.integers(20, PULSES - 20, 200), rng.integers(0, CELLS, 200), strict=True
    ):
        bits[pulse - 9 : pulse + 10, cell] = True
    return [part.view(np.uint64) for part in np.split(np.packbits(bits, axis=1), PULSES // SECTOR)]


@pytest.mark.parametrize("name", DETECTORS)
def test_detector(benchmark, sectors, ratio, name):
    kind, rule = DETECTORS[name]
    detector = kind(rule, CELLS, 100)
    benchmark.group = "binary detectors, one scan"

    def turn():
        detector.reset()
        return sum(len(detector.detect(words, n * SECTOR)) for n, words in enumerate(sectors))

    assert benchmark.pedantic(turn, rounds=5, warmup_rounds=1) >= 190
    ratio(f"{name} / real time", SCAN_PERIOD / benchmark.stats.stats.min, "scans of 4 s in 4 s")
