# SPDX-License-Identifier: Apache-2.0
"""Makes the plots of a scene, turn by turn, and hands them out sector by sector."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from radar_common.frames import TWO_PI, enu_from_polar, wrap_two_pi
from radar_common.tables import NANOSECONDS, PLOT, RADAR_FRAME, SITE_FRAME, TRUTH, Table
from radar_sim.bursts import Crossings, find_crossings
from radar_sim.plot_scenes.detection import (
    detection_probability,
    power_over_threshold,
    snr_for_detection,
)
from radar_sim.plot_scenes.false_plots import in_patches, uniform_in_range
from radar_sim.plot_scenes.resolution import merge
from radar_sim.plot_scenes.scene import PlotScene
from radar_sim.signal_strength import snr_db_at_range

FloatArray = npt.NDArray[np.float64]
Rows = npt.NDArray[np.void]

SECTORS = 32


class PlotSector(NamedTuple):
    """One sector as it would be published; `time_offset` counts from its stamp.

    Attributes:
        plots: rows of PLOT, in order of time.
        truth: targets that the beam's axis passed in it, rows of TRUTH.
    """

    plots: Table
    truth: Table


class PlotSimulator:
    """Plots of a scene; iterate over it for its sectors.

    Plot and truth of one pass bear the very same time, that at which the beam's axis passed the target, so that
    nobody need guess which plot came from which target.

    Attributes:
        scene: what is simulated.
    """

    def __init__(
        self, scene: PlotScene, rng: np.random.Generator, *, sectors: int = SECTORS, start: int = 0
    ) -> None:
        """Draw the traffic.

        Args:
            scene: to simulate.
            rng: source of all randomness; its streams for traffic, plots and false plots are independent.
            sectors: messages a turn.
            start: stamp of the first sector, nanoseconds.

        Raises:
            ValueError: no sectors.
        """
        if sectors < 1:
            raise ValueError(f"a turn has one sector or more, not {sectors}")
        traffic, self._plots, self._false = rng.spawn(3)
        self.scene = scene
        self._targets = scene.scenario.draw(traffic)
        self._radar = scene.scenario.radar
        self._sectors, self._start = sectors, start
        steps = np.floor(scene.share * np.arange(len(self._targets) + 1))
        self._taken = np.diff(steps) > 0.0

    def __iter__(self) -> Iterator[PlotSector]:
        """Simulate.

        Yields:
            All sectors, in order of time, empty ones too.
        """
        width = self._radar.scan_period / self._sectors
        for turn in range(self.scene.scans):
            plots, truth = self._turn(turn)
            edges = turn * self._radar.scan_period + width * np.arange(self._sectors)
            stamps = self._start + np.round(edges * NANOSECONDS).astype(np.int64)
            pairs = zip(_cut(plots, edges), _cut(truth, edges), strict=True)
            for stamp, (some, true) in zip(stamps.tolist(), pairs, strict=True):
                # Rounding the stamp to nanoseconds must not move the rows.
                rounded = (stamp - self._start) / NANOSECONDS
                some["time_offset"] -= rounded
                true["time_offset"] -= rounded
                yield PlotSector(Table(stamp, some, RADAR_FRAME), Table(stamp, true, SITE_FRAME))

    def _turn(self, turn: int) -> tuple[Rows, Rows]:
        scene, radar = self.scene, self._radar
        crossings = find_crossings(self._targets, radar, turn)
        nearest = max(radar.range_start, scene.nearest)
        covered = (crossings.distance >= nearest) & (crossings.distance < radar.range_end)
        truth = self._truth(crossings)[covered & self._taken[crossings.target]]
        plots = np.concatenate([self._of_targets(truth), self._of_nothing(turn)])
        plots["x"], plots["y"] = enu_from_polar(plots["range"], plots["azimuth"])
        return _by_time(plots), _by_time(truth)

    def _truth(self, crossings: Crossings) -> Rows:
        rows = np.zeros(len(crossings.target), TRUTH)
        for name in ("x", "y", "vx", "vy"):
            rows[name] = getattr(crossings.state, name)
        rows["range"], rows["azimuth"] = crossings.distance, crossings.azimuth
        rows["id"] = crossings.target + 1
        rows["time_offset"] = crossings.time
        rows["snr_db"] = self._snr(crossings.target, rows["range"])
        return rows

    def _snr(self, target: npt.NDArray[np.intp], distance: FloatArray) -> FloatArray:
        scene = self.scene
        if scene.detection is not None:
            wanted = np.full(len(target), scene.detection)
            return snr_for_detection(wanted, scene.false_alarm_probability)
        at_range = snr_db_at_range(
            self._radar, self._targets.snr_db[target], np.maximum(distance, 1.0)
        )
        return at_range + scene.integration_gain_db

    def _of_targets(self, truth: Rows) -> Rows:
        scene, rng = self.scene, self._plots
        chance = detection_probability(truth["snr_db"], scene.false_alarm_probability)
        range_error, azimuth_error = scene.errors.draw(len(truth), rng)
        found = rng.random(len(truth)) < chance
        seen = truth[found]
        power = power_over_threshold(
            seen["snr_db"].astype(float), scene.false_alarm_probability, rng
        )
        # What is not resolved is one echo with one error of its own.
        strongest, distance, azimuth = merge(
            seen["range"],
            seen["azimuth"],
            power,
            range_resolution=scene.range_resolution,
            azimuth_resolution=scene.azimuth_resolution,
        )
        distance = distance + range_error[found][strongest]
        azimuth = azimuth + azimuth_error[found][strongest]
        return self._rows(seen["time_offset"][strongest], distance, azimuth, power[strongest])

    def _of_nothing(self, turn: int) -> Rows:
        scene, radar, rng = self.scene, self._radar, self._false
        nearest = max(radar.range_start, scene.nearest)
        everywhere = uniform_in_range(scene.false_plots, nearest, radar.range_end, rng)
        there = in_patches(scene.patches, rng)
        distance, azimuth = (np.concatenate(pair) for pair in zip(everywhere, there, strict=True))
        noise = np.full(len(distance), -np.inf)
        power = power_over_threshold(noise, scene.false_alarm_probability, rng)
        time = radar.scan_period * (turn + wrap_two_pi(azimuth) / TWO_PI)
        return self._rows(time, distance, azimuth, power)

    def _rows(
        self, time: FloatArray, distance: FloatArray, azimuth: FloatArray, power: FloatArray
    ) -> Rows:
        rows = np.zeros(len(time), PLOT)
        rows["time_offset"] = time
        rows["range"], rows["azimuth"] = np.maximum(distance, 1.0), wrap_two_pi(azimuth)
        rows["range_std"] = self.scene.errors.range_std
        rows["azimuth_std"] = self.scene.errors.azimuth_std
        rows["snr_db"] = 10.0 * np.log10(power)
        rows["amplitude"] = np.sqrt(2.0 * power)
        rows["pulse_count"] = max(1, round(self._radar.pulses_in_beam))
        for name in ("quality", "radial_speed", "radial_speed_std"):
            rows[name] = np.nan
        return rows


def _by_time(rows: Rows) -> Rows:
    return rows[np.argsort(rows["time_offset"], kind="stable")]


def _cut(rows: Rows, edges: npt.NDArray[np.floating]) -> list[Rows]:
    return [part.copy() for part in np.split(rows, rows["time_offset"].searchsorted(edges[1:]))]
