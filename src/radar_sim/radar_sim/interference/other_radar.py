# SPDX-License-Identifier: Apache-2.0
"""Pulses of another radar: they come at its own rate, so in a range cell they stand in no two pulses running."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from radar_common.parameters import ParameterError, parameter
from radar_sim.disturbance import Disturbance, DisturbanceSection
from radar_sim.echoes import Echoes, EchoQueue
from radar_sim.radar import SPEED_OF_LIGHT, Radar
from radar_sim.reception import Reception
from radar_sim.signal_strength import amplitude_from_snr

# Pulses so far below the noise change nothing that could be measured.
_NEGLIGIBLE_POWER = 1e-3


@dataclass(frozen=True, kw_only=True)
class OtherRadarSection(DisturbanceSection):
    """One entry of `interference.radars`; it stands still and its antenna always looks here."""

    azimuth_deg: float = parameter(
        0.0, "direction, clockwise from north", unit="deg", low=-360.0, high=360.0
    )
    snr_db: float = parameter(
        40.0, "of one of its pulses with the beam's axis on it", unit="dB", low=-20.0, high=80.0
    )
    pulse_rate: float = parameter(
        1100.0, "mean pulse repetition frequency", unit="Hz", low=1.0, high=1e5
    )
    pulse_length: float = parameter(
        1e-6, "duration of its pulses as the receiver sees them", unit="s", low=1e-8, high=1e-3
    )
    stagger: float = parameter(
        0.0,
        "each pulse is late by a random part, up to this, of the mean interval; "
        "0 draws regular spirals on the screen",
        low=0.0,
        high=1.0,
    )

    def check(self) -> None:
        """Check that its pulses do not overlap.

        Raises:
            ParameterError: they are longer than the interval between them.
        """
        if self.pulse_length * self.pulse_rate >= 1.0:
            raise ParameterError(
                f"pulse_length {self.pulse_length:g} s is not below the interval of "
                f"{1.0 / self.pulse_rate:g} s"
            )

    def disturbance(self, radar: Radar, rng: np.random.Generator) -> OtherRadar:
        """Make the other radar; see `DisturbanceSection.disturbance`.

        Args:
            radar: that receives it.
            rng: of the time of its first pulse, the stagger and the phases.

        Returns:
            The other radar.
        """
        return OtherRadar(self, radar, rng)


class OtherRadar(Disturbance):
    """Pulses through the matched filter of the receiver, of random phase, by the one-way pattern."""

    def __init__(self, section: OtherRadarSection, radar: Radar, rng: np.random.Generator) -> None:
        """Draw when its first pulse comes.

        Args:
            section: direction, strength, rate and length of its pulses.
            radar: that receives it.
            rng: source of randomness.
        """
        self._section = section
        self._radar = radar
        self._rng = rng
        self._interval = 1.0 / section.pulse_rate
        self._begin = float(rng.random()) * self._interval
        self._next = 0
        self._queue = EchoQueue()

    def add_to(self, reception: Reception) -> None:
        """Add the pulses that arrive; see `Disturbance.add_to`.

        Args:
            reception: successive pulses.
        """
        after = reception.first + reception.pulses
        end = after * self._radar.pulse_interval
        last = max(math.ceil((end - self._begin) / self._interval), self._next)
        arrivals = np.arange(self._next, last)
        self._next = last
        late, phase = self._rng.random((len(arrivals), 2)).T
        time = self._begin + (arrivals + self._section.stagger * late) * self._interval
        self._queue.add(self._receive(time, phase))
        reception.add_echoes(self._queue.take(after))

    def _receive(self, time: np.ndarray, phase: np.ndarray) -> Echoes:
        radar, section = self._radar, self._section
        pulse = np.floor(time / radar.pulse_interval).astype(np.int64)
        power = radar.one_way_gain(radar.azimuth(pulse), math.radians(section.azimuth_deg))
        heard = power * 10.0 ** (section.snr_db / 10.0) > _NEGLIGIBLE_POWER
        time, phase, pulse, power = time[heard], phase[heard], pulse[heard], power[heard]
        per_second = SPEED_OF_LIGHT / 2.0 / radar.range_step
        begin = (time - pulse * radar.pulse_interval) * per_second
        begin -= radar.range_start / radar.range_step
        end = begin + section.pulse_length * per_second
        # The filter takes the mean over a pulse of this radar's: its output is how much of that the other's fills.
        window = radar.samples_per_pulse
        nearest = np.floor(begin - (window - 1) / 2.0).astype(np.int64)
        width = math.ceil(section.pulse_length * per_second) + window
        cell = nearest[:, None] + np.arange(width)
        first = cell - (window - 1) / 2.0
        share = np.minimum(first + window, end[:, None]) - np.maximum(first, begin[:, None])
        share /= window
        amplitude = amplitude_from_snr(section.snr_db) * np.sqrt(power)
        signal = np.maximum(share, 0.0) * (amplitude * np.exp(2j * np.pi * phase))[:, None]
        inside = (share > 0.0) & (cell >= 0) & (cell < radar.cells)
        return Echoes(
            np.broadcast_to(pulse[:, None], cell.shape)[inside], cell[inside], signal[inside]
        )
