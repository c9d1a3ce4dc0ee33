# SPDX-License-Identifier: Apache-2.0
"""Fused bearings and those of both channels held against the truth."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from radar_common.tables import TRUTH
from radar_eval.bag_tables import TimedRows
from radar_eval.bearing_labels import label_identities, label_nearest
from radar_eval.bearing_tables import BearingTables
from radar_eval.errors import ScoreError
from radar_eval.truth_paths import TruthPaths

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]
IntArray = npt.NDArray[np.int64]

_LONGEST_GAP = 10.0
"""Usual intervals between looks for which the truth may be silent about a source that is there."""


@dataclass(frozen=True, slots=True)
class AngleErrors:
    """Angles beside the truth; one entry an angle.

    Attributes:
        time: seconds after the origin.
        target: index of the true source, FALSE for none.
        error: radians; NaN where there is no truth.
        std: told with it, radians.
    """

    time: FloatArray
    target: IntArray
    error: FloatArray
    std: FloatArray

    @property
    def known(self) -> BoolArray:
        """Which of them have a truth."""
        return np.isfinite(self.error)


@dataclass(frozen=True, slots=True)
class BearingEvaluation:
    """Fused bearings held against the truth.

    Attributes:
        tables: what the bag holds.
        paths: of the true sources, directions alone.
        active: errors of the plots.
        passive: errors of the passive bearings.
        fused: errors of the fused bearings.
        jammed: whether the active channel was jammed at the time of each fused bearing; empty where nobody tells.
        silent: whether the passive channel was silent then.
    """

    tables: BearingTables
    paths: TruthPaths
    active: AngleErrors
    passive: AngleErrors
    fused: AngleErrors
    jammed: BoolArray
    silent: BoolArray


def evaluate_bearings(tables: BearingTables) -> BearingEvaluation:
    """Hold fused bearings against the truth.

    Args:
        tables: what the bag holds.

    Returns:
        The evaluation.

    Raises:
        ScoreError: there is no truth.
    """
    source = tables.channels if len(tables.channels) else tables.truth
    if not len(source):
        raise ScoreError("no truth in the bag; name a bag that has it with --truth")
    paths = TruthPaths(_directions(source), longest_gap=longest_gap(source))
    jammed, silent = _disturbances(tables)
    return BearingEvaluation(
        tables,
        paths,
        _errors(tables.active, *label_nearest(tables.active, paths)),
        _errors(tables.passive, *label_nearest(tables.passive, paths)),
        _errors(tables.fused, *label_identities(tables.fused, paths)),
        jammed,
        silent,
    )


def longest_gap(truth: TimedRows) -> float:
    """Tell for how long the truth about a source may be silent.

    Args:
        truth: rows with an id.

    Returns:
        Seconds.
    """
    order = np.lexsort((truth.time, truth.rows["id"]))
    same = np.diff(truth.rows["id"][order]) == 0
    steps = np.diff(truth.time[order])[same]
    return _LONGEST_GAP * float(np.median(steps)) if len(steps) else _LONGEST_GAP


def _directions(source: TimedRows) -> TimedRows:
    # Only directions are compared, so all sources may stand at one distance.
    rows = np.zeros(len(source), TRUTH)
    rows["id"], rows["azimuth"], rows["range"] = source.rows["id"], source.rows["azimuth"], 1.0
    return TimedRows(rows, source.time, source.messages)


def _errors(measured: TimedRows, target: IntArray, error: FloatArray) -> AngleErrors:
    return AngleErrors(measured.time, target, error, measured.rows["azimuth_std"].astype(float))


def _disturbances(tables: BearingTables) -> tuple[BoolArray, BoolArray]:
    channels = tables.channels
    if not len(channels):
        return np.zeros(0, bool), np.zeros(0, bool)
    # A disturbance falls on all sources at once, so the last word about any of them holds.
    latest = np.searchsorted(channels.time, tables.fused.time, side="right") - 1
    rows = channels.rows[np.maximum(latest, 0)]
    return rows["active_health"][:, 0] < 0.5, rows["passive_health"][:, 0] < 0.5
