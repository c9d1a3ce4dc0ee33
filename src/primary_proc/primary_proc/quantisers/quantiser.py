# SPDX-License-Identifier: Apache-2.0
"""What stands between the ratios of a normaliser and a detector: bits, levels, or amplitudes left as they are."""

from __future__ import annotations

from abc import ABC, abstractmethod

import numpy as np
import numpy.typing as npt


class Quantiser(ABC):
    """Makes the samples that a detector works on.

    Attributes:
        ones: cells, among those quantised last, over the level that noise exceeds with the method's noise probability.
    """

    ones: int

    @abstractmethod
    def quantise(self, ratios: npt.NDArray[np.float32]) -> npt.NDArray:
        """Quantise some pulses.

        Args:
            ratios: float32, shape (pulses, cells); may hold NaN and infinity.

        Returns:
            Samples, the first axis being pulses; the detector knows the rest.
        """
