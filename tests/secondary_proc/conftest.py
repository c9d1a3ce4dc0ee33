# SPDX-License-Identifier: Apache-2.0
"""Made-up plots: targets on straight lines seen by a rotating antenna, false plots, messages by sector."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import pytest

from radar_common.tables import NANOSECONDS, PLOT, Table
from secondary_proc.parameters import TrackerParameters
from secondary_proc.tracker import Tracker

TWO_PI = 2.0 * np.pi
START = 1_700_000_000 * NANOSECONDS
RANGE_STD = 20.0
AZIMUTH_STD = 0.002


def plot_rows(distance, azimuth, time_offset, *, range_std=RANGE_STD, azimuth_std=AZIMUTH_STD):
    rows = np.zeros(len(np.atleast_1d(distance)), PLOT)
    rows["range"], rows["azimuth"], rows["time_offset"] = distance, azimuth, time_offset
    rows["range_std"], rows["azimuth_std"] = range_std, azimuth_std
    rows["snr_db"] = 20.0
    rows["radial_speed"] = rows["radial_speed_std"] = np.nan
    return rows


@dataclass
class Scene:
    """Plots of straight flights, one a turn and target, each at the moment the beam passes."""

    seed: int = 0
    period: float = 4.0
    sense: float = 1.0
    noise: float = 1.0
    detection: float = 1.0
    times: list = field(default_factory=list)
    distances: list = field(default_factory=list)
    azimuths: list = field(default_factory=list)
    truths: list = field(default_factory=list)

    def __post_init__(self):
        self.random = np.random.default_rng(self.seed)

    def fly(self, position, velocity, begin=0.0, end=80.0):
        position, velocity = np.asarray(position, float), np.asarray(velocity, float)
        label = len(self.truths) + 1
        self.truths.append((position, velocity))
        time = begin
        while True:
            # The beam meets the target where both azimuths agree: a few steps of a fixed point.
            for _ in range(20):
                x, y = position + velocity * time
                ahead = self.sense * np.arctan2(x, y) / TWO_PI - time / self.period
                time += self.period * (ahead - np.rint(ahead))
            if time > end:
                return label
            x, y = position + velocity * time
            if time >= begin and self.random.random() < self.detection:
                self.add(time, np.hypot(x, y), np.arctan2(x, y))
            time += self.period

    def add(self, time, distance, azimuth):
        self.times.append(time)
        self.distances.append(distance + self.noise * RANGE_STD * self.random.standard_normal())
        self.azimuths.append(
            np.mod(azimuth + self.noise * AZIMUTH_STD * self.random.standard_normal(), TWO_PI)
        )

    def clutter(self, per_scan, begin=0.0, end=80.0, nearest=1e3, farthest=100e3):
        count = self.random.poisson(per_scan * (end - begin) / self.period)
        time = self.random.uniform(begin, end, count)
        self.times += list(time)
        self.distances += list(self.random.uniform(nearest, farthest, count))
        self.azimuths += list(np.mod(self.sense * TWO_PI * time / self.period, TWO_PI))

    def messages(self, sectors=32, end=None):
        times = np.array(self.times)
        order = np.argsort(times, kind="stable")
        times = times[order]
        rows = plot_rows(np.array(self.distances)[order], np.array(self.azimuths)[order], 0.0)
        step = self.period / sectors
        end = end if end is not None else times.max() + 2 * step
        edges = np.arange(0.0, end + step, step)
        cuts = np.searchsorted(times, edges)
        for edge, first, last in zip(edges[:-1], cuts[:-1], cuts[1:], strict=True):
            part = rows[first:last].copy()
            part["time_offset"] = times[first:last] - edge
            yield Table(START + round(edge * NANOSECONDS), part)


def run_tracker(tracker, messages, *, flush=True):
    """All rows that the tracker publishes, with their times since START."""
    tables = [tracker.process(message) for message in messages]
    if flush:
        tables.append(tracker.flush())
    rows = np.concatenate([table.rows for table in tables])
    times = np.concatenate(
        [(t.stamp - START) / NANOSECONDS + t.rows["time_offset"] for t in tables]
    )
    return rows, times


@pytest.fixture(scope="session")
def scene():
    return Scene


@pytest.fixture(scope="session")
def run():
    return run_tracker


@pytest.fixture(scope="session")
def make_plots():
    return plot_rows


@pytest.fixture(scope="session")
def start():
    return START


@pytest.fixture
def tracker():
    return Tracker(TrackerParameters())
