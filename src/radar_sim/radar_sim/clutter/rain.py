# SPDX-License-Identifier: Apache-2.0
"""Rain: a cloud that fills its range cells evenly and drifts with the wind."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from radar_common.frames import TWO_PI, polar_from_enu, wrap_pi
from radar_common.parameters import parameter
from radar_sim.clutter.distributed import SPECTRA, Block, DistributedClutter
from radar_sim.disturbance import DisturbanceSection
from radar_sim.radar import Radar
from radar_sim.runs import runs

_REACH = 2.0  # Radii: there it is 48 dB weaker than in its middle.


@dataclass(frozen=True, kw_only=True)
class RainSection(DisturbanceSection):
    """One entry of `clutter.rain`: one cloud."""

    x: float = parameter(
        0.0, "middle at the start, east of the map's origin", unit="m", low=-1e6, high=1e6
    )
    y: float = parameter(20_000.0, "north of the map's origin", unit="m", low=-1e6, high=1e6)
    radius: float = parameter(
        4_000.0, "where its power has fallen to half", unit="m", low=10.0, high=2e5
    )
    cnr_db: float = parameter(
        15.0,
        "clutter-to-noise ratio of one pulse in its middle at the start",
        unit="dB",
        low=-40.0,
        high=80.0,
    )
    range_exponent: float = parameter(
        2.0,
        "the ratio falls with this power of range: 2 for a volume, 0 behind a perfect sensitivity time control",
        low=0.0,
        high=8.0,
    )
    wind_speed: float = parameter(15.0, "speed of its drift", unit="m/s", low=0.0, high=100.0)
    wind_course_deg: float = parameter(
        90.0, "where it drifts to, clockwise from north", unit="deg", low=-360.0, high=360.0
    )
    spectrum: str = parameter(
        "gaussian",
        "pulse-to-pulse correlation: gaussian, exponential, or white for independent pulses as in the book",
        choices=SPECTRA,
    )
    speed_spread: float = parameter(
        3.0,
        "rms of the drops' radial speeds; sets the correlation together with the turning beam",
        unit="m/s",
        low=0.0,
        high=50.0,
    )

    def disturbance(self, radar: Radar, rng: np.random.Generator) -> Rain:
        """Make the rain; see `DisturbanceSection.disturbance`.

        Args:
            radar: that receives it.
            rng: of the speckle.

        Returns:
            The cloud.
        """
        return Rain(self, radar, rng)


class Rain(DistributedClutter):
    """A round cloud; it moves between two passes of the beam and stands while the beam is on it."""

    def __init__(self, section: RainSection, radar: Radar, rng: np.random.Generator) -> None:
        """Place it.

        Args:
            section: what it is.
            radar: that receives it.
            rng: of the speckle.
        """
        super().__init__(radar, section.spectrum, section.speed_spread, rng)
        self._section = section
        self._radar = radar
        distance, azimuth = polar_from_enu(section.x - radar.x, section.y - radar.y)
        # Nearer than a cell the power law would have no bound.
        self._start = max(float(distance), radar.range_step)
        self._first_pass = float(azimuth) / TWO_PI
        self._ranges = radar.range_start + (np.arange(radar.cells) + 0.5) * radar.range_step
        power = 10.0 ** (section.cnr_db / 10.0) * np.power(
            self._ranges / self._start, -section.range_exponent
        )
        self._amplitude = np.sqrt(power)

    def _blocks(self, first: int, pulses: int) -> Iterator[Block]:
        pulse = np.arange(first, first + pulses)
        passes = np.floor(pulse / self._radar.pulses_per_scan - self._first_pass + 0.5)
        for number in np.unique(passes):
            distance, azimuth = self._middle(float(number))
            reach = _REACH * self._section.radius
            off_axis = wrap_pi(self._radar.azimuth(pulse) - azimuth)
            half_width = math.asin(reach / distance) if distance > reach else math.pi
            cells = np.flatnonzero(np.abs(self._ranges - distance) < reach)
            if not len(cells):
                continue
            for begin, end in runs((np.abs(off_axis) <= half_width) & (passes == number)):
                amplitude = self._profile(distance, off_axis[begin:end], cells)
                yield Block(first + begin, int(cells[0]), amplitude)

    def _middle(self, number: float) -> tuple[float, float]:
        """Range and azimuth of the middle when the beam passes it."""
        section = self._section
        time = max((number + self._first_pass) * self._radar.scan_period, 0.0)
        course = math.radians(section.wind_course_deg)
        way = section.wind_speed * time
        distance, azimuth = polar_from_enu(
            section.x + way * math.sin(course) - self._radar.x,
            section.y + way * math.cos(course) - self._radar.y,
        )
        return float(distance), float(azimuth)

    def _profile(self, distance: float, off_axis: np.ndarray, cells: np.ndarray) -> np.ndarray:
        ranges = self._ranges[cells]
        apart = np.square(ranges) + distance**2
        apart = apart - np.multiply.outer(2.0 * distance * np.cos(off_axis), ranges)
        fourth = np.square((apart / self._section.radius**2).astype(np.float32))
        fourth *= np.float32(-math.log(2.0) / 2.0)
        np.exp(fourth, out=fourth)
        fourth *= self._amplitude[cells].astype(np.float32)
        return fourth
