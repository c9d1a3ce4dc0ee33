# SPDX-License-Identifier: Apache-2.0
"""Binary quantisation and a program detector l/m-k."""

from __future__ import annotations

from primary_proc.automata.program import Program
from primary_proc.detectors.burst_detector import BurstDetector
from primary_proc.detectors.program_detector import ProgramDetector
from primary_proc.methods.detection_method import DetectionMethod, SettledMethod
from primary_proc.methods.requirements import Requirements
from primary_proc.methods.rule_method import SettledRule


class ProgramMethod(DetectionMethod):
    """A program detector by its l, m and k."""

    def __init__(self, program: Program) -> None:
        """Take the program.

        Args:
            program: l/m-k.
        """
        self._program = program
        self.fewest_pulses = program.ones

    def settle(self, requirements: Requirements) -> SettledMethod:
        """Set the first threshold; see `DetectionMethod.settle`.

        Args:
            requirements: what is asked.

        Returns:
            The method with its threshold.
        """
        return SettledProgram(self._program, requirements)


class SettledProgram(SettledRule):
    """A program with its first threshold."""

    def __init__(self, program: Program, requirements: Requirements) -> None:
        """Invert the false-plot rate.

        Args:
            program: l/m-k.
            requirements: what is asked.

        Raises:
            ValueError: the rate is out of reach.
        """
        super().__init__(program, requirements)
        self._program = program

    def detector(self, rings: int, longest: int) -> BurstDetector:
        """Make a detector, bit-parallel where the program has such a form.

        Args:
            rings: range rings.
            longest: limit of a burst's length, in pulses.

        Returns:
            The detector.
        """
        program = self._program
        if program.ones + program.zeros > program.window:
            return ProgramDetector(program, rings, longest)
        return super().detector(rings, longest)
