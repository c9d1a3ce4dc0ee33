# SPDX-License-Identifier: Apache-2.0
"""Emitters and where a moving observer put them; the error of every filter over time beside the bound."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Ellipse
from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullFormatter

from bearing_tracker.emitters import DEFAULT_FILTER
from radar_common.figure_style import FAINT, INK, LINES, MUTED
from radar_eval.figures.style import style
from radar_eval.studies.emitter_location_scenes import LocationScene
from radar_eval.studies.emitter_location_trials import LocationOutcome

_SIGMAS = 2.0
_BEARINGS_SHOWN = 8


def draw_emitter_location(
    scenes: Sequence[LocationScene], outcomes: Sequence[LocationOutcome]
) -> Figure:
    """Draw a row of three panels for each scene: its geometry, the estimates at the end, and errors over time.

    Args:
        scenes: compared on.
        outcomes: of the filters, the default one among them.

    Returns:
        The figure.
    """
    with style():
        figure = Figure(figsize=(11.6, 3.7 * len(scenes)), layout="constrained")
        panels = figure.subplots(
            len(scenes), 3, squeeze=False, gridspec_kw={"width_ratios": [1.0, 1.0, 1.7]}
        )
        for (geometry, end, errors), scene in zip(panels, scenes, strict=True):
            shown = [outcome for outcome in outcomes if outcome.scene == scene.name]
            default = next(outcome for outcome in shown if outcome.filter == DEFAULT_FILTER)
            _draw_geometry(geometry, scene)
            _draw_end(end, scene, default)
            _draw_errors(errors, scene, shown, default)
    return figure


def _draw_geometry(axes: Axes, scene: LocationScene) -> None:
    observer, path = scene.observer / 1e3, scene.path[:, :2] / 1e3
    for look in np.linspace(0, len(path) - 1, _BEARINGS_SHOWN).astype(int):
        axes.plot(*np.stack([observer[look], path[look]]).T, color=FAINT, linewidth=0.5)
    axes.plot(*observer.T, color=INK)
    axes.plot(*observer[0], "o", color=INK, markersize=4)
    axes.plot(*path.T, color=LINES[1])
    axes.plot(*path[0], "o", color=LINES[1], markersize=4)
    axes.plot(*path[-1], "s", color=LINES[1], markersize=4)
    axes.annotate("observer", observer[0], (6, -10), textcoords="offset points", color=INK)
    axes.annotate("emitter", path[0], (6, 4), textcoords="offset points", color=LINES[1])
    axes.set_aspect("equal", adjustable="datalim")
    axes.set(
        title=f"{scene.name}: {scene.title}",
        xlabel="east, km",
        ylabel="north, km",
    )


def _draw_end(axes: Axes, scene: LocationScene, default: LocationOutcome) -> None:
    """Where the runs put the emitter at the end, against two deviations of the bound."""
    off = (default.places - scene.path[-1, :2]) / 1e3
    lengths, directions = np.linalg.eigh(scene.bound()[-1, :2, :2])
    axes.plot(*off.T, ".", color=LINES[0], markersize=2.0, alpha=0.5)
    axes.plot(0.0, 0.0, "s", color=LINES[1], markersize=4)
    axes.add_patch(
        Ellipse(
            (0.0, 0.0),
            *(2.0 * _SIGMAS * np.sqrt(lengths) / 1e3),
            angle=float(np.degrees(np.arctan2(directions[1, 0], directions[0, 0]))),
            facecolor="none",
            edgecolor=INK,
            linewidth=1.2,
            zorder=5,
        )
    )
    axes.set_aspect("equal", adjustable="datalim")
    axes.xaxis.set_major_locator(MaxNLocator(4))
    axes.yaxis.set_major_locator(MaxNLocator(4))
    axes.set(
        title=f"Estimates at the end; {_SIGMAS:g} σ of the bound",
        xlabel="off to the east, km",
        ylabel="to the north, km",
    )


def _draw_errors(
    axes: Axes, scene: LocationScene, outcomes: Sequence[LocationOutcome], default: LocationOutcome
) -> None:
    minutes = default.seconds / 60.0
    known = minutes[int(np.argmax(default.known > 0.5))]
    axes.axvspan(0.0, known, color=FAINT, alpha=0.25, linewidth=0.0)
    for number, outcome in enumerate(outcomes):
        mine = outcome is default
        axes.plot(
            minutes,
            outcome.error,
            color=LINES[number],
            linewidth=2.2 if mine else 1.1,
            zorder=4 if mine else 3,
            label=f"{outcome.filter}  {outcome.rms / outcome.bound:.2f}",
        )
    axes.plot(minutes, default.bounds, color=INK, linestyle=(0, (4, 2)), zorder=5, label="bound")
    axes.set_yscale("log")
    axes.set_xlim(0.0, minutes[-1])
    axes.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axes.yaxis.set_major_formatter(FuncFormatter(lambda metres, _: f"{metres:,.0f}"))
    axes.yaxis.set_minor_formatter(NullFormatter())
    axes.set(title=f"RMS position error of {default.runs} runs, m", xlabel="minutes")
    axes.text(0.012, 0.02, "range unknown", transform=axes.transAxes, color=MUTED, fontsize=8.0)
    axes.legend(
        title="at the end over the bound",
        loc="best",
        alignment="left",
        labelspacing=0.2,
        fontsize=8.0,
    )
