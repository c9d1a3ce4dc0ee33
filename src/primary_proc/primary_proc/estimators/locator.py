# SPDX-License-Identifier: Apache-2.0
"""A place for each burst, and what simulation at design time says about its error."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod

import numpy as np
import numpy.typing as npt

from primary_proc.estimators.azimuth_estimator import AzimuthEstimator, Centres
from primary_proc.estimators.envelopes import Envelopes
from primary_proc.estimators.error_table import ErrorTable
from primary_proc.estimators.trial_bursts import TrialBursts

FloatArray = npt.NDArray[np.float64]


class Locator(ABC):
    """Finds where the target is, with whatever bias it has.

    Attributes:
        reach: pulses to either side of a burst that it looks at again; 0 for none.
    """

    reach: int = 0

    @abstractmethod
    def locate(self, bursts: npt.NDArray[np.void], envelopes: Envelopes) -> FloatArray:
        """Locate.

        Args:
            bursts: dtype BURST, powers filled in, shape (n,).
            envelopes: the stored signal.

        Returns:
            Positions in pulses, shape (n,).
        """


class CalibratedEstimator(AzimuthEstimator):
    """A locator less its bias, with its standard deviation, both against the burst's peak."""

    def __init__(self, locator: Locator, trial: TrialBursts) -> None:
        """Let the locator locate targets of known place.

        Args:
            locator: to be used.
            trial: the targets.
        """
        self._locator = locator
        self._lag = trial.lag
        self._errors = ErrorTable.learn(trial, locator.locate(trial.bursts, trial.envelopes))
        # The place may lie before the start by the lag, and what is kept is counted from the start.
        self.reach = locator.reach and locator.reach + math.ceil(max(trial.lag, 0.0))

    def estimate(self, bursts: npt.NDArray[np.void], envelopes: Envelopes) -> Centres:
        """Estimate positions; see `AzimuthEstimator.estimate`.

        Args:
            bursts: dtype BURST, shape (n,).
            envelopes: the stored signal.

        Returns:
            Positions; a burst cut off by the limit of its length may have its target anywhere in it.
        """
        bias, std = self._errors.look_up(bursts["power"])
        cut = bursts["overflow"]
        middle = (bursts["start"] + bursts["end"]) / 2.0 - self._lag
        length = bursts["end"] - bursts["start"]
        place = self._locator.locate(bursts, envelopes) - bias
        return Centres(np.where(cut, middle, place), np.where(cut, length / np.sqrt(12.0), std))
