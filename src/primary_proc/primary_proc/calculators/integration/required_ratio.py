# SPDX-License-Identifier: Apache-2.0
"""The signal-to-noise ratio that a detection probability needs."""

from __future__ import annotations

import math
from typing import Protocol

import numpy as np
import numpy.typing as npt

_LOWEST, _HIGHEST, _STEP = -10.0, 60.0, 2.0
_FINE = 41


class Detects(Protocol):
    """Anything with a detection probability, such as a `SettledMethod`."""

    def detection_probability(self, snr_db: npt.ArrayLike, target: str) -> npt.NDArray[np.float64]:
        """Probability that a target is detected.

        Args:
            snr_db: power over the mean noise power at the beam's axis, any shape.
            target: name in `target_models.TARGETS`.

        Returns:
            Probability, same shape.
        """


def required_snr_db(detector: Detects, probability: float, target: str) -> float:
    """Invert the detection probability: a coarse grid, then a fine one about the place.

    Args:
        detector: with its thresholds.
        probability: wanted, in (0, 1).
        target: name in `target_models.TARGETS`.

    Returns:
        dB, to about 0.01; infinite where no signal is strong enough.
    """
    grid = np.arange(_LOWEST, _HIGHEST + _STEP, _STEP)
    enough = np.flatnonzero(detector.detection_probability(grid, target) >= probability)
    if not len(enough):
        return math.inf
    if not enough[0]:
        return float(grid[0])
    fine = np.linspace(grid[enough[0] - 1], grid[enough[0]], _FINE)
    found = np.maximum.accumulate(detector.detection_probability(fine, target))
    return float(np.interp(probability, found, fine))
