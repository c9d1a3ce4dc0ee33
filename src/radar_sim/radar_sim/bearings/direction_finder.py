# SPDX-License-Identifier: Apache-2.0
"""The direction finder: bearings of what transmits, from a moving platform.

A bearing is atan2(east, north) of the emitter as seen from the platform, plus a white and a correlated error
(Khmarskiy and Sushchinskiy 2015; their formula by arctangent and signs misses a quadrant).
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt
from scipy.signal import lfilter

from radar_common.frames import TWO_PI, wrap_pi, wrap_two_pi
from radar_common.odometry import PlatformState
from radar_common.tables import BEARING, NANOSECONDS, BearingChannel
from radar_sim.bearings.looks import Look, channel_rows, split, truth_rows
from radar_sim.bearings.scene import Platform
from radar_sim.bearings.sections import PassiveChannelSection
from radar_sim.bearings.sources import Sources
from radar_sim.bearings.violations import Violations
from radar_sim.motion import Fleet, State
from radar_sim.motion.correlated import correlation_of_step

FloatArray = npt.NDArray[np.float64]

_TURN_INTERVAL = 1e-3


class DirectionFinder:
    """Takes looks, block by block; how many at a time changes nothing.

    Attributes:
        section: how it hears.
    """

    def __init__(
        self,
        platform: Platform,
        passive: PassiveChannelSection,
        sources: Sources,
        rng: np.random.Generator,
    ) -> None:
        """Set out.

        Args:
            platform: and its way.
            passive: what it tells of silent sources.
            sources: to hear.
            rng: source of the errors.
        """
        self.section = platform.section
        self._path = platform.path
        self._fleet = Fleet([platform.path])
        self._passive = passive
        self._sources = sources
        self._timing, self._white, self._wander, self._chance, self._astray = rng.spawn(5)
        self._error = self._wander.standard_normal(len(sources)) * self._correlated_std

    @property
    def _correlated_std(self) -> float:
        return math.radians(self.section.correlated_std_deg)

    def looks(self, first: int, count: int, jams: Violations, silences: Violations) -> list[Look]:
        """Take the next looks.

        Args:
            first: number of the first, the one after the last of the call before.
            count: how many.
            jams: of the active channel, for the truth.
            silences: of the sources.

        Returns:
            Looks in order of time.
        """
        section, sources = self.section, self._sources
        shape = (count, len(sources))
        begin: FloatArray = np.multiply(
            section.period, np.arange(first, first + count), dtype=float
        )
        offset = section.spread * self._timing.random(shape)
        time = begin[:, None] + offset
        sight = sources.seen(time, self._state(time), section.z)
        std = np.full(
            shape, math.hypot(math.radians(section.azimuth_std_deg), self._correlated_std)
        )
        silent, jammed = silences.at(begin), jams.at(begin)

        rows = np.zeros(shape, BEARING)
        rows["azimuth"] = self._azimuths(sight.azimuth, silent)
        rows["azimuth_std"] = std
        rows["elevation"], rows["elevation_std"] = self._elevations(sight.elevation)
        for name in ("rate", "rate_std", "active_health", "passive_health"):
            rows[name] = np.nan
        rows["time_offset"] = offset
        rows["id"] = sources.ids if section.identity else 0
        rows["channel"] = BearingChannel.PASSIVE

        hearable = np.zeros(len(sources), dtype=bool)
        hearable[sources.transmitting] = True
        heard = sight.present & sources.switched_on(time) & hearable
        perceived = heard & (self._chance.random(shape) < section.detection)
        if self._passive.silence == "nothing":
            perceived &= ~silent[:, None]
        channels = channel_rows(
            sight, sources.ids, offset, std, BearingChannel.PASSIVE, jammed, silent
        )
        parts = (split(rows, perceived), split(channels, heard), truth_rows(sight, sources, offset))
        due = begin + section.spread + section.delay
        return [
            Look(float(b), float(d), *part) for b, d, *part in zip(begin, due, *parts, strict=True)
        ]

    def _azimuths(self, azimuth: FloatArray, silent: npt.NDArray[np.bool_]) -> FloatArray:
        shape = azimuth.shape
        white = math.radians(self.section.azimuth_std_deg) * self._white.standard_normal(shape)
        error = white + self._correlated(len(azimuth))
        mean = self._sources.mean_azimuth
        quiet = np.where(np.isnan(mean), math.radians(self._passive.noise_azimuth_deg), mean)
        azimuth = np.where(silent[:, None], quiet, azimuth) + error
        astray, anywhere = np.moveaxis(self._astray.random((*shape, 2)), -1, 0)
        return wrap_two_pi(np.where(astray < self.section.outliers, TWO_PI * anywhere, azimuth))

    def _correlated(self, count: int) -> FloatArray:
        rho = correlation_of_step(self.section.period, self.section.correlation_time)
        driving = self._wander.standard_normal((count, len(self._sources)))
        driving *= math.sqrt(1.0 - rho**2) * self._correlated_std
        errors, _ = lfilter([1.0], [1.0, -rho], driving, axis=0, zi=rho * self._error[None])
        if count:
            self._error = errors[-1]
        return np.asarray(errors)

    def _elevations(self, elevation: FloatArray) -> tuple[FloatArray, float]:
        if not self.section.elevation:
            return np.full(elevation.shape, np.nan), math.nan
        std = math.radians(self.section.elevation_std_deg)
        return elevation + std * self._white.standard_normal(elevation.shape), std

    def _state(self, time: FloatArray) -> State:
        return self._fleet.state(np.zeros(time.shape, dtype=np.intp), time)

    def odometry(self, first: int, count: int, start: int) -> list[tuple[float, PlatformState]]:
        """Tell where the platform is.

        Args:
            first: number of the first message.
            count: how many.
            start: stamp of the start, nanoseconds.

        Returns:
            Time in s after the start and state of each; the nose points where the platform goes.
        """
        section = self.section
        number = np.arange(first, first + count)
        time: FloatArray = np.multiply(section.odometry_period, number, dtype=float)
        state = self._state(time[:, None] + _TURN_INTERVAL * np.array([-0.5, 0.0, 0.5]))
        moving = np.hypot(state.vx, state.vy) > 0.0
        courses = np.where(moving, np.arctan2(state.vx, state.vy), self._path.course)
        turns = wrap_pi(np.diff(courses, axis=1)) / (_TURN_INTERVAL / 2.0)
        # The calmer side of the moment: a sudden change of course has no rate.
        calm = np.argmin(np.abs(turns), axis=1)
        turn_rate = np.take_along_axis(turns, calm[:, None], axis=1)[:, 0]
        columns = (
            state.x[:, 1],
            state.y[:, 1],
            np.full(count, section.z),
            wrap_two_pi(courses[:, 1]),
            state.vx[:, 1],
            state.vy[:, 1],
            np.zeros(count),
            turn_rate,
        )
        return [
            (at, PlatformState(start + round(at * NANOSECONDS), *values))
            for at, *values in zip(time.tolist(), *(c.tolist() for c in columns), strict=True)
        ]
