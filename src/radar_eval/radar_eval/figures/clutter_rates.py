# SPDX-License-Identifier: Apache-2.0
"""False plots a turn and targets found, by scenario, normaliser and criterion control."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import ScalarFormatter

from radar_common.figure_style import LINES
from radar_eval.figures import style
from radar_eval.studies.clutter_rates import WANTED, Outcome
from radar_eval.studies.clutter_scene import STRONG_DB, WEAK_DB

_WIDTH = 0.72
_LEAST = 1.0


def draw_clutter_rates(outcomes: Sequence[Outcome]) -> Figure:
    """Draw the outcomes of the study.

    Args:
        outcomes: of scenarios and normalisers, without and with control.

    Returns:
        The figure with three panels.
    """
    scenarios = list(dict.fromkeys(outcome.scenario for outcome in outcomes))
    kinds = list(dict.fromkeys(outcome.normaliser for outcome in outcomes))
    with style.style():
        figure = Figure(figsize=(9.6, 7.4), layout="constrained")
        rates, clear, clutter = figure.subplots(
            3, 1, sharex=True, gridspec_kw={"height_ratios": [2.2, 1.0, 1.0]}
        )
        rates.axhspan(WANTED / 2, 2 * WANTED, color=style.GRID, zorder=0)
        rates.axhline(WANTED, color=style.MUTED, linewidth=0.8, zorder=1)
        rates.set_yscale("log")
        rates.yaxis.set_major_formatter(ScalarFormatter())
        _draw(rates, outcomes, scenarios, kinds, "settled")
        rates.set_ylim(bottom=_LEAST)
        _draw(clear, outcomes, scenarios, kinds, "clear_found")
        _draw(clutter, outcomes, scenarios, kinds, "clutter_found")
        rates.set_title(
            f"False plots a turn; the band is a factor of two around the {WANTED:g} wanted"
        )
        clear.set_title(f"Targets of {WEAK_DB:g} dB found outside clutter")
        clutter.set_title(f"Targets of {STRONG_DB:g} dB found in clutter or jamming")
        for axes in (clear, clutter):
            axes.set_ylim(-0.04, 1.04)
        clutter.set_xticks(range(len(scenarios)), [name.replace("_", " ") for name in scenarios])
        clutter.tick_params(axis="x", labelsize=9.5, labelcolor=style.INK)
        for axes in (rates, clear, clutter):
            axes.grid(visible=False, axis="x")
            axes.set_xlim(-0.5, len(scenarios) - 0.5)
            for edge in range(1, len(scenarios)):
                axes.axvline(edge - 0.5, color=style.GRID, linewidth=0.8)
        figure.legend(handles=_legend(kinds), loc="outside lower center", ncols=4)
    return figure


def _draw(
    axes: Axes, outcomes: Sequence[Outcome], scenarios: list[str], kinds: list[str], name: str
) -> None:
    for number, kind in enumerate(kinds):
        colour = LINES[number]
        place = (number - (len(kinds) - 1) / 2) * _WIDTH / len(kinds)
        for scenario in scenarios:
            at = scenarios.index(scenario) + place
            free, held = (
                max(getattr(outcome, name), _LEAST if name == "settled" else 0.0)
                for controlled in (False, True)
                for outcome in outcomes
                if (outcome.scenario, outcome.normaliser, outcome.controlled)
                == (scenario, kind, controlled)
            )
            if np.isnan(free):
                continue
            axes.plot([at, at], [free, held], color=colour, linewidth=1.0, alpha=0.6)
            axes.plot(at, free, "o", markersize=5.5, color=colour, markerfacecolor="white")
            axes.plot(at, held, "o", markersize=5.5, color=colour)


def _legend(kinds: list[str]) -> list[Line2D]:
    entries = [
        Line2D([], [], linestyle="", marker="o", color=LINES[number], label=kind)
        for number, kind in enumerate(kinds)
    ]
    for label, face in (("criterion as designed", "white"), ("criterion controlled", style.MUTED)):
        entries.append(
            Line2D(
                [],
                [],
                linestyle="",
                marker="o",
                color=style.MUTED,
                markerfacecolor=face,
                label=label,
            )
        )
    return entries
