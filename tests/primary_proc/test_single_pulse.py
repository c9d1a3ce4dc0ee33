# SPDX-License-Identifier: Apache-2.0
"""Single pulses and the shape of a burst."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import chi2, ncx2

from primary_proc.calculators.pulse.burst_shape import burst_shape, pulses_in_burst
from primary_proc.calculators.pulse.single_pulse import (
    fluctuating_probability,
    steady_probability,
    threshold_for,
)


def test_single_pulse_probabilities():
    assert threshold_for(0.01) == pytest.approx(3.0349, abs=5e-5)
    table = {1: 0.0404, 2: 0.2039, 3: 0.5533, 4: 0.8666, 5: 0.9819}
    for amplitude, value in table.items():
        assert steady_probability(threshold_for(0.01), amplitude) == pytest.approx(value, abs=5e-5)
    assert fluctuating_probability(2.0, [1, 2, 3]) == pytest.approx(
        [0.36788, 0.67032, 0.81873], abs=5e-6
    )
    strong = np.linspace(0, 40, 30)
    assert steady_probability(3.0, strong) == pytest.approx(ncx2.sf(9.0, 2, strong**2), abs=1e-9)


def test_chi_square_is_the_square_of_rayleigh():
    """The threshold is on the envelope in sigmas, whose square is chi-square with two degrees of freedom."""
    assert chi2.sf(threshold_for(0.037) ** 2, 2) == pytest.approx(0.037)


@pytest.mark.parametrize(
    ("pattern", "half_power"), [("sinc2", 0.44294647), ("gaussian", np.sqrt(np.log(2.0)))]
)
def test_beamwidth_is_where_the_pattern_falls_to_one_half(pattern, half_power):
    pulses = pulses_in_burst(pattern, beamwidth=0.02, step=0.001)
    assert pulses == pytest.approx(20.0 / half_power)
    assert burst_shape(pattern, pulses, np.array([-10.0, 10.0]))[:, round(pulses) // 2].max() <= 0.6
    middle = burst_shape(pattern, 11)
    assert middle == pytest.approx(middle[::-1])
    if pattern == "sinc2":
        assert middle[:6] == pytest.approx([0.010, 0.109, 0.334, 0.634, 0.896, 1.0], abs=6e-4)
    else:
        assert middle[:6] == pytest.approx([0.438, 0.589, 0.743, 0.876, 0.967, 1.0], abs=6e-4)
