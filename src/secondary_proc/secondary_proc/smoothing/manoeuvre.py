# SPDX-License-Identifier: Apache-2.0
"""The one decision that a target manoeuvres, for every smoother that needs it.

Source: Kuzmin 1967, § 4.4.4 and 4.6.6-4.6.7: what was observed is compared with its own error, g standard deviations
of it. In two dimensions the threshold is that of the same false-alarm probability.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from scipy.stats import chi2

from secondary_proc.calculators.manoeuvre_detector import false_manoeuvre_probability
from secondary_proc.motion import FloatArray


class ManoeuvreDetector:
    """Declares manoeuvres at one false-alarm probability, whatever is compared."""

    def __init__(self, sigmas: float) -> None:
        """Set the threshold.

        Args:
            sigmas: g, of one normal variable.
        """
        self.false_probability = float(false_manoeuvre_probability(sigmas))
        """Probability that quiet flight is taken for a manoeuvre, in one comparison."""
        self.thresholds = tuple(float(chi2.isf(self.false_probability, n)) for n in (1, 2))
        """Squares that count as a manoeuvre, in one and in two dimensions."""

    def declared(self, square: FloatArray, dimensions: int) -> npt.NDArray[np.bool_]:
        """Tell manoeuvres from quiet flight.

        Args:
            square: of what was observed, over its variance or normalised by its covariance, any shape.
            dimensions: of what was observed, 1 or 2.

        Returns:
            Verdict, same shape.
        """
        return square > self.thresholds[dimensions - 1]
