# SPDX-License-Identifier: Apache-2.0
"""Azimuth where the symmetrically weighted sum of the bits, which detection rests on, is largest."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from primary_proc.calculators.pulse.single_pulse import threshold_for
from primary_proc.calculators.pulse.target_models import TARGETS
from primary_proc.estimators.burst_windows import burst_windows
from primary_proc.estimators.envelopes import Envelopes
from primary_proc.estimators.locator import FloatArray, Locator
from primary_proc.estimators.trial_bursts import TrialBursts
from primary_proc.methods.requirements import Requirements
from radar_common.antenna_pattern import PATTERNS

_SUREST = 1e-3
_SEARCH = 1.0
_LEAST_SEARCH = 2
_TIE = 1e-4


class LargestSum(Locator):
    """Position of the largest sum of the weights (3.7), one set of them, to one pulse; the middle of equal ones.

    A detector that follows such a sum itself has noted the place in the burst, and that is taken.

    Source: Kuzmin 1967, (3.7), § 3.1.6.
    """

    def __init__(
        self, requirements: Requirements, trial: TrialBursts, noise_probability: float
    ) -> None:
        """Make the weights for the design's signal-to-noise ratio.

        Args:
            requirements: of the beam, what targets do, and the ratio.
            trial: for the detector's lag.
            noise_probability: p_N of the first threshold.
        """
        self._threshold = float(threshold_for(noise_probability))
        self._noise = noise_probability
        self._lag, self._margin = trial.lag, requirements.gap
        beam, half = PATTERNS[requirements.pattern], requirements.pulses / 2.0
        search = int(np.ceil(_SEARCH * half)) + _LEAST_SEARCH
        # Beyond N_0 pulses the weights of any target worth detecting are small (§ 3.1.6).
        self.reach = search + int(np.ceil(half))
        self._shifts = np.arange(-search, search + 1)
        place = np.arange(-self.reach, self.reach + 1)[:, None] - self._shifts
        amplitude = np.sqrt(2.0) * 10.0 ** (requirements.snr_db / 20.0) * beam(place / half)
        one = np.minimum(
            TARGETS[requirements.target].single_pulse(self._threshold, amplitude), 1.0 - _SUREST
        )
        odds = one / (1.0 - one) * (1.0 - noise_probability) / noise_probability
        self._weights = np.where(np.abs(place) <= half, np.log(odds), 0.0).astype(np.float32)

    def locate(self, bursts: npt.NDArray[np.void], envelopes: Envelopes) -> FloatArray:
        """Locate; see `Locator.locate`.

        Args:
            bursts: dtype BURST, shape (n,).
            envelopes: the stored signal.

        Returns:
            Positions.
        """
        noted = bursts["centre"].copy()
        unknown = np.isnan(noted)
        if not unknown.any():
            return noted
        windows = burst_windows(bursts[unknown], envelopes, self.reach, self._lag, self._margin)
        bits = np.where(windows.known, windows.envelope > self._threshold, self._noise)
        sums = bits.astype(np.float32) @ self._weights
        largest = sums >= sums.max(axis=1, keepdims=True) - _TIE
        place = (largest * self._shifts).sum(axis=1) / largest.sum(axis=1)
        noted[unknown] = windows.centre + place
        return noted
