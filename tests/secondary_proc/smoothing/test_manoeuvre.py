# SPDX-License-Identifier: Apache-2.0
"""One false-alarm probability for all that is compared."""

from __future__ import annotations

import numpy as np
import pytest

from secondary_proc.calculators.manoeuvre_detector import sigmas_for
from secondary_proc.smoothing.manoeuvre import ManoeuvreDetector


@pytest.mark.parametrize("dimensions", [1, 2])
def test_false_manoeuvres_are_as_frequent_as_told(dimensions):
    trials, sigmas = 200_000, 2.0
    detector = ManoeuvreDetector(sigmas)
    values = np.random.default_rng(dimensions).standard_normal((trials, dimensions))
    share = detector.declared((values**2).sum(axis=1), dimensions).mean()
    probability = detector.false_probability
    assert share == pytest.approx(probability, abs=4.0 * np.sqrt(probability / trials))
    assert sigmas_for(probability) == pytest.approx(sigmas)


def test_the_default_is_once_in_370_plots():
    assert 1.0 / ManoeuvreDetector(3.0).false_probability == pytest.approx(370.4, abs=0.1)
    assert 1.0 / ManoeuvreDetector(2.0).false_probability == pytest.approx(22.0, abs=0.1)
