# SPDX-License-Identifier: Apache-2.0
"""Video between the samples: the complex voltage of sweeps on a grid much finer than the pulse.

The simulator's video has a few samples a pulse at most. What a threshold does between them, when it is crossed, how
long and how often, needs the waveform itself; this makes it, for the laws of excursions and of the time gate.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from scipy import fft

from radar_common.pulse_response import PulseResponse
from radar_sim.fluctuation import FLUCTUATIONS

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]

# Spectral lines this far below the strongest add nothing that a double could show in the envelope.
_FAINTEST = 1e-12


class WaveformGenerator:
    """Makes sweeps of noise with a given correlation, and pulses to add to them.

    Source: Kuzmin 1967, § 2.3.1, (1.31)-(1.33), (2.18)-(2.21), (2.67).
    """

    def __init__(
        self,
        response: PulseResponse,
        start: float,
        end: float,
        step: float,
        rng: np.random.Generator,
    ) -> None:
        """Lay the grid.

        Args:
            response: pulse and noise along range.
            start: first point, in pulse lengths.
            end: last point, in pulse lengths.
            step: distance of points, in pulse lengths; 0.01 or less for crossings.
            rng: source of all randomness.

        Raises:
            ValueError: the step is not positive or the end lies before the start.
        """
        if not (step > 0.0 and end >= start):
            raise ValueError(f"no grid from {start:g} to {end:g} in steps of {step:g}")
        self._response = response
        self._rng = rng
        self.grid: FloatArray = np.add(start, step * np.arange(round((end - start) / step) + 1))
        # Noise on a circle: its correlation must have died out over the part that is not used.
        points = fft.next_fast_len(len(self.grid) + int(np.ceil(response.noise_extent / step)))
        distance = step * np.minimum(np.arange(points), points - np.arange(points))
        lines = np.maximum(fft.fft(response.correlation(distance)).real, 0.0)
        self._line = np.flatnonzero(lines > _FAINTEST * lines.max())
        self._strength = np.sqrt(lines[self._line] * points)
        self._points = points

    def noise(self, sweeps: int) -> ComplexArray:
        """Draw noise.

        Args:
            sweeps: number of independent sweeps.

        Returns:
            Two quadratures as a complex voltage, variance one each, shape (sweeps, points).
        """
        spectrum = np.zeros((sweeps, self._points), complex)
        draws = self._rng.standard_normal((sweeps, len(self._line), 2))
        spectrum[:, self._line] = self._strength * (draws[..., 0] + 1j * draws[..., 1])
        return np.asarray(fft.ifft(spectrum, overwrite_x=True)[:, : len(self.grid)])

    def pulses(
        self, sweeps: int, amplitude: float, *, centre: float = 0.0, fluctuation: str = "none"
    ) -> ComplexArray:
        """Draw pulses, each with a carrier phase of its own.

        Args:
            sweeps: number of pulses.
            amplitude: a of the middle of a steady pulse, rms a of one that fluctuates from pulse to pulse.
            centre: middle of the pulse, in pulse lengths.
            fluctuation: name in `fluctuation.FLUCTUATIONS`; every sweep is a burst of its own.

        Returns:
            Complex voltage over the noise's sigma, shape (sweeps, points).
        """
        factor = FLUCTUATIONS[fluctuation](sweeps, 1, self._rng)
        return amplitude * factor * self._response.echo(self.grid - centre)
