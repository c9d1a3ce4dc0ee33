# SPDX-License-Identifier: Apache-2.0
"""The study of initiation: false tracks an hour against delay of confirmation, for every rule."""

from __future__ import annotations

from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path
from typing import Any

from radar_eval.command_line import progress
from radar_eval.figures.initiation import draw_initiation
from radar_eval.figures.style import as_png
from radar_eval.studies.initiation_trials import (
    DETECTION,
    PERIOD,
    Outcome,
    Rule,
    make_trial,
    rules,
    try_rule,
)

PICTURE = "initiation.png"
FALSE_PLOTS = (50.0, 200.0, 500.0)

_SCANS, _TARGETS, _SEED = 75, 60, 1


def study_initiation(folder: Path) -> dict[str, Any]:
    """Run the study.

    Args:
        folder: where the picture goes.

    Returns:
        All outcomes, for JSON.
    """
    tasks = [(density, rule) for density in reversed(FALSE_PLOTS) for rule in rules()]
    with ProcessPoolExecutor() as pool:
        runs = pool.map(partial(_try, scans=_SCANS, targets=_TARGETS), tasks)
        found = list(progress(runs, "rules", total=len(tasks), unit="rule"))
    (folder / PICTURE).write_bytes(as_png(draw_initiation(found)))
    return {
        "detection_probability": DETECTION,
        "scan_period": PERIOD,
        "scans": _SCANS,
        "targets": _TARGETS,
        "outcomes": [outcome.as_dict() for outcome in found],
    }


def _try(task: tuple[float, Rule], *, scans: int, targets: int) -> Outcome:
    density, rule = task
    return try_rule(make_trial(density, scans, targets, _SEED), rule)
