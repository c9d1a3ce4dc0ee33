# SPDX-License-Identifier: Apache-2.0
"""Azimuth from one end of a burst and the width that bursts of its strength have."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from primary_proc.estimators.envelopes import Envelopes
from primary_proc.estimators.error_table import ErrorTable
from primary_proc.estimators.locator import FloatArray, Locator
from primary_proc.estimators.trial_bursts import TrialBursts
from primary_proc.methods.requirements import Requirements


class OneEnd(Locator):
    """The end (3.37), or the start (3.37a); half the width is the bias that the calibration takes off.

    With the measured width N' itself both are the middle between start and end again. So the width is that of the
    design for the burst's strength. Of the two ends the better one for the detector is taken.

    Source: Kuzmin 1967, (3.37) and (3.37a), there with the start in the place of the end.
    """

    def __init__(
        self, requirements: Requirements, trial: TrialBursts, noise_probability: float
    ) -> None:
        """Choose the end.

        Args:
            requirements: not used.
            trial: bursts whose truth is known.
            noise_probability: not used.
        """
        spread = {
            name: float(np.mean(errors.look_up(trial.bursts["power"])[1]))
            for name in ("end", "start")
            for errors in [ErrorTable.learn(trial, trial.bursts[name].astype(float))]
        }
        self.end = min(spread, key=lambda name: spread[name])

    def locate(self, bursts: npt.NDArray[np.void], envelopes: Envelopes) -> FloatArray:
        """Give the end; see `Locator.locate`.

        Args:
            bursts: dtype BURST, shape (n,).
            envelopes: not used.

        Returns:
            Positions.
        """
        return np.asarray(bursts[self.end].astype(float))
