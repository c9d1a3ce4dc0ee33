# SPDX-License-Identifier: Apache-2.0
"""Clutter that fills whole stretches of range cells: a mean amplitude in each cell, and speckle or noise times it."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from radar_sim.clutter.coherence import coherence
from radar_sim.clutter.speckle import ExponentialSpeckle, GaussianSpeckle
from radar_sim.disturbance import Disturbance
from radar_sim.radar import Radar
from radar_sim.reception import Reception

Float32Array = npt.NDArray[np.float32]

_SPECKLES = {"gaussian": GaussianSpeckle, "exponential": ExponentialSpeckle}
SPECTRA = (*_SPECKLES, "white")


class Block(NamedTuple):
    """Successive pulses and cells with clutter in them.

    Attributes:
        pulse: number of the first pulse.
        cell: first range cell.
        amplitude: root of the mean power over that of the noise, shape (pulses, cells).
    """

    pulse: int
    cell: int
    amplitude: Float32Array


class DistributedClutter(Disturbance):
    """Adds clutter as a signal, or as noise where it is independent from pulse to pulse."""

    def __init__(
        self, radar: Radar, spectrum: str, speed_spread: float, rng: np.random.Generator
    ) -> None:
        """Choose how it changes from pulse to pulse.

        Args:
            radar: wavelength, pulse rate and beam.
            spectrum: one of SPECTRA.
            speed_spread: rms of the radial speeds, m/s.
            rng: of the speckle.
        """
        self._speckle = (
            _SPECKLES[spectrum](coherence(radar, speed_spread), rng)
            if spectrum in _SPECKLES
            else None
        )

    def add_to(self, reception: Reception) -> None:
        """Add the clutter; see `Disturbance.add_to`.

        Args:
            reception: successive pulses.
        """
        for pulse, cell, amplitude in self._blocks(reception.first, reception.pulses):
            begin = pulse - reception.first
            if self._speckle is None:
                reception.add_cell_noise(begin, cell, np.square(amplitude))
                continue
            signal = self._speckle.signal(pulse, *amplitude.shape)
            signal *= amplitude
            reception.add_signal(begin, cell, signal)

    @abstractmethod
    def _blocks(self, first: int, pulses: int) -> Iterator[Block]:
        """Find where in these pulses the clutter is, in order of the pulses."""
