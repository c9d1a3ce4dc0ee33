# SPDX-License-Identifier: Apache-2.0
"""Maximum likelihood on the stored signal: antisymmetric weights on bits and on amplitudes."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from primary_proc.calculators.pulse.single_pulse import threshold_for
from primary_proc.calculators.pulse.target_models import TARGETS
from primary_proc.estimators.antisymmetric_weights import AntisymmetricWeights, Weights
from primary_proc.estimators.burst_windows import burst_windows
from primary_proc.estimators.envelopes import Envelopes
from primary_proc.estimators.locator import FloatArray, Locator
from primary_proc.estimators.trial_bursts import TrialBursts
from primary_proc.methods.requirements import Requirements

# A weight is a derivative of ln(p / q); nothing is certain enough for more than this.
_SUREST = 1e-3


class WeightedLocator(Locator):
    """Zero crossing of an antisymmetrically weighted sum, the weights chosen by the burst's peak."""

    def __init__(
        self,
        requirements: Requirements,
        trial: TrialBursts,
        potential: Weights,
        sample: Callable[[FloatArray], FloatArray],
        in_noise: float,
    ) -> None:
        """Make the weights.

        Args:
            requirements: of the beam.
            trial: strengths, and the peaks they have.
            potential: what the weights are the derivative of; see `AntisymmetricWeights`.
            sample: from envelopes to what is weighted.
            in_noise: mean of the sample in noise, which stands for pulses that were not seen.
        """
        self._weights = AntisymmetricWeights(
            requirements.pattern, requirements.pulses, trial.amplitudes, potential
        )
        self._sample, self._in_noise = sample, in_noise
        self._lag, self._margin = trial.lag, requirements.gap
        self._between = np.sqrt(trial.powers[1:] * trial.powers[:-1])
        self.reach = self._weights.reach

    def locate(self, bursts: npt.NDArray[np.void], envelopes: Envelopes) -> FloatArray:
        """Locate; see `Locator.locate`.

        Args:
            bursts: dtype BURST, shape (n,).
            envelopes: the stored signal.

        Returns:
            Positions.
        """
        windows = burst_windows(bursts, envelopes, self.reach, self._lag, self._margin)
        samples = np.where(windows.known, self._sample(windows.envelope), self._in_noise)
        strength = np.searchsorted(self._between, bursts["power"])
        return windows.centre + self._weights.crossing(samples, strength, windows.middle)


def binary_locator(
    requirements: Requirements, trial: TrialBursts, noise_probability: float
) -> WeightedLocator:
    """Make the locator on stored bits.

    Source: Kuzmin 1967, (3.22)-(3.23): the weight (dp / d beta) / (p q) is the derivative of ln(p / q).

    Args:
        requirements: of the beam and what targets do.
        trial: strengths, and the peaks they have.
        noise_probability: p_N of the first threshold.

    Returns:
        The locator.
    """
    threshold = float(threshold_for(noise_probability))
    single_pulse = TARGETS[requirements.target].single_pulse

    def log_odds(strength: FloatArray, shape: FloatArray) -> FloatArray:
        one = np.minimum(single_pulse(threshold, strength * shape), 1.0 - _SUREST)
        return np.asarray(np.log(one / (1.0 - one)))

    def bits(envelope: FloatArray) -> FloatArray:
        return (envelope > threshold).astype(float)

    return WeightedLocator(requirements, trial, log_odds, bits, noise_probability)


def amplitude_locator(
    requirements: Requirements, trial: TrialBursts, noise_probability: float
) -> WeightedLocator:
    """Make the locator on stored amplitudes.

    Source: Kuzmin 1967, (1.72)-(1.73) for targets that keep their strength within a burst; (1.74)-(1.75), the exponent
    being 2, for those that do not: there g g' / (1 + k_0^2 g^2)^2 is the derivative of -1 / (2 k_0^2 (1 + k_0^2 g^2)).

    Args:
        requirements: of the beam and what targets do.
        trial: strengths, and the peaks they have.
        noise_probability: not used.

    Returns:
        The locator.
    """
    if not requirements.target.startswith("fast"):
        return WeightedLocator(
            requirements, trial, _shape_alone, lambda envelope: envelope, np.sqrt(np.pi / 2.0)
        )
    return WeightedLocator(requirements, trial, _fast_potential, np.square, 2.0)


def _shape_alone(strength: FloatArray, shape: FloatArray) -> FloatArray:
    return np.broadcast_to(shape, np.broadcast_shapes(strength.shape, shape.shape))


def _fast_potential(strength: FloatArray, shape: FloatArray) -> FloatArray:
    # a^2 / 2 is the power over the noise's, which Kuzmin calls k^2 for targets that fluctuate.
    power = strength**2 / 2.0
    return -1.0 / (2.0 * power * (1.0 + power * shape**2))
