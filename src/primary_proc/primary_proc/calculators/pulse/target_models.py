# SPDX-License-Identifier: Apache-2.0
"""What targets do from pulse to pulse and from burst to burst: Swerling's cases, as the calculators need them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.special import gammaincinv

from primary_proc.calculators.pulse.single_pulse import fluctuating_probability, steady_probability

FloatArray = npt.NDArray[np.float64]

_NODES = 48
_WEAKEST_DB, _STRONGEST_DB, _GRID_DB = -15.0, 35.0, 0.25


@dataclass(frozen=True, slots=True)
class TargetModel:
    """A fluctuation: what is common to the pulses of a burst, and what each pulse has of its own.

    Attributes:
        single_pulse: probability that one pulse's envelope exceeds a threshold, both in units of the noise's sigma, for
            an rms amplitude a of that pulse; its power over the mean noise power is a^2 / 2.
        factor: amplitude factors common to a burst's pulses, mean square one, shape (nodes,).
        weight: their probabilities, sum one, shape (nodes,).
    """

    single_pulse: Callable[[npt.ArrayLike, npt.ArrayLike], FloatArray]
    factor: FloatArray
    weight: FloatArray

    def average(
        self, curve: Callable[[FloatArray], FloatArray], snr_db: npt.ArrayLike
    ) -> FloatArray:
        """Mean of a detection probability over what bursts have in common.

        Args:
            curve: probability for bursts of known strength against their ratio in dB, shape (n,) to (n,).
            snr_db: mean power over the mean noise power at the beam's axis, any shape.

        Returns:
            Probability, same shape.
        """
        ratio = np.asarray(snr_db, dtype=float)
        if len(self.factor) == 1:
            return np.asarray(curve(ratio.reshape(-1)).reshape(ratio.shape))
        # The curve is smooth: a grid of it serves all strengths, where each would cost a walk through the chain.
        grid = np.arange(_WEAKEST_DB, _STRONGEST_DB, _GRID_DB)
        strength = ratio[..., None] + 20.0 * np.log10(self.factor)
        return np.asarray(np.interp(strength, grid, curve(grid)) @ self.weight)


def _fast(threshold: npt.ArrayLike, amplitude: npt.ArrayLike) -> FloatArray:
    # Kuzmin's k is the rms envelope ratio: the mean power over the noise's is k^2, where that of a is a^2 / 2.
    return fluctuating_probability(threshold, np.asarray(amplitude) / np.sqrt(2.0))


def _fast_dominant(threshold: npt.ArrayLike, amplitude: npt.ArrayLike) -> FloatArray:
    """Power of a pulse with four degrees of freedom (Swerling 1960, case 4, one pulse)."""
    half = np.square(np.asarray(amplitude, dtype=float)) / 4.0
    power = np.square(np.asarray(threshold, dtype=float)) / 2.0
    return np.asarray((1.0 + power * half / np.square(1.0 + half)) * np.exp(-power / (1.0 + half)))


def _burst(degrees: int) -> tuple[FloatArray, FloatArray]:
    """Amplitudes and probabilities of bursts whose power is chi-squared: Gauss's rule on its distribution."""
    node, weight = np.polynomial.legendre.leggauss(_NODES)
    shape = degrees / 2.0
    power = gammaincinv(shape, (node + 1.0) / 2.0) / shape
    return np.sqrt(power), weight / 2.0


_ALONE = (np.ones(1), np.ones(1))

TARGETS = {
    "steady": TargetModel(steady_probability, *_ALONE),
    "slow": TargetModel(steady_probability, *_burst(2)),
    "fast": TargetModel(_fast, *_ALONE),
    "slow-dominant": TargetModel(steady_probability, *_burst(4)),
    "fast-dominant": TargetModel(_fast_dominant, *_ALONE),
}
"""No fluctuation, and Swerling's cases 1 to 4 in this order.

Source: Kuzmin 1967, § 1.2 and (3.18); P. Swerling, IRE Trans. IT-6, 1960.
"""
