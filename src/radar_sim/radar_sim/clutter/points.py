# SPDX-License-Identifier: Apache-2.0
"""Point clutter: masts, buildings and wrecks that stand where they are and echo strongly in every turn."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from radar_common.frames import TWO_PI, wrap_pi
from radar_common.parameters import parameter
from radar_sim.bursts import into_cells, pulses_to_either_side
from radar_sim.clutter.area import AreaSection
from radar_sim.disturbance import Disturbance
from radar_sim.echoes import Echoes, EchoQueue
from radar_sim.radar import Radar
from radar_sim.reception import Reception
from radar_sim.signal_strength import amplitude_from_snr


@dataclass(frozen=True, kw_only=True)
class PointsSection(AreaSection):
    """One entry of `clutter.points`: scatterers at random places of an area."""

    number: int = parameter(50, "how many", low=1, high=100_000)
    cnr_db: float = parameter(
        35.0,
        "mean over the scatterers of their clutter-to-noise ratio at the beam's centre",
        unit="dB",
        low=-20.0,
        high=80.0,
    )
    spread_db: float = parameter(
        6.0, "standard deviation of it over the scatterers", unit="dB", low=0.0, high=30.0
    )
    fluctuation_db: float = parameter(
        0.5, "standard deviation of each from turn to turn", unit="dB", low=0.0, high=20.0
    )

    def disturbance(self, radar: Radar, rng: np.random.Generator) -> Points:
        """Make the scatterers; see `DisturbanceSection.disturbance`.

        Args:
            radar: that receives them.
            rng: of their places, strengths and fluctuations.

        Returns:
            The scatterers.
        """
        return Points(self, radar, rng)


class Points(Disturbance):
    """Scatterers with the burst of a target at rest; their phase stays as well."""

    def __init__(self, section: PointsSection, radar: Radar, rng: np.random.Generator) -> None:
        """Draw where they stand.

        Args:
            section: what they are.
            radar: that receives them.
            rng: source of randomness.
        """
        size = section.number
        self._section = section
        self._radar = radar
        self._rng = rng
        self._range = rng.uniform(section.range_from, section.range_to, size)
        degrees = rng.uniform(section.azimuth_from_deg, section.azimuth_to_deg, size)
        self._azimuth = np.mod(np.radians(degrees), TWO_PI)
        self._cnr_db = rng.normal(section.cnr_db, section.spread_db, size)
        self._phase = np.exp(2j * math.pi * rng.random(size))
        self._queue = EchoQueue()
        self._turns = 0

    def add_to(self, reception: Reception) -> None:
        """Add the echoes; see `Disturbance.add_to`.

        Args:
            reception: successive pulses.
        """
        after = reception.first + reception.pulses
        # The first pulses of a burst may come before the turn in which the axis passes the scatterer.
        ahead = after + pulses_to_either_side(self._radar)
        while self._turns <= ahead / self._radar.pulses_per_scan:
            self._queue.add(self._turn(self._turns))
            self._turns += 1
        reception.add_echoes(self._queue.take(after))

    def _turn(self, turn: int) -> Echoes:
        radar = self._radar
        reach = pulses_to_either_side(radar)
        change_db = self._rng.normal(0.0, self._section.fluctuation_db, len(self._range))
        strength = amplitude_from_snr(self._cnr_db + change_db) * self._phase
        centre = np.rint((turn + self._azimuth / TWO_PI) * radar.pulses_per_scan).astype(np.int64)
        pulse = centre[:, None] + np.arange(-reach, reach + 1)
        alpha = wrap_pi(radar.azimuth(pulse) - self._azimuth[:, None]) / radar.half_width
        amplitude = strength[:, None] * radar.beam(alpha)
        distance = np.broadcast_to(self._range[:, None], pulse.shape)
        lit = (amplitude != 0.0) & (pulse >= 0)
        return into_cells(pulse[lit], distance[lit], amplitude[lit], radar)
