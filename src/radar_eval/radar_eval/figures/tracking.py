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
from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator

from radar_common.figure_style import LINES
from radar_eval.figures import style
from radar_eval.studies.tracking_peers import PEERS

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
_PEER_COLOURS = (LINES[1], LINES[4])
_OTHERS = (LINES[2], LINES[3], LINES[5], LINES[6], LINES[7], "#94a3b8", "#5eead4")


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
        axes.plot(
            left, at, color=_colour(trackers, number), clip_on=False, **_mark(trackers, number)
        )
    axes.set_xlim(left=0.0)
    roots = np.arange(0.0, 1e3 * np.sqrt(axes.get_xlim()[1]), 500.0)
    axes.set_xticks((roots / 1e3) ** 2, [f"{root:.0f}" for root in roots])
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
        axes.plot(row[name], at, color=_colour(trackers, number), **_mark(trackers, number))
    if name in ("position_rms_m", "seconds"):
        axes.set_xscale("log")
        axes.xaxis.set_major_locator(LogLocator(subs=(1.0, 3.0)))
        axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        axes.xaxis.set_minor_locator(NullLocator())
    elif name == "switches":
        axes.set_xlim(left=-0.5)
    else:
        axes.set_xlim(left=0.95)


def _is_peer(trackers: list[str], number: int) -> bool:
    return trackers[number] in PEERS


def _colour(trackers: list[str], number: int) -> str:
    if _is_peer(trackers, number):
        return _PEER_COLOURS[PEERS.index(trackers[number])]
    return LINES[0] if number == 0 else _OTHERS[(number - 1) % len(_OTHERS)]


def _mark(trackers: list[str], number: int) -> dict[str, Any]:
    if _is_peer(trackers, number):
        return {"marker": "D", "markersize": 5.0, "linestyle": ""}
    return {"marker": "o", "markersize": 6.5 if number == 0 else 3.8, "linestyle": ""}


def _legend(trackers: list[str]) -> list[Line2D | Patch]:
    entries: list[Line2D | Patch] = [
        Line2D([], [], color=_colour(trackers, n), label=name, **_mark(trackers, n))
        for n, name in enumerate(trackers)
    ]
    return entries + [Patch(color=colour, label=part) for part, colour in _PARTS.items()]
