# SPDX-License-Identifier: Apache-2.0
"""Where emitters of a bag were located, and how far from their true places, beside the bound."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Ellipse
from matplotlib.ticker import LogLocator, NullLocator

from radar_common.figure_style import FAINT, INK, LINES, MUTED, style
from radar_eval.emitter_evaluation import EmitterEvaluation
from radar_eval.metrics.emitters import last_rows

FloatArray = npt.NDArray[np.float64]
IndexArray = npt.NDArray[np.int64]

_MOST_SHOWN = 8
_SIGMAS = 2.0


def draw_located_emitters(evaluation: EmitterEvaluation) -> Figure:
    """Draw a map of the emitters with known range and their errors against time.

    Args:
        evaluation: of a bag.

    Returns:
        The figure with two panels.
    """
    last = last_rows(evaluation)
    ids = evaluation.rows.rows["id"]
    with style():
        figure = Figure(figsize=(9.0, 4.6), layout="constrained")
        site, errors = figure.subplots(1, 2, width_ratios=(1.0, 1.25))
        for number, row in enumerate(last[:_MOST_SHOWN]):
            colour = LINES[number % len(LINES)]
            mine = np.flatnonzero(evaluation.counts & (ids == ids[row]))
            _draw_place(site, evaluation, mine, colour)
            _draw_error(errors, evaluation, np.flatnonzero(ids == ids[row]), colour)
        left = len(last) - _MOST_SHOWN
        more = f"; {left} more are left out" if left > 0 else ""
        site.set_title(f"Places, ellipses of two deviations, truth crossed{more}")
        site.set(xlabel="east, km", ylabel="north, km", aspect="equal", adjustable="datalim")
        errors.plot([], [], color=INK, label="error")
        errors.plot([], [], color=MUTED, ls=(0, (4, 2)), label="Cramer-Rao bound")
        errors.set(title="Error of the place, m", xlabel="time, s")
        if len(last):
            errors.set_yscale("log")
            errors.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
            errors.yaxis.set_major_formatter("{x:g}")
            errors.yaxis.set_minor_locator(NullLocator())
        else:
            errors.text(0.5, 0.5, "no range was known", transform=errors.transAxes, ha="center")
        errors.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=2, borderpad=0.0)
    return figure


def _draw_place(axes: Axes, evaluation: EmitterEvaluation, mine: IndexArray, colour: str) -> None:
    rows = evaluation.rows.rows[mine]
    last = rows[-1]
    covariance = last["covariance"].reshape(4, 4)[:2, :2].astype(float) / 1e6
    variances, axes_of = np.linalg.eigh(covariance)
    length = 2.0 * _SIGMAS * np.sqrt(np.maximum(variances, 0.0))
    angle = float(np.degrees(np.arctan2(axes_of[1, 1], axes_of[0, 1])))
    place = (float(last["x"]) / 1e3, float(last["y"]) / 1e3)
    axes.add_patch(
        Ellipse(
            place, float(length[1]), float(length[0]), angle=angle, color=colour, alpha=0.3, lw=0
        )
    )
    axes.plot(rows["x"] / 1e3, rows["y"] / 1e3, color=colour, lw=0.8, alpha=0.6)
    axes.plot(*place, "o", color=colour, ms=4.0)
    axes.plot(evaluation.x[mine] / 1e3, evaluation.y[mine] / 1e3, color=FAINT, lw=1.2)
    axes.plot(evaluation.x[mine[-1]] / 1e3, evaluation.y[mine[-1]] / 1e3, "x", color=INK, ms=5.0)


def _draw_error(axes: Axes, evaluation: EmitterEvaluation, mine: IndexArray, colour: str) -> None:
    # While the range is not known again the curves pause.
    known, time = evaluation.counts[mine], evaluation.rows.time[mine]
    bound = evaluation.rows.rows["bound_std"][mine]
    axes.plot(time, np.where(known, evaluation.error[mine], np.nan), color=colour, lw=1.1)
    axes.plot(time, np.where(known, bound, np.nan), color=colour, lw=1.0, ls=(0, (4, 2)))
