# SPDX-License-Identifier: Apache-2.0
"""Every choice that a user has by name, and what the name stands for."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from primary_proc.automata.automaton import Program
from primary_proc.calculators.accuracy_table import AccuracyTable
from primary_proc.estimators.azimuth_estimator import AzimuthEstimator, StartEnd
from primary_proc.methods.detection_method import DetectionMethod, ProgramMethod
from primary_proc.normalisers.cell_averaging import CellAveraging
from primary_proc.normalisers.fixed_level import FixedLevel
from primary_proc.normalisers.normaliser import Normaliser

if TYPE_CHECKING:
    from primary_proc.parameters import ExtractorParameters

NORMALISERS: dict[str, Callable[[ExtractorParameters, int], Normaliser]] = {
    "cell-averaging": lambda parameters, cells: CellAveraging(
        cells, parameters.reference_cells, parameters.guard_cells
    ),
    "fixed-level": lambda parameters, cells: FixedLevel(cells, parameters.noise_level),
}
"""Normalisers, each made for a number of range cells."""

METHODS: dict[str, DetectionMethod] = {
    name: ProgramMethod(Program.parse(name)) for name in ("3/4-2", "3/3-2", "4/4-2", "4/4-3")
}
"""Burst detectors with their calculators."""

ESTIMATORS: dict[str, Callable[[AccuracyTable], AzimuthEstimator]] = {"start-end": StartEnd}
"""Azimuth estimators, each made from the accuracy of the detector."""
