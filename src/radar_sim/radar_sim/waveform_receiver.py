# SPDX-License-Identifier: Apache-2.0
"""A receiver that is sampled several times in a pulse: what neighbouring cells hold is no longer independent.

Noise passes the matched filter, so its quadratures are correlated from cell to cell; the envelope is taken of the sum
of all voltages. Clutter passes the pulse as well.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from scipy.ndimage import convolve1d

from radar_common.pulse_response import PULSE_RESPONSES, PulseResponse
from radar_sim.digitiser import Digitiser
from radar_sim.radar import Radar
from radar_sim.reception import Complex64Array, Float32Array, Reception

FloatArray = npt.NDArray[np.float64]

# A kernel's end so far below its middle is cut: 100 dB in power, and odd, so that it does not shift the echoes.
_NEGLIGIBLE = 1e-5


class WaveformReceiver:
    """Makes video, pulse after pulse; the same seed gives the same video in pieces of any size."""

    def __init__(self, radar: Radar, digitiser: Digitiser, noise_rng: np.random.Generator) -> None:
        """Make the filters.

        Args:
            radar: number of cells, shape of the pulse and samples in it.
            digitiser: what makes samples of the power.
            noise_rng: source of the noise.
        """
        self._cells = radar.cells
        self._digitiser = digitiser
        self._rng = noise_rng
        self._noise = noise_kernel(radar.pulse_shape, radar.samples_per_pulse)
        self._clutter = clutter_kernel(PULSE_RESPONSES[radar.pulse_shape], radar.samples_per_pulse)

    def receive(self, video: npt.NDArray[np.generic], reception: Reception) -> None:
        """Fill the video of successive pulses.

        Args:
            video: samples to write, shape (pulses, cells).
            reception: what reaches the receiver in them.
        """
        voltage = self._draw(len(video))
        noise = reception.noise_power()
        if noise is not None:
            voltage *= np.sqrt(noise)[:, None, :]
        echoes, field = reception.signals(self._spread)
        if field is not None:
            voltage[:, 0] += field.real
            voltage[:, 1] += field.imag
        # One pulse may have several echoes in a cell, which an indexed sum would count once.
        row = echoes.pulse - reception.first
        np.add.at(voltage[:, 0], (row, echoes.cell), echoes.amplitude.real.astype(np.float32))
        np.add.at(voltage[:, 1], (row, echoes.cell), echoes.amplitude.imag.astype(np.float32))
        power = np.square(voltage[:, 0])
        power += np.square(voltage[:, 1])
        power *= np.float32(0.5)
        self._digitiser.digitise(power, video)

    def _draw(self, pulses: int) -> Float32Array:
        """Noise in two quadratures, variance one each, shape (pulses, 2, cells)."""
        margin = len(self._noise) - 1
        white = self._rng.standard_normal((pulses, 2, self._cells + margin), dtype=np.float32)
        noise = convolve1d(white, self._noise, axis=-1, mode="constant")
        first = len(self._noise) // 2
        return np.ascontiguousarray(noise[..., first : first + self._cells])

    def _spread(self, field: Complex64Array) -> Complex64Array:
        spread = np.empty_like(field)
        for part in ("real", "imag"):
            filtered = convolve1d(getattr(field, part), self._clutter, axis=-1, mode="constant")
            setattr(spread, part, filtered)
        return spread


def noise_kernel(shape: str, samples: int) -> FloatArray:
    """Filter that gives white noise the correlation of a response.

    Args:
        shape: name in `PULSE_RESPONSES`.
        samples: cells in a pulse.

    Returns:
        Weights whose squares sum to one, shape (weights,).
    """
    if shape == "rectangular":
        # The pulse itself: its correlation with itself is the triangle.
        return np.full(samples, samples**-0.5)
    response = PULSE_RESPONSES[shape]
    reach = int(np.ceil(response.noise_extent * samples))
    lag = np.concatenate([np.arange(2 * reach), np.arange(-2 * reach, 0)])
    spectrum = np.maximum(np.fft.fft(response.correlation(lag / samples)).real, 0.0)
    return _trimmed(np.fft.fftshift(np.fft.ifft(np.sqrt(spectrum)).real))


def clutter_kernel(response: PulseResponse, samples: int) -> FloatArray:
    """Filter that spreads scatterers of independent phase along range as echoes are, their mean power kept.

    Args:
        response: pulse and noise along range.
        samples: cells in a pulse.

    Returns:
        Weights whose squares sum to one, shape (weights,).
    """
    reach = int(np.ceil(response.echo_extent * samples))
    return _trimmed(response.echo(np.arange(-reach, reach + 1) / samples))


def _trimmed(kernel: FloatArray) -> FloatArray:
    kept = np.flatnonzero(np.abs(kernel) > _NEGLIGIBLE * np.abs(kernel).max())
    kernel = kernel[kept[0] : kept[-1] + 1]
    return np.asarray(kernel / np.sqrt(np.sum(np.square(kernel))))
