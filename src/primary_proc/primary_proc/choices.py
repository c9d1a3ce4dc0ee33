# SPDX-License-Identifier: Apache-2.0
"""Every choice that a user has by name, and what the name stands for."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

from primary_proc.automata.program import Program
from primary_proc.estimators.azimuth_estimator import AzimuthEstimator
from primary_proc.estimators.calibration import calibrated
from primary_proc.estimators.largest_sum import LargestSum
from primary_proc.estimators.one_end import OneEnd
from primary_proc.estimators.start_end import StartEnd
from primary_proc.estimators.weighted_locators import amplitude_locator, binary_locator
from primary_proc.methods.accumulator_method import AccumulatorMethod
from primary_proc.methods.designed_method import DesignedMethod
from primary_proc.methods.detection_method import DetectionMethod, SettledMethod
from primary_proc.methods.program_method import ProgramMethod
from primary_proc.methods.requirements import Requirements
from primary_proc.methods.sequential_method import SequentialMethod
from primary_proc.methods.window_methods import WINDOW_METHODS
from primary_proc.normalisers.cell_averaging import CellAveraging
from primary_proc.normalisers.clutter_map import ClutterMap
from primary_proc.normalisers.fixed_level import FixedLevel
from primary_proc.normalisers.half_sums import GreatestOf, SmallestOf
from primary_proc.normalisers.map_memory import bins_for
from primary_proc.normalisers.normaliser import Normaliser
from primary_proc.normalisers.ordered_statistic import OrderedStatistic

if TYPE_CHECKING:
    from primary_proc.parameters import ExtractorParameters

RANGE_WINDOWS: dict[str, Callable[[ExtractorParameters, int], Normaliser]] = {
    "cell-averaging": lambda parameters, cells: CellAveraging(
        cells, parameters.reference_cells, parameters.guard_cells
    ),
    "greatest-of": lambda parameters, cells: GreatestOf(
        cells, parameters.reference_cells, parameters.guard_cells
    ),
    "smallest-of": lambda parameters, cells: SmallestOf(
        cells, parameters.reference_cells, parameters.guard_cells
    ),
    "ordered-statistic": lambda parameters, cells: OrderedStatistic(
        cells, parameters.reference_cells, parameters.guard_cells, parameters.order
    ),
}
"""Normalisers that look at reference cells in range, each made for a number of range cells."""

NORMALISERS: dict[str, Callable[[ExtractorParameters, int], Normaliser]] = {
    **RANGE_WINDOWS,
    "clutter-map": lambda parameters, cells: ClutterMap(
        cells,
        parameters.reference_cells,
        parameters.guard_cells,
        parameters.map_weight,
        bins_for(math.radians(parameters.beamwidth_deg), cells),
    ),
    "fixed-level": lambda parameters, cells: FixedLevel(cells, parameters.noise_level),
}
"""Normalisers, each made for a number of range cells."""

METHODS: dict[str, DetectionMethod] = {
    "auto": DesignedMethod(),
    "accumulator-between-zeros": AccumulatorMethod(from_first_one=False),
    "accumulator-from-first-one": AccumulatorMethod(from_first_one=True),
    "sequential": SequentialMethod(),
    **WINDOW_METHODS,
}
"""Burst detectors that have a name of their own; programs are named l/m-k, see `find_method`."""

ESTIMATORS: dict[str, Callable[[SettledMethod, Requirements, Normaliser], AzimuthEstimator]] = {
    "start-end": lambda method, requirements, normaliser: StartEnd(method.accuracy),
    "width": calibrated(OneEnd),
    "weights-binary": calibrated(binary_locator),
    "weights-amplitude": calibrated(amplitude_locator),
    "peak": calibrated(LargestSum),
}
"""Azimuth estimators, each made for a detector that is set up and the normaliser before it."""


def find_method(name: str) -> DetectionMethod:
    """Find a burst detector.

    Args:
        name: one of METHODS, or a program l/m-k such as "3/4-2".

    Returns:
        The way to detect.

    Raises:
        ValueError: the name is neither.
    """
    if name in METHODS:
        return METHODS[name]
    try:
        return ProgramMethod(Program.parse(name))
    except ValueError as error:
        names = ", ".join(METHODS)
        raise ValueError(f"detector {name!r} is none of {names}, and {error}") from error
