# SPDX-License-Identifier: Apache-2.0
"""Trackers beside each other on the same plots, one row a scene."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import FuncFormatter

from radar_common.figure_style import LINES
from radar_eval.figures import style

_PARTS = {
    "localisation": style.TRACK_COLOUR,
    "missed targets": style.FAINT,
    "false tracks": style.BAD_COLOUR,
}
_PANELS = {
    "position_rms_m": "Position error, m RMS",
    "tracks_per_target": "Tracks a target",
    "switches": "Changes of identity",
    "seconds": "Run time, s",
}
_MOST_MARKED = 8


def draw_tracking(rows: Sequence[Mapping[str, Any]], cutoff: float) -> Figure:
    """Draw the comparison.

    Args:
        rows: scores with `scene` and `tracker`, every tracker on every scene.
        cutoff: of GOSPA, m.

    Returns:
        The figure: GOSPA's parts as bars, the rest as dots.
    """
    scenes = list(dict.fromkeys(row["scene"] for row in rows))
    trackers = list(dict.fromkeys(row["tracker"] for row in rows))
    with style.style():
        figure = Figure(figsize=(13.0, 1.6 + 1.05 * len(scenes)), layout="constrained")
        panels = figure.subplots(
            1, 1 + len(_PANELS), sharey=True, gridspec_kw={"width_ratios": [2.0] + [1.0] * 4}
        )
        _draw_gospa(panels[0], rows, scenes, trackers, cutoff)
        for axes, (name, title) in zip(panels[1:], _PANELS.items(), strict=True):
            _draw_dots(axes, rows, scenes, trackers, name)
            axes.set_title(title)
        panels[0].set_yticks(range(len(scenes)), scenes, fontsize=10, color=style.INK)
        panels[0].set_ylim(len(scenes) - 0.5, -0.5)
        for axes in panels:
            axes.grid(visible=False, axis="y")
            for edge in range(1, len(scenes)):
                axes.axhline(edge - 0.5, color=style.GRID, linewidth=0.8)
        figure.legend(handles=_legend(trackers), loc="outside lower center", ncols=5)
    return figure


def _place(trackers: list[str], number: int) -> float:
    return 0.86 * ((number + 0.5) / len(trackers) - 0.5)


def _draw_gospa(
    axes: Axes,
    rows: Sequence[Mapping[str, Any]],
    scenes: list[str],
    trackers: list[str],
    cutoff: float,
) -> None:
    # The squares add up, so a bar is the mean square, and its axis is marked with the roots.
    height = 0.74 / len(trackers)
    for row in rows:
        number = trackers.index(row["tracker"])
        at = scenes.index(row["scene"]) + _place(trackers, number)
        parts = (
            row["gospa_localisation_m"] ** 2,
            row["gospa_missed"] * cutoff**2 / 2.0,
            row["gospa_false"] * cutoff**2 / 2.0,
        )
        left = 0.0
        for part, colour in zip(parts, _PARTS.values(), strict=True):
            axes.barh(at, part / 1e6, left=left, height=height, color=colour)
            left += part / 1e6
        axes.plot(left, at, _marker(number), color=_colour(number), markersize=4.0, clip_on=False)
    axes.set_xscale("symlog", linthresh=0.5, linscale=1.5)
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{1e3 * np.sqrt(value):.0f}"))
    axes.set_xticks([0.0, 0.0625, 0.25, 0.5, 1.0, 2.0, 4.0])
    axes.set_xlim(left=0.0)
    axes.set_title("GOSPA and its parts, m, by their squares")


def _draw_dots(
    axes: Axes,
    rows: Sequence[Mapping[str, Any]],
    scenes: list[str],
    trackers: list[str],
    name: str,
) -> None:
    for row in rows:
        number = trackers.index(row["tracker"])
        at = scenes.index(row["scene"]) + _place(trackers, number)
        axes.plot(row[name], at, _marker(number), color=_colour(number), markersize=5.0)
    if name in ("position_rms_m", "seconds"):
        axes.set_xscale("log")
    elif name == "switches":
        axes.set_xlim(left=-0.5)
    else:
        axes.set_xlim(left=0.95)


def _colour(number: int) -> str:
    return LINES[number % len(LINES)]


def _marker(number: int) -> str:
    return "o" if number < _MOST_MARKED else "D"


def _legend(trackers: list[str]) -> list[Line2D | Patch]:
    entries: list[Line2D | Patch] = [
        Line2D([], [], linestyle="", marker=_marker(n), color=_colour(n), label=name)
        for n, name in enumerate(trackers)
    ]
    return entries + [Patch(color=colour, label=part) for part, colour in _PARTS.items()]
