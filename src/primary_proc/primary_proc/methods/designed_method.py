# SPDX-License-Identifier: Apache-2.0
"""The detector that the designer chooses: the program that needs the least signal for what is asked."""

from __future__ import annotations

import math

from primary_proc.automata.program import Program
from primary_proc.calculators.integration.required_ratio import required_snr_db
from primary_proc.methods.detection_method import DetectionMethod, SettledMethod
from primary_proc.methods.program_method import ProgramMethod
from primary_proc.methods.requirements import Requirements

CANDIDATES = ("2/2-2", "2/3-2", "3/3-2", "3/4-2", "4/5-2", "4/6-3", "4/7-4", "5/8-4", "6/8-3")
"""Programs that run 64 rings an operation, from short bursts to long ones."""

_DETECTION = 0.9


class DesignedMethod(DetectionMethod):
    """One of the candidates, chosen when the radar is known."""

    fewest_pulses = 2

    def settle(self, requirements: Requirements) -> SettledMethod:
        """Choose and set up; see `DetectionMethod.settle`.

        Args:
            requirements: what is asked.

        Returns:
            The chosen method with its threshold.

        Raises:
            ValueError: no candidate can meet the requirements.
        """
        return choose_program(requirements)[1]


def choose_program(
    requirements: Requirements, candidates: tuple[str, ...] = CANDIDATES
) -> tuple[str, SettledMethod]:
    """Choose the program that detects 90 % of the targets at the lowest signal-to-noise ratio.

    Args:
        requirements: what is asked; the false plots hold for every candidate.
        candidates: names of programs.

    Returns:
        (name, the method with its threshold).

    Raises:
        ValueError: no candidate can meet the requirements.
    """
    best: tuple[float, str, SettledMethod] | None = None
    reasons = []
    for name in candidates:
        program = Program.parse(name)
        if program.window > requirements.pulses:
            continue
        try:
            settled = ProgramMethod(program).settle(requirements)
        except ValueError as error:
            reasons.append(str(error))
            continue
        needed = required_snr_db(settled, _DETECTION, requirements.target)
        if best is None or needed < best[0]:
            best = needed, name, settled
    if best is None or not math.isfinite(best[0]):
        raise ValueError(
            f"no program of {', '.join(candidates)} meets the requirements"
            + "".join(f"; {reason}" for reason in reasons[:1])
        )
    return best[1], best[2]
