# SPDX-License-Identifier: Apache-2.0
"""Azimuth where the weighted sums to both sides of the beam's axis are equal (Kuzmin 1967, figure 3.5)."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from radar_common.antenna_pattern import PATTERNS

FloatArray = npt.NDArray[np.float64]
Weights = Callable[[FloatArray, FloatArray], FloatArray]

_SEARCH = 0.8
_LEAST_SEARCH = 2.0
_FARTHEST = 2.8
_FINENESS = 8.0
_CHUNK = 256


class AntisymmetricWeights:
    """Slides weights over a window of samples and finds where their sum crosses zero from + to -.

    The sum is taken at trial azimuths a sixteenth of N_0 apart and the crossing interpolated between two of them.
    The window holds the whole pattern for every trial azimuth, so that the sum of the weights themselves vanishes,
    which (1.71) and (3.20) rest on.

    Attributes:
        reach: pulses to either side of the window's middle.
    """

    def __init__(
        self, pattern: str, pulses: float, amplitudes: FloatArray, potential: Weights
    ) -> None:
        """Make the weights, one set for each strength.

        Args:
            pattern: antenna pattern's name.
            pulses: N_0.
            amplitudes: a_0 that the sets are for, shape (strengths,).
            potential: what the weights are the derivative of by the target's azimuth, from a_0 of shape
                (strengths, 1, 1) and g of shape (window, trials).
        """
        beam, half = PATTERNS[pattern], pulses / 2.0
        search = _SEARCH * half + _LEAST_SEARCH
        self.reach = int(np.ceil(search + min(beam.extent, _FARTHEST) * half))
        self._step = half / _FINENESS
        steps = int(np.ceil(search / self._step))
        self._trials = np.arange(-steps, steps + 1) * self._step
        window = np.arange(-self.reach, self.reach + 1.0)[:, None]
        strength = amplitudes[:, None, None]
        # Differences over a pulse at most give weights also to a pattern with edges.
        shift = min(0.5, self._step)
        later, sooner = (
            potential(strength, beam((window - self._trials + sign * shift) / half))
            for sign in (-1.0, 1.0)
        )
        self._weights = ((later - sooner) / (2.0 * shift)).astype(np.float32)

    def crossing(
        self, samples: FloatArray, strength: npt.NDArray[np.integer], middle: FloatArray
    ) -> FloatArray:
        """Find the crossing nearest to the middle of each burst.

        Args:
            samples: shape (n, 2 reach + 1).
            strength: index of the set of weights, shape (n,).
            middle: where the burst has its middle, in pulses from the window's, shape (n,).

        Returns:
            Pulses from the window's middle, shape (n,); the burst's middle where nothing crosses.
        """
        small = samples.astype(np.float32)[:, None, :]
        sums = np.empty((len(samples), len(self._trials)), np.float32)
        for first in range(0, len(samples), _CHUNK):
            chunk = slice(first, first + _CHUNK)
            sums[chunk] = (small[chunk] @ self._weights[strength[chunk]])[:, 0]
        before, after = sums[:, :-1], sums[:, 1:]
        crosses = (before > 0.0) & (after <= 0.0)
        part = before / np.where(crosses, before - after, 1.0)
        place = self._trials[:-1] + np.where(crosses, part, 0.0) * self._step
        distance = np.where(crosses, np.abs(place - middle[:, None]), np.inf)
        nearest = distance.argmin(axis=1)
        rows = np.arange(len(samples))
        return np.where(crosses[rows, nearest], place[rows, nearest], middle)
