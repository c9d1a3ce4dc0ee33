# SPDX-License-Identifier: Apache-2.0
"""Every detector, run by the extractor of the node, does what its calculators say: false plots, detection, azimuth."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import binom, poisson

from primary_proc.choices import METHODS
from radar_eval.studies.detector_trials import TrialRadar, count_false_plots, try_targets

CONFIDENCE = 0.999
FALSE_STARTS = 2e-4
DETECTORS = ["3/4-2", "3/3-2", "4/4-3", "3/5-3", *METHODS]
SNR_DB = (3.0, 6.0, 9.0)
LENGTHS = (9.0, 16.0)


@pytest.fixture(scope="module")
def radar():
    return lambda pulses_in_burst: TrialRadar(1024, 96, pulses_in_burst=pulses_in_burst)


@pytest.mark.parametrize("length", LENGTHS)
@pytest.mark.parametrize("detector", DETECTORS)
def test_false_plots_are_as_many_as_predicted(radar, detector, length):
    on_trial = radar(length)
    parameters = on_trial.parameters(detector, FALSE_STARTS)
    found, positions = count_false_plots(on_trial, parameters, 2, np.random.default_rng(1))
    expected = on_trial.design(parameters).method.false_starts * positions
    low, high = poisson.interval(CONFIDENCE, expected)
    assert low <= found <= high


@pytest.mark.parametrize("fluctuation", ["steady", "fast"])
@pytest.mark.parametrize("length", LENGTHS)
@pytest.mark.parametrize("detector", DETECTORS)
def test_targets_are_found_as_often_as_predicted(radar, detector, length, fluctuation):
    on_trial = radar(length)
    parameters = on_trial.parameters(detector, FALSE_STARTS, fluctuation=fluctuation)
    predicted = on_trial.design(parameters).method.detection_probability(SNR_DB, fluctuation)
    rng = np.random.default_rng(2)
    for snr_db, probability in zip(SNR_DB, predicted, strict=True):
        targets = try_targets(on_trial, parameters, snr_db, fluctuation, rng)
        low, high = binom.interval(CONFIDENCE, len(targets.found), probability)
        assert low <= targets.found.sum() <= high, f"{snr_db} dB"
