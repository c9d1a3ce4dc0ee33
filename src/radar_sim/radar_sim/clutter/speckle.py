# SPDX-License-Identifier: Apache-2.0
"""Speckle: the sum of many small scatterers of one range cell, which changes slowly from pulse to pulse.

Complex normal, independent from cell to cell, with the pulse-to-pulse correlation of a Gaussian or an exponential
(first-order autoregressive) law. `coherence` is the number of pulses in which it falls to 1/e.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod

import numpy as np
import numpy.typing as npt

from radar_sim.random_phase import ComplexNoise

Float32Array = npt.NDArray[np.float32]
Complex64Array = npt.NDArray[np.complex64]

_KNOTS_IN_COHERENCE = 2.5
_AROUND = np.arange(-1, 3)  # Knots that a pulse between 0 and 1 is interpolated from.
_REACH = 1.2  # Of the filter's weights, in coherence times.
_PULSES_IN_CACHE = 16
_CIRCLE = 256  # Knots; a coherence time of five at most does not meet itself around them.


class Speckle(ABC):
    """Two normal quadratures of variance one in each cell."""

    def __init__(self, rng: np.random.Generator) -> None:
        """Start anywhere.

        Args:
            rng: source of randomness.
        """
        self._source = ComplexNoise(rng)
        self._next = -1
        self._cells = 0

    def signal(self, first: int, pulses: int, cells: int) -> Complex64Array:
        """Continue; pulses that do not follow those before, or other cells, begin anew.

        Args:
            first: number of the first pulse.
            pulses: how many.
            cells: range cells.

        Returns:
            Shape (pulses, cells).
        """
        if first != self._next or cells != self._cells:
            self._cells = cells
            self._restart()
        self._next = first + pulses
        return self._continue(pulses)

    @abstractmethod
    def _restart(self) -> None:
        """Forget the pulses before."""

    @abstractmethod
    def _continue(self, pulses: int) -> Complex64Array:
        """Next pulses, shape (pulses, cells)."""

    def _noise(self, pulses: int) -> Complex64Array:
        return self._source.draw(pulses, self._cells)


class ExponentialSpeckle(Speckle):
    """z[n] = r z[n-1] + sqrt(1 - r²) w[n]: correlation r^|m|."""

    def __init__(self, coherence: float, rng: np.random.Generator) -> None:
        """Set the memory.

        Args:
            coherence: pulses in which the correlation falls to 1/e.
            rng: source of randomness.
        """
        super().__init__(rng)
        self._memory = np.float32(math.exp(-1.0 / coherence))
        self._renewal = np.float32(math.sqrt(1.0 - float(self._memory) ** 2))

    def _restart(self) -> None:
        self._last = self._noise(1)[0]

    def _continue(self, pulses: int) -> Complex64Array:
        signal = self._noise(pulses)
        signal *= self._renewal
        last = self._last
        for row in signal:
            row += self._memory * last
            last = row
        self._last = last.copy()
        return signal


class GaussianSpeckle(Speckle):
    """Correlation exp(-(m / coherence)²): white noise through a filter.

    The filter works at knots some pulses apart. Between knots the process is the best linear estimate from the four
    around, over its known standard deviation; that changes the correlation by less than 0.01.
    """

    def __init__(self, coherence: float, rng: np.random.Generator) -> None:
        """Lay out the filter.

        Args:
            coherence: pulses in which the correlation falls to 1/e.
            rng: source of randomness.
        """
        super().__init__(rng)
        self._step = max(1, math.floor(coherence / _KNOTS_IN_COHERENCE))
        self._weights = _filter_for(coherence / self._step).astype(np.float32)
        self._mix = _interpolation(coherence / self._step, self._step).astype(np.float32)

    def _restart(self) -> None:
        self._done = 0
        self._first_knot = 0
        self._white = self._noise(len(self._weights) - 1)
        self._knots = np.empty((0, self._cells), np.complex64)

    def _continue(self, pulses: int) -> Complex64Array:
        begin, self._done = self._done, self._done + pulses
        first, last = begin // self._step, (self._done - 1) // self._step
        if self._step == 1:
            self._extend(first, last)
            return self._knots.copy()
        self._extend(first, last + len(_AROUND) - 1)
        skip = begin - first * self._step
        rows = self._between(last + 1 - first)[skip : skip + pulses]
        return rows.view(np.complex64)

    def _between(self, groups: int) -> Float32Array:
        """Pulses from the first knot on, quadratures beside each other, shape (groups * step, 2 * cells)."""
        knots = self._knots.view(np.float32)[:, None, :]
        signal = np.empty((groups, self._step, 2 * self._cells), np.float32)
        at_once = max(1, _PULSES_IN_CACHE // self._step)
        share = np.empty_like(signal[:at_once])
        for begin in range(0, groups, at_once):
            end = min(begin + at_once, groups)
            part, other = signal[begin:end], share[: end - begin]
            np.multiply(knots[begin:end], self._mix[0], out=part)
            for place, weights in enumerate(self._mix[1:], 1):
                np.multiply(knots[begin + place : end + place], weights, out=other)
                part += other
        return signal.reshape(-1, 2 * self._cells)

    def _extend(self, first: int, last: int) -> None:
        """Have the knots from first to last, and no others."""
        self._knots = self._knots[first - self._first_knot :]
        self._first_knot = first
        missing = last + 1 - first - len(self._knots)
        if missing <= 0:
            return
        self._white = np.concatenate([self._white, self._noise(missing)])
        filtered = np.zeros((missing, self._cells), np.complex64)
        for place, weight in enumerate(self._weights):
            filtered += weight * self._white[place : place + missing]
        self._white = self._white[missing:]
        self._knots = np.concatenate([self._knots, filtered])


def _filter_for(coherence: float) -> npt.NDArray[np.float64]:
    """Weights whose correlation with themselves is Gaussian: the transform of the root of its spectrum."""
    lag = np.minimum(np.arange(_CIRCLE), _CIRCLE - np.arange(_CIRCLE))
    spectrum = np.fft.fft(np.exp(-np.square(lag / coherence))).real
    around = np.fft.ifft(np.sqrt(np.maximum(spectrum, 0.0))).real
    reach = math.ceil(_REACH * coherence) + 1
    weights = np.concatenate([around[-reach:], around[: reach + 1]])
    return np.asarray(weights / np.sqrt(np.sum(np.square(weights))))


def _interpolation(coherence: float, step: int) -> npt.NDArray[np.float64]:
    """Weights of the knots around each pulse of a step, shape (knots, step, 1), for unit variance."""
    among = np.exp(-np.square(np.subtract.outer(_AROUND, _AROUND) / coherence))
    towards = np.exp(-np.square(np.subtract.outer(_AROUND, np.arange(step) / step) / coherence))
    weights = np.linalg.solve(among, towards)
    weights /= np.sqrt(np.einsum("if,ij,jf->f", weights, among, weights))
    return np.asarray(weights[:, :, None])
