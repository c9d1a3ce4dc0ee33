# SPDX-License-Identifier: Apache-2.0
"""Azimuth of a burst, as a position between pulses; every estimator removes its own bias and states its error."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from primary_proc.estimators.envelopes import Envelopes

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Centres:
    """Where bursts have their middle.

    Attributes:
        position: number of the pulse, with a fraction, shape (n,).
        std: standard deviation in pulses, shape (n,).
    """

    position: FloatArray
    std: FloatArray


class AzimuthEstimator(ABC):
    """Estimates the position of the target under each burst.

    Attributes:
        reach: pulses to either side of a burst's start and end that it looks at again; 0 for none.
    """

    reach: int = 0

    @abstractmethod
    def estimate(self, bursts: npt.NDArray[np.void], envelopes: Envelopes) -> Centres:
        """Estimate positions.

        Args:
            bursts: dtype BURST, powers filled in, shape (n,).
            envelopes: the stored signal.

        Returns:
            Positions and their standard deviations.
        """
