# SPDX-License-Identifier: Apache-2.0
"""How good fused bearings are beside those of either channel, and whether the state of the channels was seen."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from radar_eval.bearing_evaluation import AngleErrors, BearingEvaluation
from radar_eval.labelling import FALSE


def bearing_scores(evaluation: BearingEvaluation) -> dict[str, Any]:
    """Score fused bearings.

    Args:
        evaluation: of a bag.

    Returns:
        Names and values as docs/radar_eval.md defines them; NaN where there is nothing to compute from.
    """
    rows, fused = evaluation.tables.fused.rows, evaluation.fused
    return {
        "fused_targets": len(np.unique(rows["id"])),
        "fused_targets_false": len(np.unique(rows["id"][fused.target == FALSE])),
        "fused_bearings": len(rows),
        "rms_fused_mrad": _rms(fused),
        "rms_active_mrad": _rms(evaluation.active),
        "rms_passive_mrad": _rms(evaluation.passive),
        "fused_error_normalised": _mean((fused.error / fused.std)[fused.known] ** 2),
        "active_state_right": _agreement(rows["active_health"], evaluation.jammed),
        "passive_state_right": _agreement(rows["passive_health"], evaluation.silent),
    }


def _rms(errors: AngleErrors) -> float:
    return 1e3 * float(np.sqrt(_mean(errors.error[errors.known] ** 2)))


def _agreement(health: npt.NDArray[np.float32], disturbed: npt.NDArray[np.bool_]) -> float:
    if not len(disturbed):
        return float("nan")
    told = np.isfinite(health[:, 0])
    likeliest = np.nan_to_num(health[told], nan=-1.0).argmax(axis=1)
    return _mean((likeliest > 0) == disturbed[told])


def _mean(values: npt.NDArray[Any]) -> float:
    return float(np.mean(values)) if len(values) else float("nan")
