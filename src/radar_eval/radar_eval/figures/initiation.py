# SPDX-License-Identifier: Apache-2.0
"""False tracks an hour against delay of confirmation, a panel for each density of false plots."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from radar_common.figure_style import LINES
from radar_eval.figures import style
from radar_eval.studies.initiation_trials import Outcome

_NONE = 0.5
"""Where on the logarithmic axis no false track at all is drawn, in tracks of the trial."""
_LABELS = ((6, 4), (6, 3), (6, -11), (-6, -11))
"""Where a label stands beside its point, by family, so that neighbours do not cover each other."""


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
                _draw(axes, line, number)
            axes.set_yscale("log")
            axes.margins(0.12, 0.08)
            axes.set_title(f"{density:g} false plots a turn")
            axes.set_xlabel("first plot to confirmation, turns")
        panels[0].set_ylabel("confirmed false tracks an hour")
        handles = [
            Line2D([], [], marker="o", markersize=5.5, color=LINES[number], label=family)
            for number, family in enumerate(families)
        ]
        handles.append(
            Line2D(
                [],
                [],
                linestyle="",
                marker="o",
                markersize=5.5,
                color=style.MUTED,
                markerfacecolor="white",
                label="no false track in the trial",
            )
        )
        figure.legend(
            handles=handles,
            loc="outside lower center",
            ncols=len(handles),
            title="numbers at the tests: false tracks an hour that were asked for",
        )
    return figure


def _draw(axes: Axes, line: Sequence[Outcome], number: int) -> None:
    colour = LINES[number]
    scale = max(
        (o.false_tracks_per_hour / o.false_tracks for o in line if o.false_tracks), default=1.0
    )
    height = [o.false_tracks_per_hour or _NONE * scale for o in line]
    delay = [o.delay for o in line]
    # Rules l of m are no sequence, as each trades l against m in its own way.
    kind = "-" if np.isfinite(line[0].wanted) else "None"
    axes.plot(delay, height, linestyle=kind, color=colour, linewidth=1.2)
    for x, y, outcome in zip(delay, height, line, strict=True):
        face = colour if outcome.false_tracks else "white"
        axes.plot(x, y, "o", markersize=5.5, color=colour, markerfacecolor=face)
        axes.annotate(
            outcome.label,
            (x, y),
            _LABELS[number],
            textcoords="offset points",
            fontsize=8,
            color=colour,
            horizontalalignment="left" if _LABELS[number][0] > 0 else "right",
        )
