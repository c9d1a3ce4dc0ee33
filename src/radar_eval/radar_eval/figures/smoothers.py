# SPDX-License-Identifier: Apache-2.0
"""What the smoothers make of straight and manoeuvring flights, side by side."""

from __future__ import annotations

from collections.abc import Callable

import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import PercentFormatter, ScalarFormatter

from radar_common.figure_style import LINES, MUTED, style
from radar_eval.studies.smoother_outcome import Outcome

_PANELS: tuple[tuple[str, Callable[[Outcome], float]], ...] = (
    ("position error over the plots'", lambda outcome: outcome.position_rms / outcome.plot_rms),
    ("velocity error, m/s", lambda outcome: outcome.velocity_rms),
    ("plots beside the gate", lambda outcome: outcome.lost),
)
_MARKERS = "oDsv^P"


def draw_smoothers(outcomes: list[Outcome]) -> Figure:
    """Draw errors and losses, a row of panels for each period of the antenna.

    Args:
        outcomes: of any smoothers and flights.

    Returns:
        The figure.
    """
    periods = list(dict.fromkeys(outcome.period for outcome in outcomes))
    flights = list(dict.fromkeys(outcome.flight for outcome in outcomes))
    smoothers = list(dict.fromkeys(outcome.smoother for outcome in outcomes))
    with style():
        figure, panels = plt.subplots(
            len(periods),
            len(_PANELS),
            figsize=(10.0, 1.2 + 0.52 * len(flights) * len(periods)),
            layout="constrained",
            sharex="col",
            sharey=True,
            squeeze=False,
        )
        for row, period in zip(panels, periods, strict=True):
            row[0].set_ylabel(f"a turn in {period:g} s", color=MUTED)
            row[0].axvline(1.0, color=MUTED, lw=0.8)
            for axes, (title, value) in zip(row, _PANELS, strict=True):
                for place, smoother in enumerate(smoothers):
                    shown = [o for o in outcomes if (o.period, o.smoother) == (period, smoother)]
                    # Side by side within a flight's band, or those that do equally well would hide each other.
                    aside = 0.11 * (place - (len(smoothers) - 1) / 2)
                    axes.plot(
                        [value(outcome) for outcome in shown],
                        [flights.index(outcome.flight) + aside for outcome in shown],
                        _MARKERS[place % len(_MARKERS)],
                        color=LINES[place % len(LINES)],
                        ms=5,
                        label=smoother,
                    )
                if axes in panels[-1]:
                    axes.set_xlabel(title)
                axes.grid(visible=False, axis="y")
                for border in range(len(flights) - 1):
                    axes.axhline(border + 0.5, color=MUTED, lw=0.4, alpha=0.5)
        panels[0, 0].set_yticks(range(len(flights)), flights)
        panels[0, 0].set_ylim(len(flights) - 0.45, -0.55)
        _scale(panels[0, 0], panels[0, 1], panels[0, 2])
        handles, labels = panels[0, 0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside upper center", ncols=len(smoothers))
        plt.close(figure)
    return figure


def _scale(position: Axes, velocity: Axes, lost: Axes) -> None:
    for axes in (position, velocity):
        axes.set_xscale("log")
        axes.xaxis.set_major_formatter(ScalarFormatter())
        axes.xaxis.set_minor_formatter("")
    position.set_xticks([0.5, 1.0, 2.0, 4.0])
    velocity.set_xticks([3, 10, 30, 100])
    lost.set_xlim(-0.03, None)
    lost.xaxis.set_major_formatter(PercentFormatter(1.0, decimals=0))
