# SPDX-License-Identifier: Apache-2.0
"""Binary quantisation and Wald's sequential test on the bits."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import NamedTuple

import numpy as np

from primary_proc.automata.sequential_rule import SequentialTest
from primary_proc.calculators.integration.required_ratio import required_snr_db
from primary_proc.calculators.integration.sequential_analysis import wald_bounds
from primary_proc.calculators.pulse.burst_shape import burst_shape
from primary_proc.calculators.pulse.single_pulse import threshold_for
from primary_proc.calculators.pulse.target_models import TARGETS
from primary_proc.methods.detection_method import DetectionMethod
from primary_proc.methods.requirements import Requirements
from primary_proc.methods.rule_method import SettledRule

MISS = 0.1
"""Wanted probability that a test on the target decides for noise."""

_FIRST_SNR_DB = 8.0
_NEAR_DB = 0.25
_ROUNDS = 4
_FINEST_STEP = 3
_NOISE = np.geomspace(1e-4, 0.3, 200)


class _Bit(NamedTuple):
    """What a bit tells: mean change of the log-likelihood ratio in noise, and the changes on a one and on a zero."""

    drift: float
    one: float
    zero: float


class SequentialMethod(DetectionMethod):
    """A sequential test for the target that it detects with the wanted probability."""

    fewest_pulses = 2

    def settle(self, requirements: Requirements) -> SettledRule:
        """Find the target, its test, and the first threshold; see `DetectionMethod.settle`.

        Weights and bounds are made for a target that is detected with the probability 1 - P_miss; how strong it is
        follows from the test, so that the two are found in turn. At last the first threshold is set so that the test,
        its bounds being on a lattice, has exactly the wanted false plots.

        Args:
            requirements: what is asked.

        Returns:
            The method with its threshold.
        """
        # What a burst's pulses have in common does not change what the pulses tell against each other.
        target = requirements.target if len(TARGETS[requirements.target].factor) == 1 else "steady"
        snr_db = _FIRST_SNR_DB
        for _ in range(_ROUNDS):
            settled = SettledRule(sequential_test(requirements, snr_db, target), requirements)
            needed = required_snr_db(settled, 1.0 - MISS, target)
            if not math.isfinite(needed) or abs(needed - snr_db) < _NEAR_DB:
                break
            snr_db = needed
        return settled


def sequential_test(requirements: Requirements, snr_db: float, target: str) -> SequentialTest:
    """Make the test for targets of one strength.

    The first threshold is where a bit tells most: where the mean change of the log-likelihood ratio on the target is
    largest. Tests follow each other in noise without a pause, so the false alarms of one are the wanted false starts
    a position times the length of a test in noise.

    Args:
        requirements: what is asked.
        snr_db: power over the mean noise power at the beam's axis.
        target: name in `TARGETS`.

    Returns:
        The test on a lattice, its smaller step split into three parts at most.
    """
    bit = _most_telling(requirements, snr_db, target)
    wanted = requirements.false_plots / (requirements.rings * requirements.pulses_per_scan)
    length = max(math.log(1.0 / MISS) / -bit.drift, 1.0)
    lower, upper = np.log(wald_bounds(min(wanted * length, 0.5), MISS))
    ratio = Fraction(bit.one / bit.zero).limit_denominator(_FINEST_STEP)
    if not ratio:
        ratio = Fraction(1, _FINEST_STEP)
    step = bit.zero / ratio.denominator
    return SequentialTest(
        ratio.numerator,
        ratio.denominator,
        math.ceil(upper / step),
        math.ceil(-lower / step),
        math.ceil(requirements.pulses),
    )


def _most_telling(requirements: Requirements, snr_db: float, target: str) -> _Bit:
    amplitude = math.sqrt(2.0) * 10.0 ** (snr_db / 20.0)
    shape = amplitude * burst_shape(requirements.pattern, requirements.pulses)
    signal = TARGETS[target].single_pulse(threshold_for(_NOISE)[:, None], shape).mean(axis=1)
    one = np.log(signal / _NOISE)
    zero = np.log((1.0 - _NOISE) / (1.0 - signal))
    best = int(np.argmax(signal * one - (1.0 - signal) * zero))
    drift = _NOISE * one - (1.0 - _NOISE) * zero
    return _Bit(float(drift[best]), float(one[best]), float(zero[best]))
