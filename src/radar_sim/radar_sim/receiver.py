# SPDX-License-Identifier: Apache-2.0
"""The receiver: noise, the envelope of signal and noise, and the digitiser.

One sample a cell: the noise behind a filter matched to a rectangular pulse is uncorrelated at distances of one pulse
length, so the cells are independent. The envelope of noise is Rayleigh, that of a signal in noise Rice (Kuzmin 1967,
1.32-1.35).
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from radar_sim.bursts import Echoes
from radar_sim.radar import Radar

FloatArray = npt.NDArray[np.float64]

_INTEGER_CODES = {"uint8": 255, "uint16": 65535}
SAMPLES = ("float32", *_INTEGER_CODES)


class Receiver:
    """Makes video, pulse after pulse; the same seeds give the same video in pieces of any size."""

    def __init__(
        self,
        radar: Radar,
        sample: str,
        noise_rng: np.random.Generator,
        phase_rng: np.random.Generator,
    ) -> None:
        """Set levels.

        Args:
            radar: noise level, gain and full scale.
            sample: type of a video sample, one of SAMPLES.
            noise_rng: source of the noise's envelope.
            phase_rng: source of its phase, drawn only where there is a signal.
        """
        self._cells = radar.cells
        self._noise_rng = noise_rng
        self._phase_rng = phase_rng
        self._largest = _INTEGER_CODES.get(sample)
        unit = radar.noise_level
        if self._largest is not None:
            unit = self._largest / radar.full_scale
        # Of the squared envelope: E² = 2 sigma² e, where e is exponential with mean one.
        self._level = (2.0 * np.square(unit * radar.gain())).astype(np.float32)
        self._power = np.empty((0, radar.cells), np.float32)

    def receive(self, video: npt.NDArray[np.generic], first: int, echoes: Echoes) -> None:
        """Fill the video of successive pulses.

        Args:
            video: samples to write, shape (pulses, cells).
            first: number of the first pulse.
            echoes: signal, all of it within these pulses.
        """
        if self._power.shape[0] != len(video):
            self._power = np.empty((len(video), self._cells), np.float32)
        power = self._power
        self._noise_rng.standard_exponential(out=power, dtype=np.float32)
        self._add(power.reshape(-1), (echoes.pulse - first) * self._cells + echoes.cell, echoes)
        power *= self._level
        np.sqrt(power, out=power)
        if self._largest is not None:
            power += np.float32(0.5)
            np.minimum(power, np.float32(self._largest), out=power)
        np.copyto(video, power, casting="unsafe")

    def _add(
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
