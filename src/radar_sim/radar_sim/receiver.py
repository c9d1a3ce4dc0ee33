# SPDX-License-Identifier: Apache-2.0
"""The receiver: its noise, the envelope of signal and noise, and the digitiser.

One sample a cell: the noise behind a filter matched to a rectangular pulse is uncorrelated at distances of one pulse
length, so the cells are independent. The envelope of noise is Rayleigh, that of a signal in noise Rice (Kuzmin 1967,
1.32-1.35).
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from radar_sim.digitiser import Digitiser
from radar_sim.echoes import Echoes
from radar_sim.radar import Radar
from radar_sim.random_phase import random_cosines
from radar_sim.reception import Complex64Array, Float32Array, Reception
from radar_sim.runs import runs

_PULSES_IN_CACHE = 32


class Receiver:
    """Makes video, pulse after pulse; the same seeds give the same video in pieces of any size."""

    def __init__(
        self,
        radar: Radar,
        digitiser: Digitiser,
        noise_rng: np.random.Generator,
        phase_rng: np.random.Generator,
        field_phase_rng: np.random.Generator,
    ) -> None:
        """Set levels.

        Args:
            radar: number of cells.
            digitiser: what makes samples of the power.
            noise_rng: source of the noise's envelope.
            phase_rng: source of its phase, drawn only where there is an echo.
            field_phase_rng: source of its phase in pulses with a signal in whole stretches of cells.
        """
        self._cells = radar.cells
        self._digitiser = digitiser
        self._noise_rng = noise_rng
        self._phase_rng = phase_rng
        self._field_phase_rng = field_phase_rng
        self._power = np.empty((0, radar.cells), np.float32)

    def receive(self, video: npt.NDArray[np.generic], reception: Reception) -> None:
        """Fill the video of successive pulses.

        Args:
            video: samples to write, shape (pulses, cells).
            reception: what reaches the receiver in them.
        """
        if self._power.shape[0] != len(video):
            self._power = np.empty((len(video), self._cells), np.float32)
        power = self._power
        self._noise_rng.standard_exponential(out=power, dtype=np.float32)
        noise = reception.noise_power()
        if noise is not None:
            power *= noise
        echoes, field = reception.signals()
        if field is not None:
            self._add_field(power, field, reception.filled)
        index = (echoes.pulse - reception.first) * self._cells + echoes.cell
        self._add_echoes(power.reshape(-1), index, echoes)
        self._digitiser.digitise(power, video)

    def _add_field(
        self, power: Float32Array, field: Complex64Array, filled: npt.NDArray[np.bool_]
    ) -> None:
        """|s + n|² = |s|² + |n|² + 2 |s| |n| cos phi: only the phase between signal and noise is needed."""
        for begin, end in runs(filled):
            for first in range(begin, end, _PULSES_IN_CACHE):
                part = slice(first, min(first + _PULSES_IN_CACHE, end))
                noise = power[part]
                signal = np.square(field[part].real)
                signal += np.square(field[part].imag)
                signal *= np.float32(0.5)
                beat = signal * noise
                np.sqrt(beat, out=beat)
                beat *= random_cosines(len(beat), self._cells, self._field_phase_rng)
                beat *= np.float32(2.0)
                noise += signal
                noise += beat
                # Rounding must not make a root of less than nothing.
                np.maximum(noise, np.float32(0.0), out=noise)

    def _add_echoes(
        self, power: npt.NDArray[np.float32], index: npt.NDArray[np.int64], echoes: Echoes
    ) -> None:
        reached, which = np.unique(index, return_inverse=True)
        # Echoes in one cell of one pulse add as complex amplitudes.
        real = np.bincount(which, echoes.amplitude.real, len(reached))
        imaginary = np.bincount(which, echoes.amplitude.imag, len(reached))
        noise = np.sqrt(2.0 * power[reached]) * np.exp(
            2j * np.pi * self._phase_rng.random(len(reached))
        )
        power[reached] = np.square(np.abs(real + 1j * imaginary + noise)) / 2.0
