# SPDX-License-Identifier: Apache-2.0
"""Every detector, run by the extractor of the node, does what its calculators say: false plots, detection, azimuth."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import binom, norm, poisson

from primary_proc.choices import METHODS
from radar_eval.figures.sensitivity import draw_sensitivity
from radar_eval.studies.detector_trials import TrialRadar, count_false_plots, try_targets
from radar_eval.studies.sensitivity import measure_sensitivity

CONFIDENCE = 0.999
FALSE_STARTS = 2e-4
FEW_FALSE_STARTS = 1e-5
RESOLUTION = 1e-3
DETECTORS = ["3/4-2", "3/3-2", "4/4-3", "3/5-3", *METHODS]
SNR_DB = (3.0, 6.0, 9.0)
STRONG_DB = (10.0, 14.0)
STEEPNESS = (
    0.08  # Of the detection probability at 0.9, a dB, where it is flattest: fast targets and 3/4-2.
)
LENGTHS = (pytest.param(9.0, marks=pytest.mark.study), 16.0)


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
        count = len(targets.found)
        # Some predictions are simulated themselves and know no chance smaller than one in some thousand.
        low, _ = binom.interval(CONFIDENCE, count, min(probability, 1.0 - RESOLUTION))
        _, high = binom.interval(CONFIDENCE, count, probability)
        assert low <= targets.found.sum() <= high, f"{snr_db} dB"


@pytest.mark.parametrize("detector", DETECTORS)
def test_azimuths_are_as_accurate_as_predicted(radar, detector):
    """Within 5 %, and what the sample can tell: the spread of a standard deviation is 1 / sqrt(2 n) of it."""
    on_trial = radar(16.0)
    parameters = on_trial.parameters(detector, FEW_FALSE_STARTS)
    predicted = on_trial.design(parameters).method.accuracy.std_at(STRONG_DB)
    rng = np.random.default_rng(3)
    for snr_db, std in zip(STRONG_DB, predicted, strict=True):
        error = try_targets(on_trial, parameters, snr_db, "steady", rng).error
        error = error[np.isfinite(error)]
        chance = norm.isf((1.0 - CONFIDENCE) / 2.0) / np.sqrt(2.0 * len(error))
        assert abs(error.std() / std - 1.0) < 0.05 + chance, f"{snr_db} dB"
        assert abs(error.mean()) < 0.1 * std + 4.0 * std / np.sqrt(len(error)), f"{snr_db} dB"


def test_the_losses_are_measured_and_drawn(radar):
    """Each loss as measured is the predicted one within what the sample can tell, 0.1 dB of the calculator allowed."""
    losses = measure_sensitivity(radar(16.0), ("3/4-2", "likelihood"))
    assert next(loss.loss_db for loss in losses if loss.detector == "likelihood") == 0.0
    for loss in losses:
        chance = norm.isf((1.0 - CONFIDENCE) / 2.0) * np.sqrt(0.09 / loss.targets) / STEEPNESS
        assert abs(loss.measured_loss_db - loss.loss_db) < 0.1 + chance, loss
    picture = draw_sensitivity(losses)
    assert [axes.get_title(loc="left") for axes in picture.axes] == ["steady target", "fast target"]
