# SPDX-License-Identifier: Apache-2.0
"""`trial`: a recording tracked with more and more false plots, scored by its truth, its worst cases drawn."""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import Any

from radar_common.health import Health
from radar_common.parameters import from_file
from radar_eval.asterix_records import NAUTICAL_MILE
from radar_eval.bag_tables import load_tables
from radar_eval.command_line import finite, not_negative, print_json, progress, run
from radar_eval.errors import EvaluationError
from radar_eval.figures.style import as_png
from radar_eval.figures.worst_cases import draw_case
from radar_eval.metrics.per_target import score_targets
from radar_eval.radar_chain import TRACKER_NODE
from radar_eval.studies.recording import (
    HALVES,
    Recording,
    TrialOptions,
    run_once,
    summarise,
    try_levels,
)
from secondary_proc.parameters import TrackerParameters

_COLUMNS = {
    "false_plots_added": ("false plots", ".0f"),
    "tracks_per_target": ("tracks/target", ".2f"),
    "plots_in_tracks": ("plots in tracks", ".1%"),
    "completeness": ("complete", ".1%"),
    "false_tracks": ("false tracks", ".0f"),
    "false_tracks_per_hour": ("an hour", ".1f"),
    "false_tracks_per_hour_below": ("surely below", ".1f"),
    "switches": ("switches", ".1f"),
    "rms_raw_of_tracked_m": ("plots, m", ".0f"),
    "rms_tracked_m": ("tracks, m", ".0f"),
    "rms_tracked_any_plot_m": ("misled too, m", ".0f"),
    "rms_velocity_m_s": ("m/s", ".1f"),
    "scans_to_confirmation_mean": ("scans to confirm", ".1f"),
}


def main(argv: list[str] | None = None) -> int:
    """Run the command.

    Args:
        argv: arguments; None takes those of the process.

    Returns:
        Exit code.
    """
    parser = argparse.ArgumentParser(prog="trial", description=__doc__)
    parser.add_argument("bag", help="bag with /radar/plots and /truth, as import_asterix makes it")
    parser.add_argument(
        "--false-plots", type=not_negative, nargs="+", default=[0.0, 50.0, 200.0, 500.0],
        metavar="N", help="to add a scan, one level or more (default: 0 50 200 500)",
    )  # fmt: skip
    parser.add_argument(
        "--half", choices=sorted(HALVES), default="second",
        help="of the recording; choose parameters on the first, report the second (the default)",
    )  # fmt: skip
    parser.add_argument(
        "--runs", type=_positive, default=3, metavar="N",
        help="at each level, with false plots of their own (default %(default)s)",
    )  # fmt: skip
    parser.add_argument(
        "--min-range", type=not_negative, default=5.0, metavar="NM",
        help="nearest false plot (default %(default)s)",
    )  # fmt: skip
    parser.add_argument(
        "--max-range", type=not_negative, default=60.0, metavar="NM",
        help="farthest false plot (default %(default)s)",
    )  # fmt: skip
    parser.add_argument(
        "--params", metavar="FILE", help="ROS 2 parameter file with a section for tracker"
    )
    parser.add_argument("--out", metavar="DIR", type=Path, help="folder for scores and pictures")
    parser.add_argument(
        "--worst", type=_positive, default=10, metavar="N",
        help="targets to draw into DIR, those with most trouble (default %(default)s)",
    )  # fmt: skip
    parser.add_argument("--json", action="store_true", help="print the scores for machines")
    return run(_trial, parser.parse_args(argv))


def _positive(text: str) -> int:
    number = int(text)
    if number < 1:
        raise argparse.ArgumentTypeError(f"{text} is not one or more")
    return number


def _trial(arguments: argparse.Namespace) -> int:
    parameters = (
        TrackerParameters()
        if arguments.params is None
        else from_file(TrackerParameters, arguments.params, TRACKER_NODE)
    )
    options = TrialOptions(
        half=arguments.half,
        nearest=arguments.min_range * NAUTICAL_MILE,
        farthest=arguments.max_range * NAUTICAL_MILE,
        parameters=parameters,
    )
    recording = Recording.part(load_tables(arguments.bag, health=Health()), arguments.half)
    levels = list(dict.fromkeys(arguments.false_plots))
    total = sum(arguments.runs if level else 1 for level in levels)
    tries = try_levels(recording, options, levels, arguments.runs)
    scores = list(progress(tries, "tracking", total=total, unit="runs"))
    found: dict[str, Any] = {
        "bag": Path(arguments.bag).resolve().name,
        "half": arguments.half,
        "levels": summarise(scores),
        "runs": scores,
    }
    if arguments.out is not None:
        level = _level_to_draw(levels)
        found["worst"] = _draw_worst(recording, options, level, arguments)
        _write(arguments.out / "trial.json", json.dumps(finite(found), indent=2).encode())
    if arguments.json:
        print_json(found)
    else:
        _print_table(found["levels"])
    return 0


def _level_to_draw(levels: list[float]) -> float:
    """The level of the usual protocol, or the next best."""
    return min(levels, key=lambda level: abs(level - 200.0))


def _draw_worst(
    recording: Recording, options: TrialOptions, level: float, arguments: argparse.Namespace
) -> list[dict[str, Any]]:
    evaluation, _ = run_once(recording, options, level, seed=1)
    targets = score_targets(evaluation)
    cases = []
    for rank, case in enumerate(targets.worst(arguments.worst).tolist(), start=1):
        number = int(evaluation.paths.ids[targets.target[case]])
        name = f"worst_{rank:02d}.png"
        figure = draw_case(evaluation, targets, case, f"{rank}. Target {number:06X}")
        _write(arguments.out / name, as_png(figure, dpi=110))
        cases.append(
            {
                "picture": name,
                "false_plots_added": level,
                "target": number,
                "plots": int(targets.plots[case]),
                "lost": int(targets.lost[case]),
                "tracks": int(targets.tracks[case]),
                "switches": int(targets.switches[case]),
                "rms_m": float(targets.rms[case]),
                "rows_far_off": int(targets.far_off[case]),
            }
        )
    return cases


def _write(path: Path, content: bytes) -> None:
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
    except OSError as error:
        raise EvaluationError(f"cannot write {path}: {error}") from error


def _print_table(levels: list[dict[str, Any]]) -> None:
    names = [name for name, _ in _COLUMNS.values()]
    lines = [[format(level[key], form) for key, (_, form) in _COLUMNS.items()] for level in levels]
    widths = [max(map(len, column)) for column in zip(names, *lines, strict=True)]
    for line in [names, *lines]:
        print("  ".join(cell.rjust(width) for cell, width in zip(line, widths, strict=True)))
