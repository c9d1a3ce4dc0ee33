# SPDX-License-Identifier: Apache-2.0
"""Video with known noise and targets, cut into sectors, and what an extractor makes of it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
import pytest

from primary_proc.calculators.pulse.burst_shape import burst_shape, pulses_in_burst
from primary_proc.calculators.pulse.single_pulse import steady_probability, threshold_for
from primary_proc.parameters import ExtractorParameters
from primary_proc.plot_extractor import PlotExtractor
from radar_common.health import Health
from radar_common.tables import NANOSECONDS, PLOT, Table, sweep_dtype

START = 1_700_000_000 * NANOSECONDS
PULSE_INTERVAL = 1e-3


@dataclass(frozen=True)
class Scene:
    """A radar's video over some pulses, one after the other from a first azimuth."""

    video: np.ndarray
    pulses_per_scan: int
    first_azimuth: float = 0.0
    range_start: float = 500.0
    range_step: float = 100.0

    @property
    def step(self):
        return 2 * np.pi / self.pulses_per_scan

    def rows(self, kind=np.float32):
        pulses, cells = self.video.shape
        rows = np.zeros(pulses, sweep_dtype(cells, kind))
        rows["azimuth"] = (self.first_azimuth + np.arange(pulses) * self.step) % (2 * np.pi)
        rows["range_start"], rows["range_step"] = self.range_start, self.range_step
        rows["video"] = self.video
        return rows

    def sectors(self, *cuts, kind=np.float32):
        """Cut into messages at the given pulses; each is stamped with its first pulse."""
        rows = self.rows(kind)
        bounds = [0, *cuts, len(rows)]
        return [sector(rows[begin:end], begin) for begin, end in pairwise(bounds)]

    def rotated(self, angle):
        return replace(self, first_azimuth=self.first_azimuth + angle)


def sector(rows, first):
    rows = rows.copy()
    rows["time_offset"] = np.arange(len(rows)) * PULSE_INTERVAL
    return Table(START + round(first * PULSE_INTERVAL * NANOSECONDS), rows)


def every(size, scene):
    return range(size, len(scene.video), size)


@pytest.fixture
def cut():
    return every


@pytest.fixture
def scene():
    """Make a scene: noise of a sigma, and targets (pulse, cell, rms amplitude over sigma), places with fractions."""

    def make(
        seed,
        pulses,
        cells,
        targets=(),
        *,
        sigma=0.02,
        pulses_per_scan=1024,
        pattern="gaussian",
        beamwidth_deg=3.0,
        fast=False,
    ):
        rng = np.random.default_rng(seed)
        field = rng.standard_normal((pulses, cells)) + 1j * rng.standard_normal((pulses, cells))
        in_burst = pulses_in_burst(pattern, np.radians(beamwidth_deg), 2 * np.pi / pulses_per_scan)
        for pulse, cell, amplitude in targets:
            middle = round(pulse)
            shape = burst_shape(pattern, in_burst, pulse - middle, book=False)
            rows = middle + np.arange(len(shape)) - len(shape) // 2
            seen = (rows >= 0) & (rows < pulses)
            # A pulse as long as a cell, after its matched filter: the echo falls off over one cell to both sides.
            columns = np.arange(max(int(cell) - 1, 0), min(int(cell) + 2, cells))
            echo = np.maximum(1.0 - np.abs(columns + 0.5 - cell), 0.0)
            voltage = np.full(len(rows), np.exp(2j * np.pi * rng.random()))
            if fast:
                voltage = (rng.standard_normal((len(rows), 2)) @ [1.0, 1j]) / np.sqrt(2.0)
            field[np.ix_(rows[seen], columns)] += amplitude * np.outer(
                (voltage * shape)[seen], echo
            )
        return Scene((sigma * np.abs(field)).astype(np.float32), pulses_per_scan)

    return make


@pytest.fixture
def extract():
    """Run sectors through a new extractor; give all plots with absolute times, and the health."""

    def run(sectors, **parameters):
        health = Health()
        extractor = PlotExtractor(
            ExtractorParameters(**({"beamwidth_deg": 3.0} | parameters)), health
        )
        tables = [extractor.process(table) for table in sectors] + [extractor.flush()]
        plots = np.concatenate([table.rows for table in tables])
        assert plots.dtype == PLOT
        plots["time_offset"] = np.concatenate(
            [(t.stamp - START) / NANOSECONDS + t.rows["time_offset"] for t in tables]
        )
        return plots[np.lexsort((plots["range"], plots["time_offset"]))], health

    return run


@pytest.fixture
def ones_of_a_burst():
    """Probability of a one on each pulse of a steady target in a sinc2 beam."""

    def make(noise, amplitude, pulses=11):
        shape = burst_shape("sinc2", pulses)
        return steady_probability(threshold_for(noise), np.multiply.outer(amplitude, shape))

    return make


@pytest.fixture(scope="session")
def packed():
    """Pack bits of shape (pulses, rings) as the binary quantiser does."""

    def pack(bits):
        wide = np.zeros((len(bits), -(-bits.shape[1] // 64) * 64), bool)
        wide[:, : bits.shape[1]] = bits
        return np.packbits(wide.reshape(-1)).view(np.uint64).reshape(len(bits), -1)

    return pack
