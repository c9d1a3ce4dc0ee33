# SPDX-License-Identifier: Apache-2.0
"""The envelope itself, in steps so fine that nothing is lost, turned into whole scores by tables."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from primary_proc.normalisers.normaliser import Normaliser
from primary_proc.quantisers.quantiser import Quantiser

STEPS_PER_SIGMA = 32
"""Steps of the envelope in one sigma of the noise; their rounding adds a ten thousandth to its variance."""

ENVELOPE_STEPS = 1024
"""Entries of a score table; the envelope is limited at 32 sigma, 27 dB over the mean noise power."""


class AmplitudeQuantiser(Quantiser):
    """Looks the envelope up in one score table for each channel.

    The envelope is sqrt(2 noise_power), which is Rayleigh in noise under every normaliser.
    """

    def __init__(self, normaliser: Normaliser, scores: npt.ArrayLike, counted: int) -> None:
        """Set the tables.

        Args:
            normaliser: that the ratios come from.
            scores: whole score of each step of the envelope, shape (channels, ENVELOPE_STEPS).
            counted: number of the edge of a step over which cells are counted for the diagnostics.
        """
        self._normaliser = normaliser
        self._scores = np.asarray(scores, np.float32)
        self._counted = np.uint16(counted + 1)
        self.ones = 0

    def quantise(self, ratios: npt.NDArray[np.float32]) -> npt.NDArray[np.float32]:
        """Quantise some pulses.

        Args:
            ratios: float32, shape (pulses, cells); NaN counts as an envelope of zero.

        Returns:
            Scores as float32, shape (pulses, channels, cells).
        """
        envelope = self._normaliser.noise_power(ratios)
        np.multiply(envelope, np.float32(2.0 * STEPS_PER_SIGMA**2), out=envelope)
        np.sqrt(envelope, out=envelope)
        np.minimum(envelope, np.float32(ENVELOPE_STEPS - 1), out=envelope)
        step = envelope.astype(np.uint16)
        self.ones = int(np.count_nonzero(step >= self._counted))
        samples = np.empty((len(ratios), len(self._scores), ratios.shape[1]), np.float32)
        for channel, table in enumerate(self._scores):
            samples[:, channel] = table[step]
        return samples
