# SPDX-License-Identifier: Apache-2.0
"""All scores of a bag as one flat object."""

from __future__ import annotations

from typing import Any

from radar_eval.evaluation import Evaluation
from radar_eval.metrics.accuracy import accuracy_scores
from radar_eval.metrics.consistency import consistency_scores
from radar_eval.metrics.continuity import continuity_scores
from radar_eval.metrics.detection import detection_scores
from radar_eval.metrics.set_distance import gospa_scores
from radar_eval.run_record import RunRecord


def compute_scores(evaluation: Evaluation, run: RunRecord | None) -> dict[str, Any]:
    """Compute all scores.

    Args:
        evaluation: of a bag.
        run: what the offline run noted down; None if there was none.

    Returns:
        Names and values as docs/radar_eval.md defines them; NaN where there is nothing to compute from.
    """
    return {
        **continuity_scores(evaluation),
        **accuracy_scores(evaluation),
        **consistency_scores(evaluation),
        **detection_scores(evaluation),
        **gospa_scores(evaluation),
        "scans": round(evaluation.scans),
        "scan_period_s": evaluation.rotation.period,
        "duration_s": evaluation.tables.stop - evaluation.tables.start,
        "plots_per_second": float("nan") if run is None else run.plots_per_second,
    }
