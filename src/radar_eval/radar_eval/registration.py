# SPDX-License-Identifier: Apache-2.0
"""How much a radar's ranges and azimuths are off from a reference, estimated so that outliers do not move it.

The reference is the truth of a bag: positions that the aircraft themselves or a secondary radar tell. Errors of one
aircraft are alike (its transponder's delay, its height), so that not the plots but the aircraft are the independent
witnesses, and the standard errors are those of clustered observations (Huber 1964; Liang, Zeger 1986).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy import stats

from radar_common.frames import wrap_pi
from radar_eval.antenna import estimate_rotation
from radar_eval.bag_tables import BagTables, TimedRows
from radar_eval.errors import ScoreError
from radar_eval.labelling import FALSE, Gates, label_plots
from radar_eval.truth_paths import TruthPaths

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]

_HUBER = 1.345
"""Residuals beyond so many standard deviations lose weight; 95 % efficient where all are normal."""
_ROUNDS, _STEPS = 4, 50
_WIDEST_RANGE, _WIDEST_AZIMUTH = 1500.0, float(np.radians(4.0))
_NARROWEST_SIGMAS = 6.0
_LONGEST_GAP = 10.0
_FEWEST_TARGETS = 3


@dataclass(frozen=True, slots=True)
class Offset:
    """A constant difference from the reference.

    Attributes:
        value: plot minus reference, m or rad.
        standard_error: of the value.
        scatter: of single plots about it, one standard deviation.
    """

    value: float
    standard_error: float
    scatter: float


@dataclass(frozen=True, slots=True)
class Registration:
    """How a radar is set up against a reference.

    Attributes:
        range: m.
        azimuth: rad.
        plots: that were compared.
        targets: that they came from.
    """

    range: Offset
    azimuth: Offset
    plots: int
    targets: int


def register(tables: BagTables, *, nearest: float = 0.0) -> Registration:
    """Estimate the biases of the plots of a bag against its truth.

    The biases found so far are taken off before plots are given to targets again, with gates that shrink to what the
    scatter needs, so that a bias may be larger than the last gate.

    Args:
        tables: plots and truth.
        nearest: m; nearer plots are left out, for there the height of a target makes its slant range longer.

    Returns:
        The biases, to be subtracted from the plots.

    Raises:
        ScoreError: no truth, or plots of fewer than three targets to compare with it.
        RotationError: the plots do not tell how the antenna turned.
    """
    if not len(tables.truth):
        raise ScoreError("a registration needs truth to compare with, and this bag has none")
    plots = tables.plots
    rotation = estimate_rotation(plots.time, plots.rows["azimuth"])
    paths = TruthPaths(tables.truth, longest_gap=_LONGEST_GAP * rotation.period)
    looks = paths.looks(rotation)
    range_bias = azimuth_bias = 0.0
    gates = Gates(_WIDEST_RANGE, _WIDEST_AZIMUTH, 0.1 * rotation.period)
    for _ in range(_ROUNDS):
        moved = _moved(plots, -range_bias, -azimuth_bias)
        target = label_plots(moved, paths, looks, gates).target
        own = np.flatnonzero((target != FALSE) & (moved.rows["range"] >= nearest))
        targets = len(np.unique(target[own]))
        if targets < _FEWEST_TARGETS:
            raise ScoreError(
                f"plots of {targets} targets could be compared with their truth, "
                f"a registration needs {_FEWEST_TARGETS}"
            )
        _, distance, azimuth = paths.polar_at(target[own], plots.time[own])
        in_range = robust_offset(plots.rows["range"][own] - distance, target[own])
        # About the bias found so far, so that no difference wraps.
        turned = wrap_pi(moved.rows["azimuth"][own] - azimuth) + azimuth_bias
        in_azimuth = robust_offset(turned, target[own])
        range_bias, azimuth_bias = in_range.value, in_azimuth.value
        gates = Gates(
            min(_WIDEST_RANGE, _NARROWEST_SIGMAS * in_range.scatter),
            min(_WIDEST_AZIMUTH, _NARROWEST_SIGMAS * in_azimuth.scatter),
            gates.time,
        )
    return Registration(in_range, in_azimuth, len(own), targets)


def robust_offset(difference: FloatArray, target: IntArray) -> Offset:
    """Estimate a constant from observations with outliers and clusters.

    Huber's M-estimator, found by repeated weighting from the median; its standard error is that of the sum of the
    clipped residuals over the targets.

    Args:
        difference: observations, shape (n,), n >= 1.
        target: that each came from, any numbers, shape (n,).

    Returns:
        The constant.
    """
    scatter = float(stats.median_abs_deviation(difference, scale="normal"))
    # Where rounding makes most differences equal, nothing tells outliers from the rest.
    scatter = max(scatter, 1e-12)
    value = float(np.median(difference))
    limit = _HUBER * scatter
    for _ in range(_STEPS):
        residual = np.abs(difference - value)
        weight = np.minimum(1.0, limit / np.maximum(residual, limit))
        before, value = value, float(np.average(difference, weights=weight))
        if abs(value - before) < 1e-9 * scatter:
            break
    clipped = np.clip(difference - value, -limit, limit)
    _, group = np.unique(target, return_inverse=True)
    per_target = np.bincount(group, clipped)
    groups = len(per_target)
    correction = groups / max(groups - 1, 1)
    within = max(int(np.count_nonzero(np.abs(difference - value) < limit)), 1)
    error = float(np.sqrt(correction * np.sum(np.square(per_target)))) / within
    return Offset(value, error, scatter)


def _moved(plots: TimedRows, distance: float, angle: float) -> TimedRows:
    rows = plots.rows.copy()
    rows["range"] += distance
    rows["azimuth"] = np.mod(rows["azimuth"] + angle, 2.0 * np.pi)
    return TimedRows(rows, plots.time, plots.messages)
