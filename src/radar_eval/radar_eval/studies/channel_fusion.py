# SPDX-License-Identifier: Apache-2.0
"""What two disturbed channels together bring against each alone, moment by moment."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from bearing_tracker.fusion import FILTERS
from radar_eval.command_line import progress
from radar_eval.figures.channel_fusion import draw_channel_fusion
from radar_eval.figures.style import as_png
from radar_eval.published.detkov_trials import (
    COLUMNS,
    REGRESSION,
    Followed,
    Trials,
    follow,
    normalised_error,
    simulate,
)

PICTURE = "channel_fusion.png"

_RUNS, _SEED, _SHOWN = 300, 2022, 0
_FILTERS = ("dcmp", "kalman", "oracle")


def study_channel_fusion(folder: Path) -> dict[str, Any]:
    """Run the study.

    Args:
        folder: where the picture goes.

    Returns:
        Errors of the bearing by filter, channels and part of the run, for JSON.
    """
    return measure_channel_fusion(folder, _RUNS)


def measure_channel_fusion(folder: Path, runs: int) -> dict[str, Any]:
    """Follow runs of the paper's test and draw the first one.

    Args:
        folder: where the picture goes.
        runs: number of them.

    Returns:
        As the study.
    """
    trials = simulate(REGRESSION, runs, np.random.default_rng(_SEED))
    followed = {
        name: follow(REGRESSION, trials, FILTERS[name](REGRESSION.channels), ["mmse"])
        for name in progress(_FILTERS, "filters", unit="filter")
    }
    figure = draw_channel_fusion(REGRESSION, trials, followed, _SHOWN)
    (folder / PICTURE).write_bytes(as_png(figure, dpi=120))
    return {
        "runs": runs,
        "rms": {name: _errors(answers, trials) for name, answers in followed.items()},
        "normalised_error": {
            name: dict(
                zip(COLUMNS, normalised_error(answers, trials, "mmse").tolist(), strict=True)
            )
            for name, answers in followed.items()
        },
    }


def _errors(followed: Followed, trials: Trials) -> dict[str, dict[str, float]]:
    jammed, silent = (states == 1 for states in REGRESSION.states)
    parts: dict[str, npt.NDArray[np.bool_]] = {
        "undisturbed": ~(jammed | silent),
        "active jammed": jammed,
        "passive silent": silent,
    }
    error = followed.mean["mmse"][..., 0] - trials.truth[:, None, :, 0]
    return {
        part: dict(
            zip(COLUMNS, np.sqrt(np.mean(error[steps] ** 2, axis=(0, 2))).tolist(), strict=True)
        )
        for part, steps in parts.items()
    }
