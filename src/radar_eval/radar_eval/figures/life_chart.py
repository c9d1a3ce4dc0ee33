# SPDX-License-Identifier: Apache-2.0
"""The lives of the tracks, one line a target: when it was there, when it had a track, and which."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from radar_common.tables import TrackStatus
from radar_eval.evaluation import Evaluation
from radar_eval.figures import style

MOST_LINES = 150
_FALSE_LINE = "no target"
_LABEL_SHARE = 0.025


def draw_life_chart(evaluation: Evaluation) -> Figure:
    """Draw the chart; of very many targets only the first ones that were seen.

    Args:
        evaluation: of a bag.

    Returns:
        The figure, as high as its lines need.
    """
    history = evaluation.history
    targets = np.flatnonzero(evaluation.is_target)
    targets = targets[np.argsort(evaluation.seen_from[targets], kind="stable")][:MOST_LINES]
    line_of = np.full(len(evaluation.paths), -1)
    line_of[targets] = np.arange(len(targets))
    false = np.flatnonzero(history.false)
    lines = len(targets) + (1 if len(false) else 0)
    with style.style():
        figure = Figure(figsize=(9.0, 0.9 + 0.14 * max(lines, 4)), layout="constrained")
        axes = figure.add_subplot()
        axes.barh(
            np.arange(len(targets)),
            evaluation.seen_until[targets] - evaluation.seen_from[targets],
            left=evaluation.seen_from[targets],
            height=0.62,
            color="#e3e8ed",
        )
        until = _last_shown(evaluation)
        shown = np.flatnonzero(history.true & (history.label >= 0))
        shown = shown[line_of[history.label[shown]] >= 0]
        order = shown[np.argsort(history.confirmed_at[shown], kind="stable")]
        successor = _number_within_target(history.label[order])
        # The first track of a target is calm; each further one stands out, for it is a broken track.
        colours = [style.TRACK_COLOUR if n == 0 else style.BAD_COLOUR for n in successor]
        axes.barh(
            line_of[history.label[order]],
            until[order] - history.confirmed_at[order],
            left=history.confirmed_at[order],
            height=0.62,
            color=colours,
            edgecolor="white",
            linewidth=0.6,
        )
        wide = until[order] - history.confirmed_at[order] > _LABEL_SHARE * evaluation.tables.stop
        for track in order[wide]:
            axes.text(
                history.confirmed_at[track], line_of[history.label[track]] + 0.04,
                f" {history.ids[track]}", color="white", fontsize=5.2, va="center", clip_on=True,
            )  # fmt: skip
        axes.barh(
            np.full(len(false), len(targets)),
            until[false] - history.confirmed_at[false],
            left=history.confirmed_at[false],
            height=0.62,
            color="#7f1d1d",
        )
        names = [_target_name(int(number)) for number in evaluation.paths.ids[targets]]
        axes.set_yticks(range(lines), names + [_FALSE_LINE] * (lines - len(names)), fontsize=6)
        axes.set_ylim(lines - 0.3, -0.7)
        axes.set_xlim(evaluation.tables.start, evaluation.tables.stop)
        axes.set_xlabel("time, s")
        axes.tick_params(axis="x", labelsize=8)
        axes.grid(visible=False, axis="y")
    return figure


def _last_shown(evaluation: Evaluation) -> np.ndarray:
    # A coasting track is alive, but no plot says so: the bar ends with the last plot.
    tracks, history = evaluation.tables.tracks, evaluation.history
    updated = tracks.rows["status"] == TrackStatus.CONFIRMED
    until = history.confirmed_at.copy()
    np.maximum.at(until, history.track_of_row[updated], tracks.time[updated])
    return until


def _number_within_target(label: np.ndarray) -> np.ndarray:
    order = np.argsort(label, kind="stable")
    starts = np.flatnonzero(np.diff(label[order], prepend=-2))
    number = np.empty(len(label), np.int64)
    counts = np.diff(np.append(starts, len(label)))
    number[order] = np.arange(len(label)) - np.repeat(starts, counts)
    return number


def _target_name(number: int) -> str:
    # A 24-bit address is known to people in hexadecimal digits, a simulator's running number is not.
    return f"{number:06X}" if number > 0xFFFF else str(number)
