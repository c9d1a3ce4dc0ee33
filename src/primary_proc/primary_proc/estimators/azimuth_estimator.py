# SPDX-License-Identifier: Apache-2.0
"""Azimuth of a burst, as a position between pulses; every estimator removes its own bias and states its error."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from primary_proc.calculators.accuracy_table import AccuracyTable

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
    """Estimates the position of the target under each burst."""

    @abstractmethod
    def estimate(self, bursts: npt.NDArray[np.void]) -> Centres:
        """Estimate positions.

        Args:
            bursts: dtype BURST, powers filled in, shape (n,).

        Returns:
            Positions and their standard deviations.
        """


class StartEnd(AzimuthEstimator):
    """Middle between start and end, less the bias of the detector at the burst's strength.

    Source: Kuzmin 1967, (3.36), (3.92); the bias is that of the exact chain, not the nominal one.
    """

    def __init__(self, accuracy: AccuracyTable) -> None:
        """Take what the design knows of the detector.

        Args:
            accuracy: bias and standard deviation against peak power.
        """
        self._accuracy = accuracy

    def estimate(self, bursts: npt.NDArray[np.void]) -> Centres:
        """Estimate positions; see `AzimuthEstimator.estimate`.

        Args:
            bursts: dtype BURST, shape (n,).

        Returns:
            Positions; a burst cut off by the limit of its length may have its target anywhere in it.
        """
        bias, std = self._accuracy.look_up(bursts["power"])
        length = bursts["end"] - bursts["start"]
        middle = (bursts["start"] + bursts["end"]) / 2.0
        return Centres(middle - bias, np.where(bursts["overflow"], length / np.sqrt(12.0), std))
