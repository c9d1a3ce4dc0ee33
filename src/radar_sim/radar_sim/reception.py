# SPDX-License-Identifier: Apache-2.0
"""What reaches the receiver in successive pulses beside its own noise: signals that add up, and noise that adds up.

Signals are complex amplitudes over the rms of one quadrature of the receiver's noise and add as such. Noise is
independent from pulse to pulse and cell to cell, so its variances add (Kuzmin 1967, § 1.2): receiver, clutter and
jamming make sigma² = sigma_1² + sigma_2² + sigma_3².
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from radar_sim.echoes import Echoes, joined

Float32Array = npt.NDArray[np.float32]
Complex64Array = npt.NDArray[np.complex64]


class Reception:
    """Adds up what all sources contribute to the pulses of one sector.

    Attributes:
        first: number of the first pulse.
        pulses: how many there are.
        cells: range cells of each.
        filled: which pulses have a signal in a whole stretch of cells, shape (pulses,).
    """

    def __init__(self, first: int, pulses: int, cells: int) -> None:
        """Start with nothing but the receiver's noise.

        Args:
            first: number of the first pulse.
            pulses: how many there are.
            cells: range cells of each.
        """
        self.first, self.pulses, self.cells = first, pulses, cells
        self.filled = np.zeros(pulses, dtype=bool)
        self._echoes: list[Echoes] = []
        self._signal: Complex64Array | None = None
        self._pulse_noise = np.zeros(pulses, np.float32)
        self._cell_noise: Float32Array | None = None

    def add_echoes(self, echoes: Echoes) -> None:
        """Add a signal in a few cells.

        Args:
            echoes: all of it within these pulses.
        """
        if len(echoes):
            self._echoes.append(echoes)

    def add_signal(self, begin: int, cell: int, amplitude: Complex64Array) -> None:
        """Add a signal in a block of pulses and cells.

        Args:
            begin: first pulse of the block, counted from `first`.
            cell: first cell of the block.
            amplitude: over the rms of one quadrature of the noise, shape (pulses, cells) of the block.
        """
        if self._signal is None:
            self._signal = np.zeros((self.pulses, self.cells), np.complex64)
        pulses, cells = amplitude.shape
        self._signal[begin : begin + pulses, cell : cell + cells] += amplitude
        self.filled[begin : begin + pulses] = True

    def add_pulse_noise(self, power: Float32Array) -> None:
        """Add noise that is the same in all cells of a pulse.

        Args:
            power: over that of the receiver's noise, shape (pulses,).
        """
        self._pulse_noise += power

    def add_cell_noise(self, begin: int, cell: int, power: Float32Array) -> None:
        """Add noise in a block of pulses and cells.

        Args:
            begin: first pulse of the block, counted from `first`.
            cell: first cell of the block.
            power: over that of the receiver's noise, shape (pulses, cells) of the block.
        """
        if self._cell_noise is None:
            self._cell_noise = np.zeros((self.pulses, self.cells), np.float32)
        pulses, cells = power.shape
        self._cell_noise[begin : begin + pulses, cell : cell + cells] += power

    def noise_power(self) -> Float32Array | None:
        """Sum of the noise powers, that of the receiver being one.

        Returns:
            Shape (pulses, cells) or (pulses, 1); None where there is only the receiver's.
        """
        if self._cell_noise is None and not self._pulse_noise.any():
            return None
        pulse_noise = (self._pulse_noise + np.float32(1.0))[:, None]
        return pulse_noise if self._cell_noise is None else self._cell_noise + pulse_noise

    def signals(
        self, spread: Callable[[Complex64Array], Complex64Array] | None = None
    ) -> tuple[Echoes, Complex64Array | None]:
        """Sum of the signals.

        Args:
            spread: what the pulse makes, along range, of the signal in whole stretches; echoes have it in them.

        Returns:
            (echoes, field): echoes in pulses that are not `filled`, and the complex amplitude of all cells with the
            echoes of the pulses that are, shape (pulses, cells); None where no pulse is filled.
        """
        echoes = joined(*self._echoes)
        if self._signal is None:
            return echoes, None
        if spread is not None:
            self._signal = spread(self._signal)
        within = self.filled[echoes.pulse - self.first]
        inside = echoes.where(within)
        np.add.at(
            self._signal,
            (inside.pulse - self.first, inside.cell),
            inside.amplitude.astype(np.complex64),
        )
        return echoes.where(~within), self._signal
