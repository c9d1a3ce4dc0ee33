# SPDX-License-Identifier: Apache-2.0
"""False tracks an hour against delay of confirmation, a panel for each density of false plots."""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from radar_common.figure_style import LINES
from radar_eval.figures import style
from radar_eval.studies.initiation_trials import Outcome

_NONE = 0.5
"""Where on the logarithmic axis no false track at all is drawn, in tracks of the trial."""


def draw_initiation(outcomes: Sequence[Outcome]) -> Figure:
    """Draw the outcomes of the study.

    Args:
        outcomes: of rules and densities.

    Returns:
        The figure.
    """
    densities = sorted({outcome.false_plots for outcome in outcomes})
    families = list(dict.fromkeys(outcome.family for outcome in outcomes))
    with style.style():
        figure = Figure(figsize=(10.5, 5.0), layout="constrained")
        panels = figure.subplots(1, len(densities), sharex=True, sharey=True, squeeze=False)[0]
        for axes, density in zip(panels, densities, strict=True):
            for number, family in enumerate(families):
                line = [o for o in outcomes if (o.false_plots, o.family) == (density, family)]
                _draw(axes, line, LINES[number])
            axes.set_yscale("log")
            axes.set_title(f"{density:g} false plots a turn")
            axes.set_xlabel("first plot to confirmation, turns")
        panels[0].set_ylabel("confirmed false tracks an hour")
        figure.legend(
            *panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=len(families)
        )
    return figure


def _draw(axes: Axes, line: Sequence[Outcome], colour: str) -> None:
    scale = max(
        (o.false_tracks_per_hour / o.false_tracks for o in line if o.false_tracks), default=1.0
    )
    height = [o.false_tracks_per_hour or _NONE * scale for o in line]
    delay = [o.delay for o in line]
    axes.plot(delay, height, "-", color=colour, linewidth=1.2, label=line[0].family)
    for x, y, outcome in zip(delay, height, line, strict=True):
        face = colour if outcome.false_tracks else "white"
        axes.plot(x, y, "o", markersize=5.5, color=colour, markerfacecolor=face)
        axes.annotate(
            outcome.label, (x, y), (5, 4), textcoords="offset points", fontsize=8, color=colour
        )
