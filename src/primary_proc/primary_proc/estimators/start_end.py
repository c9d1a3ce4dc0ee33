# SPDX-License-Identifier: Apache-2.0
"""The middle between the start and the end of a burst."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from primary_proc.calculators.azimuth.accuracy_table import AccuracyTable
from primary_proc.estimators.azimuth_estimator import AzimuthEstimator, Centres
from primary_proc.estimators.envelopes import Envelopes


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

    def estimate(self, bursts: npt.NDArray[np.void], envelopes: Envelopes) -> Centres:
        """Estimate positions; see `AzimuthEstimator.estimate`.

        Args:
            bursts: dtype BURST, shape (n,).
            envelopes: not used.

        Returns:
            Positions; a burst cut off by the limit of its length may have its target anywhere in it.
        """
        bias, std = self._accuracy.look_up(bursts["power"])
        length = bursts["end"] - bursts["start"]
        middle = (bursts["start"] + bursts["end"]) / 2.0
        return Centres(middle - bias, np.where(bursts["overflow"], length / np.sqrt(12.0), std))
