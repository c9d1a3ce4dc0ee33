# SPDX-License-Identifier: Apache-2.0
"""A noise jammer: raises the noise in all range cells, as much as the antenna looks its way."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from radar_common.parameters import ParameterError, parameter
from radar_sim.disturbance import Disturbance, DisturbanceSection
from radar_sim.radar import Radar
from radar_sim.reception import Reception


@dataclass(frozen=True, kw_only=True)
class JammerSection(DisturbanceSection):
    """One entry of `interference.jammers`; it stands still and covers the receiver's whole band."""

    azimuth_deg: float = parameter(
        0.0, "direction, clockwise from north", unit="deg", low=-360.0, high=360.0
    )
    jnr_db: float = parameter(
        30.0,
        "noise over the receiver's own with the beam's axis on it",
        unit="dB",
        low=-20.0,
        high=80.0,
    )
    begins: float = parameter(
        0.0, "time after the start at which it is switched on", unit="s", low=0.0, high=1e6
    )
    ends: float = parameter(
        1e6, "time after the start at which it is switched off", unit="s", low=0.0, high=1e6
    )
    on_time: float = parameter(
        0.0, "length of each transmission of one that blinks", unit="s", low=0.0, high=1e6
    )
    off_time: float = parameter(
        0.0, "pause between them; 0 transmits without pause", unit="s", low=0.0, high=1e6
    )

    def check(self) -> None:
        """Check that it is switched on before it is switched off.

        Raises:
            ParameterError: it is not, or pauses without ever transmitting.
        """
        if self.ends <= self.begins:
            raise ParameterError(f"ends {self.ends:g} s is not after begins {self.begins:g} s")
        if self.off_time > 0.0 and self.on_time == 0.0:
            raise ParameterError(f"off_time {self.off_time:g} s needs an on_time over 0")

    def disturbance(self, radar: Radar, rng: np.random.Generator) -> Jammer:
        """Make the jammer; see `DisturbanceSection.disturbance`.

        Args:
            radar: that receives it.
            rng: not used, the noise is the receiver's made stronger.

        Returns:
            The jammer.
        """
        return Jammer(self, radar)


class Jammer(Disturbance):
    """White noise whose power follows the one-way pattern, side lobes included."""

    def __init__(self, section: JammerSection, radar: Radar) -> None:
        """Switch it on.

        Args:
            section: direction, power and times.
            radar: that receives it.
        """
        self._section = section
        self._radar = radar
        self._direction = math.radians(section.azimuth_deg)
        self._power = 10.0 ** (section.jnr_db / 10.0)

    def add_to(self, reception: Reception) -> None:
        """Raise the noise; see `Disturbance.add_to`.

        Args:
            reception: successive pulses.
        """
        section, radar = self._section, self._radar
        pulse = np.arange(reception.first, reception.first + reception.pulses)
        time = pulse * radar.pulse_interval
        on = (section.begins <= time) & (time < section.ends)
        if section.off_time:
            since = np.mod(time - section.begins, section.on_time + section.off_time)
            on &= since < section.on_time
        gain = radar.one_way_gain(radar.azimuth(pulse), self._direction)
        reception.add_pulse_noise((on * self._power * gain).astype(np.float32))
