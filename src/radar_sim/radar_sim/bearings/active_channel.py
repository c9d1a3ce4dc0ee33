# SPDX-License-Identifier: Apache-2.0
"""The active channel: plots of the targets at the radar's place without making any video, worse while it is jammed."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from radar_common.frames import enu_from_polar, wrap_two_pi
from radar_common.tables import PLOT, BearingChannel
from radar_sim.bearings.looks import Look, channel_rows, split, truth_rows
from radar_sim.bearings.sections import ActiveChannelSection
from radar_sim.bearings.sources import Sources
from radar_sim.bearings.violations import Violations
from radar_sim.motion import State
from radar_sim.radar import Radar

FloatArray = npt.NDArray[np.float64]

_PULSE_COUNT = 16


class ActiveChannel:
    """Takes looks, block by block; how many at a time changes nothing.

    Attributes:
        section: how it measures.
    """

    def __init__(
        self,
        section: ActiveChannelSection,
        radar: Radar,
        sources: Sources,
        rng: np.random.Generator,
    ) -> None:
        """Stand where the radar stands.

        Args:
            section: how it measures.
            radar: its place.
            sources: to see.
            rng: source of the errors.
        """
        self.section = section
        self._radar = radar
        self._sources = sources
        self._errors, self._chance = rng.spawn(2)

    def looks(self, first: int, count: int, jams: Violations, silences: Violations) -> list[Look]:
        """Take the next looks.

        Args:
            first: number of the first, the one after the last of the call before.
            count: how many.
            jams: of this channel.
            silences: of the passive one, for the truth.

        Returns:
            Looks in order of time.
        """
        section, sources = self.section, self._sources
        begin: FloatArray = np.multiply(
            section.period, np.arange(first, first + count), dtype=float
        )
        shape = (count, len(sources))
        everything = sources.seen(
            np.broadcast_to(begin[:, None], shape), self._observer(shape), self._radar.z
        )
        sight = everything.take(sources.echoing)
        jammed, silent = jams.at(begin), silences.at(begin)
        nominal = math.radians(section.azimuth_std_deg)
        std = np.where(jammed, nominal * math.sqrt(section.noise_ratio), nominal)
        std = np.broadcast_to(std[:, None], sight.azimuth.shape)
        across, along = np.moveaxis(self._errors.standard_normal((*sight.azimuth.shape, 2)), -1, 0)
        rows = np.zeros(sight.azimuth.shape, PLOT)
        rows["range"] = np.maximum(sight.distance + section.range_std * along, 1.0)
        rows["azimuth"] = wrap_two_pi(sight.azimuth + std * across)
        rows["x"], rows["y"] = enu_from_polar(rows["range"], rows["azimuth"])
        rows["range_std"] = np.where(np.isnan(sight.distance), np.nan, section.range_std)
        # A radar knows its own accuracy, not that it is being jammed.
        rows["azimuth_std"] = nominal
        rows["snr_db"] = section.snr_db
        rows["amplitude"] = math.sqrt(2.0 * 10.0 ** (section.snr_db / 10.0))
        rows["pulse_count"], rows["quality"] = _PULSE_COUNT, 1.0
        rows["radial_speed"] = rows["radial_speed_std"] = np.nan
        found = sight.present & (self._chance.random(sight.azimuth.shape) < section.detection)
        at_once = np.zeros(sight.azimuth.shape)
        channels = channel_rows(
            sight,
            sources.ids[sources.echoing],
            at_once,
            std,
            BearingChannel.ACTIVE,
            jammed,
            silent,
        )
        parts = (
            split(rows, found),
            split(channels, sight.present),
            truth_rows(everything, sources, np.zeros(shape)),
        )
        return [
            Look(float(b), float(b + section.delay), *part)
            for b, *part in zip(begin, *parts, strict=True)
        ]

    def _observer(self, shape: tuple[int, int]) -> State:
        still = np.zeros(shape)
        return State(np.full(shape, self._radar.x), np.full(shape, self._radar.y), still, still)
