# SPDX-License-Identifier: Apache-2.0
"""Binary quantisation and an automaton, set up for one radar."""

from __future__ import annotations

from functools import cached_property

import numpy as np
import numpy.typing as npt

from primary_proc.automata.automaton_chain import bursts_without
from primary_proc.automata.burst_rule import BurstRule
from primary_proc.calculators.azimuth.accuracy_table import AccuracyTable, accuracy_table
from primary_proc.calculators.bursts.detection_probability import detection_in_the_beam
from primary_proc.calculators.bursts.false_alarms import (
    false_plots_per_scan,
    false_start_probability,
    noise_probability_for_rate,
)
from primary_proc.detectors.burst_detector import BurstDetector
from primary_proc.detectors.table_detector import TableDetector
from primary_proc.methods.detection_method import FloatArray, SettledMethod
from primary_proc.methods.requirements import Requirements
from primary_proc.normalisers.normaliser import Normaliser
from primary_proc.quantisers.binary_quantiser import BinaryQuantiser

_SHARES = 25


class SettledRule(SettledMethod):
    """A rule on bits with the first threshold that gives the wanted false plots."""

    def __init__(self, rule: BurstRule, requirements: Requirements) -> None:
        """Invert the false-plot rate.

        Args:
            rule: of the detector.
            requirements: what is asked.

        Raises:
            ValueError: the rate is out of reach.
        """
        self._rule, self._asked = rule, requirements
        place = requirements.rings, requirements.pulses_per_scan, requirements.gap
        self.noise_probability = noise_probability_for_rate(rule, requirements.false_plots, *place)
        self.false_starts = false_start_probability(rule, self.noise_probability)
        self.false_plots = false_plots_per_scan(rule, self.noise_probability, *place)

    @property
    def rule(self) -> BurstRule:
        """What the detector looks for."""
        return self._rule

    @cached_property
    def accuracy(self) -> AccuracyTable:
        """From the exact chain; see `SettledMethod.accuracy`."""
        asked = self._asked
        return accuracy_table(
            self._rule, self.noise_probability, asked.pattern, asked.pulses, asked.target
        )

    def detection_probability(self, snr_db: npt.ArrayLike, target: str) -> FloatArray:
        """From the absorbing chain; see `SettledMethod.detection_probability`.

        Args:
            snr_db: any shape.
            target: name in `target_models.TARGETS`.

        Returns:
            Same shape.
        """
        asked = self._asked
        return detection_in_the_beam(
            self._rule, self.noise_probability, asked.pattern, asked.pulses, snr_db, target
        )

    def quality(self, chance: FloatArray) -> FloatArray:
        """From the number of ones in bursts of noise; see `SettledMethod.quality`.

        Args:
            chance: shape (n,).

        Returns:
            Shape (n,).
        """
        share, weaker = self._peaks
        return np.asarray(np.interp(chance / self.noise_probability, share, weaker))

    @cached_property
    def _peaks(self) -> tuple[FloatArray, FloatArray]:
        """Shares of the ones that exceed a peak, and of the bursts of noise that do not."""
        share = np.linspace(0.0, 1.0, _SHARES) ** 2
        automaton = self._rule.automaton
        weaker = [bursts_without(automaton, self.noise_probability, each) for each in share]
        return share, np.clip(weaker, 0.0, 1.0)

    def quantiser(self, normaliser: Normaliser) -> BinaryQuantiser:
        """Make the quantiser.

        Args:
            normaliser: that the ratios come from.

        Returns:
            The quantiser.
        """
        return BinaryQuantiser(normaliser.threshold(self.noise_probability))

    def detector(self, rings: int, longest: int) -> BurstDetector:
        """Make a detector that steps the rule's automaton.

        Args:
            rings: range rings.
            longest: limit of a burst's length, in pulses.

        Returns:
            The detector.
        """
        return TableDetector(self._rule, rings, longest)
