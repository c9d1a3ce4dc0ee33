# SPDX-License-Identifier: Apache-2.0
"""Located emitters held against the truth."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from radar_common.tables import TrackStatus
from radar_eval.bag_tables import TimedRows
from radar_eval.bearing_evaluation import longest_gap
from radar_eval.bearing_labels import label_identities
from radar_eval.bearing_tables import BearingTables
from radar_eval.errors import ScoreError
from radar_eval.truth_paths import TruthPaths

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class EmitterEvaluation:
    """Emitters held against the truth; one entry a row of a confirmed emitter.

    Attributes:
        rows: of dtype EMITTER, in order of time.
        paths: of the true sources.
        target: index of the true source of the row's identity, FALSE for none.
        x: where it truly was, m east; NaN where there is no truth.
        y: the same, m north.
    """

    rows: TimedRows
    paths: TruthPaths
    target: npt.NDArray[np.int64]
    x: FloatArray
    y: FloatArray

    @property
    def error(self) -> FloatArray:
        """Distance from the true place, m."""
        return np.hypot(self.rows.rows["x"] - self.x, self.rows.rows["y"] - self.y)

    @property
    def counts(self) -> npt.NDArray[np.bool_]:
        """Rows that tell a place, and whose true place is known."""
        return (self.rows.rows["range_known"] != 0) & np.isfinite(self.x)


def evaluate_emitters(tables: BearingTables) -> EmitterEvaluation:
    """Hold emitters against the truth.

    An identity belongs to the source to which it has been nearest in azimuth, for that is known before the range.

    Args:
        tables: what the bag holds.

    Returns:
        The evaluation.

    Raises:
        ScoreError: there is no truth.
    """
    if not len(tables.truth):
        raise ScoreError("no truth in the bag; name a bag that has it with --truth")
    paths = TruthPaths(tables.truth, longest_gap=longest_gap(tables.truth))
    confirmed = tables.emitters.rows["status"] == TrackStatus.CONFIRMED
    rows = TimedRows(
        tables.emitters.rows[confirmed], tables.emitters.time[confirmed], tables.emitters.messages
    )
    target, error = label_identities(rows, paths)
    present, place = paths.columns_at(np.maximum(target, 0), rows.time, "x", "y")
    there = present & np.isfinite(error)
    x, y = (np.where(there, place[name], np.nan) for name in ("x", "y"))
    return EmitterEvaluation(rows, paths, target, x, y)
