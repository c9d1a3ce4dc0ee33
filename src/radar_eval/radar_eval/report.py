# SPDX-License-Identifier: Apache-2.0
"""The report on a bag: one page that holds everything, the picture by itself, and the scores for machines."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import jinja2

from radar_common.health import Health
from radar_eval.command_line import finite
from radar_eval.errors import EvaluationError
from radar_eval.evaluation import Evaluation
from radar_eval.figures.fused_bearings import draw_fused_bearings
from radar_eval.figures.life_chart import MOST_LINES, draw_life_chart
from radar_eval.figures.located_emitters import draw_located_emitters
from radar_eval.figures.over_range import draw_over_range
from radar_eval.figures.over_time import draw_over_time
from radar_eval.figures.ppi import draw_ppi
from radar_eval.figures.style import as_png, as_svg, png_uri
from radar_eval.metrics.continuity import ends_of_tracks
from radar_eval.run_record import RunRecord
from radar_eval.score_names import describe_scores
from radar_eval.whole_bag import WholeBag

PAGE, PICTURE, SCORES = "index.html", "ppi.png", "scores.json"

_SECTIONS = {
    "Tracks": (
        "targets", "targets_tracked", "targets_missed", "tracks_per_target", "plots_in_tracks",
        "completeness", "confirmed_tracks", "false_tracks", "scans_to_confirmation_mean",
        "scans_to_confirmation_median",
    ),
    "Position": (
        "rms_raw_m", "rms_tracked_m", "rms_raw_of_tracked_m", "rms_tracked_any_plot_m",
        "rms_velocity_m_s", "nis_mean", "gospa_m",
        "gospa_missed", "gospa_false", "gospa_cutoff_m",
    ),
    "Plots": (
        "plots", "plots_per_scan", "false_plots_per_scan", "looks", "probability_of_detection",
    ),
    "Fused bearings": (
        "fused_targets", "fused_targets_false", "fused_bearings", "rms_fused_mrad", "rms_active_mrad",
        "rms_passive_mrad", "fused_error_normalised", "active_state_right", "passive_state_right",
    ),
    "Emitters": (
        "emitters", "emitters_false", "emitters_located", "emitter_rows_range_known",
        "rms_emitter_m", "rms_emitter_bound_m", "rms_emitter_last_m", "rms_emitter_last_bound_m",
        "emitter_error_normalised",
    ),
    "Recording": ("scans", "scan_period_s", "duration_s", "plots_per_second"),
}  # fmt: skip
_HEADLINES = (
    ("targets_tracked", "targets tracked"),
    ("tracks_per_target", "tracks a target"),
    ("plots_in_tracks", "of the plots in tracks"),
    ("false_tracks", "false tracks"),
    ("rms_tracked_m", "m position error"),
    ("rms_fused_mrad", "mrad error of fused bearings"),
    ("emitters_located", "emitters located"),
    ("rms_emitter_last_m", "m error of the last places"),
)


def write_report(
    bag: WholeBag, run: RunRecord | None, read: Health, title: str, out: str | Path
) -> dict[str, Any]:
    """Write the report.

    Args:
        bag: what its results are worth.
        run: what the offline run noted down; None if there was none.
        read: what was dropped while reading the bag.
        title: of the page, such as the name of the bag.
        out: folder to write into, made if it is missing; files of an earlier report are replaced.

    Returns:
        The scores.

    Raises:
        EvaluationError: the folder cannot be written.
    """
    scores = bag.scores(run)
    pictures = _pictures_of_radar(bag.radar) if bag.radar is not None else {}
    if bag.bearings is not None:
        pictures["fused_bearings"] = as_svg(draw_fused_bearings(bag.bearings))
    if bag.emitters is not None:
        pictures["located_emitters"] = as_svg(draw_located_emitters(bag.emitters))
    scans = as_png(draw_ppi(bag.radar)) if bag.radar is not None else None
    page = _render(
        title=title,
        headlines=_headlines(scores),
        sections=_sections(scores) | (_ends(bag.radar) if bag.radar is not None else {}),
        ppi=png_uri(scans) if scans is not None else None,
        pictures=pictures,
        targets_left_out=_left_out(bag.radar),
        stages=run.stages if run is not None else {},
        dropped=dict(read.dropped),
    )
    folder = Path(out)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        if scans is not None:
            (folder / PICTURE).write_bytes(scans)
        (folder / PAGE).write_text(page, encoding="utf-8")
        (folder / SCORES).write_text(
            json.dumps(finite(scores), indent=2, allow_nan=False) + "\n", encoding="utf-8"
        )
    except OSError as error:
        raise EvaluationError(f"report {out}: {error.strerror}") from error
    return scores


def _pictures_of_radar(evaluation: Evaluation) -> dict[str, str]:
    return {
        "over_time": as_svg(draw_over_time(evaluation)),
        "over_range": as_svg(draw_over_range(evaluation)),
        "life_chart": as_svg(draw_life_chart(evaluation)),
    }


def _left_out(evaluation: Evaluation | None) -> int:
    return 0 if evaluation is None else max(0, int(evaluation.is_target.sum()) - MOST_LINES)


def _render(**values: Any) -> str:
    environment = jinja2.Environment(
        loader=jinja2.PackageLoader("radar_eval", "templates"),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    return environment.get_template("report.html").render(**values)


def _headlines(scores: dict[str, Any]) -> list[tuple[str, str]]:
    texts = {name: text for name, text, _ in describe_scores(scores)}
    if "targets" in texts:
        texts["targets_tracked"] += f" / {texts['targets']}"
        if scores["plots_in_tracks"] == scores["plots_in_tracks"]:
            texts["plots_in_tracks"] = f"{100.0 * scores['plots_in_tracks']:.1f} %"
    return [(texts[name], meaning) for name, meaning in _HEADLINES if name in texts]


def _ends(evaluation: Evaluation) -> dict[str, list[tuple[str, str, str]]]:
    ends = ends_of_tracks(evaluation)
    return (
        {"Ends of confirmed tracks": [(why, str(number), why) for why, number in ends.items()]}
        if ends
        else {}
    )


def _sections(scores: dict[str, Any]) -> dict[str, list[tuple[str, str, str]]]:
    return {
        section: describe_scores({name: scores[name] for name in names})
        for section, names in _SECTIONS.items()
        if names[0] in scores
    }
