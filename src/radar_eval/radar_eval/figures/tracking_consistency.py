# SPDX-License-Identifier: Apache-2.0
"""NEES and NIS of tracks against their chi-square bounds."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from scipy import stats

from radar_common.figure_style import LINES
from radar_eval.figures import style
from radar_eval.metrics.consistency import PLOT_DEGREES, STATE_DEGREES, bounds_of_mean
from radar_eval.studies.tracking_consistency import ConsistencyRun, mean_over_scans

FloatArray = npt.NDArray[np.float64]


def draw_consistency(runs: Sequence[ConsistencyRun], scans: int) -> Figure:
    """Draw the normalised squares.

    Args:
        runs: of the smoothers, the default one first.
        scans: of each run.

    Returns:
        The figure: their means over the flights against time, and their distribution over all.
    """
    with style.style():
        figure = Figure(figsize=(10.5, 5.6), layout="constrained")
        panels = figure.subplots(2, 2, gridspec_kw={"width_ratios": [1.7, 1.0]})
        flights = runs[0].flights
        for row, degrees, name in ((0, STATE_DEGREES, "NEES"), (1, PLOT_DEGREES, "NIS")):
            over_time, distribution = panels[row]
            low, high = bounds_of_mean(degrees, flights)
            over_time.axhspan(low, high, color=style.GRID, zorder=0)
            over_time.axhline(degrees, color=style.MUTED, linewidth=0.8, zorder=1)
            for number, run in reversed(list(enumerate(runs))):
                scan, value = (run.scan, run.nees) if row == 0 else (run.nis_scan, run.nis)
                mean, _ = mean_over_scans(scan, value, scans)
                width = 1.8 if number == 0 else 0.9
                colour = LINES[number % len(LINES)]
                over_time.plot(mean, color=colour, linewidth=width, label=run.smoother)
                _draw_distribution(distribution, value, degrees, colour, width)
            _draw_expected(distribution, degrees)
            over_time.set_title(
                f"{name}, mean over {flights} flights; the band holds 95 % where all is right"
            )
            over_time.set_ylim(0.5 * degrees, 1.5 * degrees)
            distribution.set_title(f"Share of {name} above a value")
        panels[1, 0].set_xlabel("scan")
        panels[1, 1].set_xlabel("value; dashed: chi-square law")
        handles, labels = panels[0, 0].get_legend_handles_labels()
        figure.legend(handles[::-1], labels[::-1], loc="outside lower center", ncols=6)
    return figure


def _draw_distribution(
    axes: Axes, value: FloatArray, degrees: int, colour: str, width: float
) -> None:
    ordered = np.sort(value)
    above = 1.0 - np.arange(len(ordered)) / max(len(ordered), 1)
    axes.plot(ordered, above, color=colour, linewidth=width)
    axes.set_yscale("log")
    axes.set_xlim(0.0, 5.0 * degrees)
    axes.set_ylim(1e-3, 1.0)


def _draw_expected(axes: Axes, degrees: int) -> None:
    values = np.linspace(0.0, 5.0 * degrees, 200)
    axes.plot(
        values, stats.chi2.sf(values, degrees), color=style.INK, linestyle="--", linewidth=1.0
    )
