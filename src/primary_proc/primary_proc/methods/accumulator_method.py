# SPDX-License-Identifier: Apache-2.0
"""Binary quantisation and an accumulator of positions."""

from __future__ import annotations

from primary_proc.automata.accumulator import Accumulator
from primary_proc.calculators.integration.second_threshold import kuzmin_threshold
from primary_proc.methods.detection_method import DetectionMethod, SettledMethod
from primary_proc.methods.requirements import Requirements
from primary_proc.methods.rule_method import SettledRule


class AccumulatorMethod(DetectionMethod):
    """An accumulator between series of zeros, or from the first one to a series of zeros."""

    fewest_pulses = 2

    def __init__(self, *, from_first_one: bool) -> None:
        """Choose where the count begins.

        Args:
            from_first_one: whether with a one, or with any position after a series of zeros.
        """
        self._from_first_one = from_first_one

    def settle(self, requirements: Requirements) -> SettledMethod:
        """Set both thresholds, the second to 1.5 sqrt(N_0) (3.17) if none is asked; see `DetectionMethod.settle`.

        Args:
            requirements: what is asked.

        Returns:
            The method with its thresholds.
        """
        threshold = requirements.second_threshold or kuzmin_threshold(requirements.pulses)
        rule = Accumulator(threshold, requirements.end_zeros, self._from_first_one)
        return SettledRule(rule, requirements)
