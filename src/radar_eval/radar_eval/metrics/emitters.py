# SPDX-License-Identifier: Apache-2.0
"""How far located emitters are from their true places, beside what the bearings allow at best."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from radar_eval.emitter_evaluation import EmitterEvaluation
from radar_eval.labelling import FALSE

FloatArray = npt.NDArray[np.float64]


def emitter_scores(evaluation: EmitterEvaluation) -> dict[str, Any]:
    """Score emitters.

    Args:
        evaluation: of a bag.

    Returns:
        Names and values as docs/radar_eval.md defines them; NaN where there is nothing to compute from.
    """
    rows, error = evaluation.rows.rows, evaluation.error
    ids, counts = rows["id"], evaluation.counts
    bound = rows["bound_std"].astype(float)
    last = last_rows(evaluation)
    return {
        "emitters": len(np.unique(ids)),
        "emitters_false": len(np.unique(ids[evaluation.target == FALSE])),
        "emitters_located": len(np.unique(evaluation.target[last])),
        "emitter_rows_range_known": float(np.mean(rows["range_known"] != 0))
        if len(rows)
        else np.nan,
        "rms_emitter_m": _rms(error[counts]),
        "rms_emitter_bound_m": _rms(bound[counts]),
        "rms_emitter_last_m": _rms(error[last]),
        "rms_emitter_last_bound_m": _rms(bound[last]),
        "emitter_error_normalised": _normalised(evaluation),
    }


def last_rows(evaluation: EmitterEvaluation) -> npt.NDArray[np.int64]:
    """Find the last row of each emitter that tells a place whose truth is known.

    Args:
        evaluation: of a bag.

    Returns:
        Their indices, in order of identities.
    """
    counting = np.flatnonzero(evaluation.counts)[::-1]
    _, first = np.unique(evaluation.rows.rows["id"][counting], return_index=True)
    return counting[first].astype(np.int64)


def _normalised(evaluation: EmitterEvaluation) -> float:
    """Mean squared error in terms of the covariance, a component: 1 where the filter knows its error."""
    counts = evaluation.counts
    rows = evaluation.rows.rows[counts]
    if not len(rows):
        return float("nan")
    apart = np.stack([rows["x"] - evaluation.x[counts], rows["y"] - evaluation.y[counts]], axis=1)
    place = rows["covariance"].reshape(-1, 4, 4)[:, :2, :2].astype(float)
    solved = np.linalg.solve(place, apart[..., None])[..., 0]
    return float(np.mean((apart * solved).sum(axis=1)) / 2.0)


def _rms(values: FloatArray) -> float:
    return float(np.sqrt(np.mean(values**2))) if len(values) else float("nan")
