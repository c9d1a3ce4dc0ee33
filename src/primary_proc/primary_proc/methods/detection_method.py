# SPDX-License-Identifier: Apache-2.0
"""A way to detect bursts: its quantiser, its detector and the calculators that set it up, under one name."""

from __future__ import annotations

from abc import ABC, abstractmethod

import numpy as np
import numpy.typing as npt

from primary_proc.automata.automaton import Program
from primary_proc.calculators.accuracy_table import AccuracyTable, accuracy_table
from primary_proc.calculators.false_alarms import noise_probability_for_rate
from primary_proc.detectors.burst_detector import BurstDetector
from primary_proc.detectors.program_detector import ProgramDetector
from primary_proc.detectors.table_detector import TableDetector
from primary_proc.quantisers.binary_quantiser import BinaryQuantiser


class DetectionMethod(ABC):
    """What the pipeline asks of a way to detect bursts.

    Attributes:
        fewest_pulses: pulses that a burst needs to be detected at all.
        fewest_ones: ones that a detection rests on.
    """

    fewest_pulses: int
    fewest_ones: int

    @abstractmethod
    def noise_probability(
        self, false_plots: float, rings: int, pulses_per_scan: float, gap: int
    ) -> float:
        """Probability of a one in noise for a number of false plots per scan.

        Args:
            false_plots: wanted false plots of the whole coverage in one turn.
            rings: range rings.
            pulses_per_scan: azimuth positions in one turn.
            gap: pulses between bursts that still make one plot.

        Returns:
            p_N.

        Raises:
            ValueError: the rate is out of reach.
        """

    @abstractmethod
    def accuracy(self, noise: float, pattern: str, pulses: float, target: str) -> AccuracyTable:
        """Azimuth accuracy against the burst's peak.

        Args:
            noise: p_N.
            pattern: antenna pattern's name.
            pulses: N_0.
            target: what targets do from pulse to pulse, a name in `accuracy_table.TARGETS`.

        Returns:
            The table.
        """

    @abstractmethod
    def quantiser(self, threshold: npt.NDArray[np.float64]) -> BinaryQuantiser:
        """Make the quantiser that feeds the detector.

        Args:
            threshold: on the ratio of each cell, shape (cells,).

        Returns:
            The quantiser.
        """

    @abstractmethod
    def detector(self, rings: int, longest: int) -> BurstDetector:
        """Make a detector.

        Args:
            rings: range rings.
            longest: limit of a burst's length, in pulses.

        Returns:
            The detector in its initial state.
        """


class ProgramMethod(DetectionMethod):
    """Binary quantisation and a program detector l/m-k."""

    def __init__(self, program: Program) -> None:
        """Take the program.

        Args:
            program: l/m-k.
        """
        self.program = program
        self.fewest_pulses = self.fewest_ones = program.ones

    def noise_probability(
        self, false_plots: float, rings: int, pulses_per_scan: float, gap: int
    ) -> float:
        """Probability of a one in noise; see `DetectionMethod.noise_probability`.

        Args:
            false_plots: wanted false plots per scan.
            rings: range rings.
            pulses_per_scan: azimuth positions in one turn.
            gap: pulses between bursts that still make one plot.

        Returns:
            p_N.
        """
        return noise_probability_for_rate(self.program, false_plots, rings, pulses_per_scan, gap)

    def accuracy(self, noise: float, pattern: str, pulses: float, target: str) -> AccuracyTable:
        """Azimuth accuracy; see `DetectionMethod.accuracy`.

        Args:
            noise: p_N.
            pattern: antenna pattern's name.
            pulses: N_0.
            target: what targets do from pulse to pulse, a name in `accuracy_table.TARGETS`.

        Returns:
            The table.
        """
        return accuracy_table(self.program, noise, pattern, pulses, target)

    def quantiser(self, threshold: npt.NDArray[np.float64]) -> BinaryQuantiser:
        """Make the quantiser.

        Args:
            threshold: shape (cells,).

        Returns:
            The quantiser.
        """
        return BinaryQuantiser(threshold)

    def detector(self, rings: int, longest: int) -> BurstDetector:
        """Make a detector, bit-parallel where the program has such a form.

        Args:
            rings: range rings.
            longest: limit of a burst's length, in pulses.

        Returns:
            The detector.
        """
        program = self.program
        parallel = program.ones + program.zeros > program.window
        kind = ProgramDetector if parallel else TableDetector
        return kind(program, rings, longest)
