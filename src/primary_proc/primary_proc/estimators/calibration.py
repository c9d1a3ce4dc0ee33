# SPDX-License-Identifier: Apache-2.0
"""From a way to locate targets to an estimator that knows its errors."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache

from primary_proc.calculators.cfar.equivalent_cells import equivalent_cells
from primary_proc.estimators.azimuth_estimator import AzimuthEstimator
from primary_proc.estimators.locator import CalibratedEstimator, Locator
from primary_proc.estimators.trial_bursts import TrialBursts, trial_bursts
from primary_proc.methods.detection_method import SettledMethod
from primary_proc.methods.requirements import Requirements
from primary_proc.normalisers.normaliser import Normaliser

# A pause of the radar, or a rotation that comes back, must not cost the simulation again.
_REMEMBERED = 4


def calibrated(
    make: Callable[[Requirements, TrialBursts, float], Locator],
) -> Callable[[SettledMethod, Requirements, Normaliser], AzimuthEstimator]:
    """Put simulation of the detector between a locator and its use.

    Args:
        make: makes the locator from the requirements, trial bursts, and p_N of the first threshold.

    Returns:
        What makes the estimator for a detector that is set up and a normaliser.
    """

    @lru_cache(maxsize=_REMEMBERED)
    def learnt(
        method: SettledMethod, requirements: Requirements, loss_db: float
    ) -> AzimuthEstimator:
        noise = method.noise_probability
        trial = trial_bursts(method, requirements, equivalent_cells(noise, loss_db))
        return CalibratedEstimator(make(requirements, trial, noise), trial)

    def estimator(
        method: SettledMethod, requirements: Requirements, normaliser: Normaliser
    ) -> AzimuthEstimator:
        return learnt(method, requirements, normaliser.loss_db(method.noise_probability))

    return estimator
