# SPDX-License-Identifier: Apache-2.0
"""The study of false plots in clutter: what it runs, writes and draws."""

from __future__ import annotations

from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any

from radar_eval.command_line import progress
from radar_eval.figures.clutter_rates import draw_clutter_rates
from radar_eval.figures.style import as_png
from radar_eval.studies.clutter_rates import SCENARIOS, WANTED, Outcome, outcomes
from radar_eval.studies.clutter_scene import STRONG_DB, WEAK_DB, make_scene

PICTURE = "clutter_rates.png"

_TURNS, _TARGETS, _SEED = 20, 30, 1


def study_clutter(folder: Path) -> dict[str, Any]:
    """Run the study.

    Args:
        folder: where the picture goes.

    Returns:
        All outcomes, for JSON.
    """
    with ProcessPoolExecutor() as pool:
        runs = pool.map(_scenario, SCENARIOS)
        each = progress(runs, "scenarios", total=len(SCENARIOS), unit="scenario")
        found = [outcome for outcomes_of_one in each for outcome in outcomes_of_one]
    (folder / PICTURE).write_bytes(as_png(draw_clutter_rates(found)))
    return {
        "wanted_false_plots": WANTED,
        "turns": _TURNS,
        "weak_targets_snr_db": WEAK_DB,
        "strong_targets_snr_db": STRONG_DB,
        "outcomes": [outcome.as_dict() for outcome in found],
    }


def _scenario(name: str) -> list[Outcome]:
    return list(outcomes(make_scene(name, _TURNS, _TARGETS, _SEED)))
