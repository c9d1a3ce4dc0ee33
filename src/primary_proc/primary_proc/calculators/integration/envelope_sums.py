# SPDX-License-Identifier: Apache-2.0
"""Law of a weighted sum over the pulses of one burst: of envelopes, of their squares, of any function of them."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import numpy.typing as npt
from scipy.optimize import brentq

from primary_proc.calculators.pulse.target_models import TARGETS

FloatArray = npt.NDArray[np.float64]

_LEAST = 1e-13
_MOST_FREQUENCIES = 4096
_REACH = 14.0
_STEP = 0.02
_ROOM = 9.5


class SumLaw:
    """Distribution of a sum by inversion of its characteristic function.

    Source: J. Gil-Pelaez, Biometrika 38, 1951; J. P. Imhof, Biometrika 48, 1961. By the midpoint rule, which is exact
    but for what lies further from the threshold than `reach`.
    """

    def __init__(
        self,
        characteristic: Callable[[FloatArray], npt.NDArray[np.complex128]],
        mean: float,
        spread: float,
    ) -> None:
        """Evaluate the characteristic function until it has died away.

        Args:
            characteristic: E exp(i u s) for frequencies u, shape (n,).
            mean: of the sum.
            spread: its standard deviation.
        """
        self._mean, self._spread = mean, spread
        step = math.pi / (2.0 * _REACH * spread)
        count = 512
        while True:
            frequency = np.arange(0.5, count, dtype=float) * step
            value = characteristic(frequency)
            if abs(value[-1]) < _LEAST or count >= _MOST_FREQUENCIES:
                break
            count *= 2
        self._frequency = frequency
        self._weight = value / (np.pi * (np.arange(count) + 0.5))

    def exceedance(self, threshold: float) -> float:
        """Probability that the sum exceeds a threshold.

        Args:
            threshold: on the sum.

        Returns:
            Probability, to about 1e-11 from eight equal pulses on; of three it has three digits in the tail.
        """
        turned = self._weight * np.exp(-1j * self._frequency * threshold)
        return float(np.clip(0.5 + turned.imag.sum(), 0.0, 1.0))

    def threshold(self, probability: float) -> float:
        """Threshold that the sum exceeds with a probability: Neyman and Pearson's, (1.49), in noise.

        Args:
            probability: in (1e-12, 1).

        Returns:
            Threshold on the sum.
        """
        low, high = (self._mean + side * _REACH * self._spread for side in (-1.0, 1.0))
        return float(brentq(lambda t: self.exceedance(t) - probability, low, high, xtol=1e-10))


def square_sum_law(
    weights: npt.ArrayLike, amplitude: npt.ArrayLike = 0.0, *, fast: bool = False
) -> SumLaw:
    """Law of sum w x^2, a weighted sum of chi-squared variables of two degrees of freedom.

    Source: Kuzmin 1967, § 1.3.3, square-law detector; its law is not in the book.

    Args:
        weights: w of each pulse, positive, shape (pulses,).
        amplitude: rms amplitude of the target over the noise's sigma on each pulse, shape (pulses,) or one for all.
        fast: whether the target fluctuates from pulse to pulse; otherwise it is steady.

    Returns:
        The law.
    """
    factor = np.asarray(weights, dtype=float)
    energy = np.broadcast_to(np.square(np.asarray(amplitude, dtype=float)), factor.shape)
    if fast:
        factor, energy = factor * (1.0 + energy / 2.0), np.zeros(factor.shape)

    def characteristic(frequency: FloatArray) -> npt.NDArray[np.complex128]:
        turn = 1j * frequency[:, None] * factor
        left = 1.0 - 2.0 * turn
        return np.exp((turn * energy / left - np.log(left)).sum(axis=1))

    mean = float((factor * (2.0 + energy)).sum())
    spread = float(np.sqrt((factor**2 * (4.0 + 4.0 * energy)).sum()))
    return SumLaw(characteristic, mean, spread)


def envelope_sum_law(
    scores: Callable[[FloatArray], FloatArray],
    amplitude: npt.ArrayLike,
    target: str = "steady",
) -> SumLaw:
    """Law of a sum of functions of the envelopes of independent pulses.

    Source: Kuzmin 1967, (1.50) and § 1.3.3; the laws are not in the book.

    Args:
        scores: from envelopes in units of the noise's sigma, shape (steps,), to what each pulse adds for them, shape
            (pulses, steps).
        amplitude: rms amplitude of the target over the noise's sigma on each pulse, zero for noise, shape (pulses,).
        target: name in `TARGETS`; of what is common to a burst's pulses, its mean.

    Returns:
        The law.
    """
    level = np.asarray(amplitude, dtype=float)
    edge = np.arange(0.0, float(level.max()) * (1.0 if target == "steady" else 6.0) + _ROOM, _STEP)
    over = TARGETS[target].single_pulse(edge, level[:, None])
    chance = -np.diff(over, append=0.0, axis=1)
    value = scores(edge + _STEP / 2.0)
    mean = (chance * value).sum(axis=1)
    variance = (chance * value**2).sum(axis=1) - mean**2
    # Pulses that are alike have one factor, which is worked out once.
    alike: dict[bytes, list[int]] = {}
    for pulse in range(len(level)):
        key = value[pulse].tobytes() + chance[pulse].tobytes()
        alike.setdefault(key, []).append(pulse)

    def characteristic(frequency: FloatArray) -> npt.NDArray[np.complex128]:
        total = np.ones(len(frequency), complex)
        for pulses in alike.values():
            one = np.exp(1j * np.outer(frequency, value[pulses[0]])) @ chance[pulses[0]]
            total *= one ** len(pulses)
        return total

    return SumLaw(characteristic, float(mean.sum()), float(np.sqrt(variance.sum())))
