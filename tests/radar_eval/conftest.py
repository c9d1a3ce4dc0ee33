# SPDX-License-Identifier: Apache-2.0
"""A small world with known truth, as bags and tables, and the commands run in this process."""

from __future__ import annotations

import importlib
import io
import json
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np
import pytest

from radar_common.bag import BagWriter
from radar_common.frames import enu_from_polar, polar_from_enu
from radar_common.tables import (
    NANOSECONDS,
    PLOT,
    PLOTS_TOPIC,
    SITE_FRAME,
    TRACK,
    TRACKS_TOPIC,
    TRUTH,
    TRUTH_TOPIC,
    Table,
    TrackStatus,
)
from radar_eval.bag_tables import BagTables, TimedRows

PERIOD = 4.0
ORIGIN = 1_700_000_000 * NANOSECONDS


@pytest.fixture
def command():
    """Run a command by name: command("score", bag, "--json") gives its code, its output and its errors."""

    def run(name, *arguments):
        module = importlib.import_module(f"radar_eval.commands.{name}")
        out, err = io.StringIO(), io.StringIO()
        with redirect_stdout(out), redirect_stderr(err):
            code = module.main([str(argument) for argument in arguments])
        text = out.getvalue()
        return SimpleNamespace(
            code=code, out=text, err=err.getvalue(), json=lambda: json.loads(text)
        )

    return run


@pytest.fixture(scope="session")
def fixture_bags(repository):
    """Folder of the bags that are kept in the tree."""
    return repository / "tests" / "fixtures" / "bags"


@pytest.fixture(scope="session")
def tiny_parameters(tmp_path_factory):
    """Parameter file for the radar of the fixture bags, whose beam is ten degrees wide."""
    path = tmp_path_factory.mktemp("parameters") / "tiny.yaml"
    path.write_text(
        "plot_extractor:\n  ros__parameters:\n    beamwidth_deg: 10.0\n"
        "    false_plots_per_scan: 0.5\n",
        encoding="utf-8",
    )
    return path


@dataclass
class World:
    """Targets on straight lines under a steadily turning antenna, with perfect plots and one track each."""

    start: np.ndarray  # (targets, 2), m
    velocity: np.ndarray  # (targets, 2), m/s
    scans: int = 30

    def crossings(self):
        """Time of each pass over each target: (target, time), in order of time."""
        target, scan = np.divmod(np.arange(len(self.start) * self.scans), self.scans)
        time = np.full(len(target), 0.5 * PERIOD) + scan * PERIOD
        for _ in range(20):
            x, y = self.at(target, time).T
            azimuth = polar_from_enu(x, y)[1].reshape(-1, self.scans)
            # A target that goes back across north is passed twice in one turn of the antenna.
            azimuth = np.unwrap(azimuth, axis=1).ravel()
            time = (scan + azimuth / (2.0 * np.pi)) * PERIOD
        order = np.argsort(time, kind="stable")
        return target[order], time[order]

    def at(self, target, time):
        return self.start[target] + self.velocity[target] * np.asarray(time)[:, None]

    def truth(self):
        target, time = self.crossings()
        rows = np.zeros(len(target), TRUTH)
        rows["x"], rows["y"] = self.at(target, time).T
        rows["vx"], rows["vy"] = self.velocity[target].T
        rows["range"], rows["azimuth"] = polar_from_enu(*self.at(target, time).T)
        rows["id"] = target + 1
        return TimedRows(rows, time, 1)

    def plots(self, keep=None, range_error=0.0):
        target, time = self.crossings()
        keep = np.ones(len(target), bool) if keep is None else keep(target, time)
        rows = np.zeros(len(target), PLOT)
        rows["range"], rows["azimuth"] = polar_from_enu(*self.at(target, time).T)
        rows["range"] += range_error
        rows["range_std"], rows["azimuth_std"] = 20.0, 0.002
        rows["x"], rows["y"] = enu_from_polar(rows["range"], rows["azimuth"])
        return TimedRows(rows[keep], time[keep], 1)

    def tracks(self, plots, owner, *, confirm_after=3, lag=0.0):
        """One track a value of `owner`, which gives the track of each plot; negative for none."""
        kept = np.flatnonzero(owner >= 0)
        rows = np.zeros(len(kept), TRACK)
        rows["id"] = owner[kept] + 100
        rows["plot_range"] = plots.rows["range"][kept]
        rows["plot_azimuth"] = plots.rows["azimuth"][kept]
        rows["x"], rows["y"] = enu_from_polar(rows["plot_range"] + lag, rows["plot_azimuth"])
        for number in np.unique(rows["id"]):
            rows["hits"][rows["id"] == number] = 1 + np.arange(np.sum(rows["id"] == number))
        rows["status"] = np.where(
            rows["hits"] >= confirm_after, TrackStatus.CONFIRMED, TrackStatus.TENTATIVE
        )
        return TimedRows(rows, plots.time[kept].copy(), 1)

    def tables(self, plots=None, tracks=None):
        plots = self.plots() if plots is None else plots
        nothing = TimedRows(np.zeros(0, TRACK), np.zeros(0), 0)
        return BagTables(
            plots,
            nothing if tracks is None else tracks,
            self.truth(),
            ORIGIN,
            0.0,
            self.scans * PERIOD,
        )

    def owner(self, plots):
        """Index of the target of each plot."""
        target, time = self.crossings()
        return target[np.searchsorted(time, plots.time)]


@pytest.fixture(scope="session")
def new_world():
    """Make six targets, two of them near each other, one of them across north."""

    def make():
        start = np.array(
            [[20e3, 5e3], [-12e3, 30e3], [-30e3, -8e3], [3e3, -25e3], [4.2e3, -25e3], [2e3, 18e3]]
        )
        velocity = np.array(
            [[150, 20], [-60, 90], [100, -10], [20, -80], [22, -81], [-40, 5]], dtype=float
        )
        return World(start, velocity)

    return make


@pytest.fixture
def world(new_world):
    """A world of the test's own."""
    return new_world()


@pytest.fixture
def write_bag(tmp_path):
    """Write tables into a bag, one message a topic and scan."""

    def write(tables, name="bag", storage="mcap"):
        path = tmp_path / name
        with BagWriter(path, storage=storage) as writer:
            for topic, timed, frame in (
                (TRUTH_TOPIC, tables.truth, SITE_FRAME),
                (PLOTS_TOPIC, tables.plots, "radar"),
                (TRACKS_TOPIC, tables.tracks, SITE_FRAME),
            ):
                for scan in range(int(tables.stop / PERIOD)):
                    inside = (timed.time >= scan * PERIOD) & (timed.time < (scan + 1) * PERIOD)
                    rows = timed.rows[inside].copy()
                    stamp = ORIGIN + round(scan * PERIOD * NANOSECONDS)
                    rows["time_offset"] = timed.time[inside] - scan * PERIOD
                    writer.write(topic, Table(stamp, rows, frame))
        return path

    return write
