# SPDX-License-Identifier: Apache-2.0
"""The study of trackers: ours with all its strategies and Stone Soup's on the same plots; and ours against itself."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from radar_eval.command_line import progress
from radar_eval.evaluation import ScoreOptions
from radar_eval.figures.style import as_png
from radar_eval.figures.tracking import draw_tracking
from radar_eval.figures.tracking_consistency import draw_consistency
from radar_eval.metrics.consistency import PLOT_DEGREES, STATE_DEGREES, bounds_of_mean
from radar_eval.studies.tracking_consistency import ConsistencyRun, mean_over_scans, run_matched
from radar_eval.studies.tracking_scores import (
    Contestant,
    contestants,
    judge,
    score_row,
    simulate,
    track,
)
from radar_eval.studies.tracking_stone_soup import require_stone_soup
from radar_sim.plot_scenes import PLOT_SCENES, plot_scene
from secondary_proc.parameters import TrackerParameters
from secondary_proc.smoothing import SMOOTHERS

TABLE, COMPARISON, CONSISTENCY = "tracking.md", "tracking.png", "tracking_consistency.png"

_SCANS, _SEED, _FLIGHTS, _MATCHED_SCANS = 60, 1, 200, 40
_COLUMNS = {
    "gospa_m": ("GOSPA, m", ".0f"),
    "gospa_localisation_m": ("of it localisation, m", ".0f"),
    "gospa_missed": ("missed", ".2f"),
    "gospa_false": ("false", ".2f"),
    "tracks_per_target": ("tracks a target", ".2f"),
    "plots_in_tracks": ("plots in tracks", ".1%"),
    "false_tracks": ("false tracks", ".0f"),
    "switches": ("switches", ".0f"),
    "position_rms_m": ("position, m", ".0f"),
    "velocity_rms_m_s": ("velocity, m/s", ".1f"),
    "scans_to_confirmation": ("scans to confirm", ".1f"),
    "seconds": ("run time, s", ".2f"),
}


def study_tracking(folder: Path) -> dict[str, Any]:
    """Run the study.

    Args:
        folder: where pictures and the table go.

    Returns:
        All scores and the normalised errors, for JSON.

    Raises:
        EvaluationError: Stone Soup is not installed.
    """
    require_stone_soup()
    with ProcessPoolExecutor() as pool:
        jobs = pool.map(partial(compare, scans=_SCANS, seed=_SEED, who=contestants()), PLOT_SCENES)
        done = progress(jobs, "scenes", total=len(PLOT_SCENES), unit="scene")
        rows = [row for rows_of_one in done for row in rows_of_one]
        default = TrackerParameters().smoother
        names = [default, *(name for name in SMOOTHERS if name != default)]
        matched = list(pool.map(_matched, names))
    cutoff = ScoreOptions().gospa_cutoff
    (folder / COMPARISON).write_bytes(as_png(draw_tracking(rows, cutoff), dpi=130))
    (folder / CONSISTENCY).write_bytes(as_png(draw_consistency(matched, _MATCHED_SCANS), dpi=130))
    (folder / TABLE).write_text(markdown(rows), encoding="utf-8")
    return {
        "scans": _SCANS,
        "seed": _SEED,
        "gospa_cutoff_m": cutoff,
        "rows": rows,
        "consistency": [summarise_run(run, _MATCHED_SCANS) for run in matched],
    }


def compare(
    scene: str, *, scans: int, seed: int, who: Sequence[Contestant]
) -> list[dict[str, Any]]:
    """Let all trackers work on the same plots.

    Args:
        scene: key of PLOT_SCENES.
        scans: turns of the antenna.
        seed: of everything random.
        who: takes part.

    Returns:
        A row for each tracker.
    """
    world = plot_scene(scene, scans=scans)
    plots, truth = simulate(world, seed)
    rows = []
    for contestant in who:
        seconds, tracks = track(contestant, world, plots)
        scores = score_row(judge(world, plots, truth, tracks), seconds)
        rows.append({"scene": scene, "tracker": contestant.name, **scores})
    return rows


def summarise_run(run: ConsistencyRun, scans: int) -> dict[str, Any]:
    """Say how consistent a smoother was.

    Args:
        run: of it.
        scans: of the run.

    Returns:
        Means of NEES and NIS, and the share of the scans whose means lie within the bounds for 95 %.
    """
    return {
        "smoother": run.smoother,
        "flights": run.flights,
        "nees": float(np.mean(run.nees)),
        "nees_within_bounds": _within(run.scan, run.nees, STATE_DEGREES, scans),
        "nis": float(np.mean(run.nis)),
        "nis_within_bounds": _within(run.nis_scan, run.nis, PLOT_DEGREES, scans),
    }


def markdown(rows: Sequence[dict[str, Any]]) -> str:
    """Write the scores as one table.

    Args:
        rows: of `compare`.

    Returns:
        Text with a line for each row.
    """
    names = ["scene", "tracker", *(name for name, _ in _COLUMNS.values())]
    lines = [names, ["---"] * len(names)]
    for row in rows:
        values = [format(row[key], form) for key, (_, form) in _COLUMNS.items()]
        lines.append([row["scene"], row["tracker"], *values])
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def _matched(smoother: str) -> ConsistencyRun:
    return run_matched(flights=_FLIGHTS, scans=_MATCHED_SCANS, seed=_SEED, smoother=smoother)


def _within(scan: Any, value: Any, degrees: int, scans: int) -> float:
    mean, number = mean_over_scans(scan, value, scans)
    some = np.flatnonzero(number)
    bounds = np.array([bounds_of_mean(degrees, int(number[i])) for i in some])
    return float(np.mean((mean[some] >= bounds[:, 0]) & (mean[some] <= bounds[:, 1])))
