# SPDX-License-Identifier: Apache-2.0
"""Position error and the distance between the pictures of tracks and truth, against time."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from radar_eval.evaluation import Evaluation
from radar_eval.figures import style
from radar_eval.metrics.accuracy import Errors, plot_errors, track_errors
from radar_eval.metrics.set_distance import gospa_over_time

FloatArray = npt.NDArray[np.float64]

_MOST_BINS = 60


def draw_over_time(evaluation: Evaluation) -> Figure:
    """Draw both against time.

    Args:
        evaluation: of a bag.

    Returns:
        The figure with two panels.
    """
    with style.style():
        figure = Figure(figsize=(9.0, 4.6), layout="constrained")
        above, below = figure.subplots(2, 1, sharex=True)
        edges = _bins(evaluation)
        for errors, colour, name in (
            (plot_errors(evaluation), style.PLOT_COLOUR, "plots"),
            (track_errors(evaluation), style.TRACK_COLOUR, "confirmed tracks past ten plots"),
        ):
            _draw_errors(above, errors, edges, colour, name)
        above.set_title("Position error, root mean square, m")
        above.set_ylim(bottom=0.0)
        _legend(above)
        over_time = gospa_over_time(evaluation)
        below.plot(
            over_time.time, over_time.missed, color=style.PLOT_COLOUR, label="targets missed"
        )
        below.plot(over_time.time, over_time.false, color=style.BAD_COLOUR, label="tracks false")
        below.set_title(
            f"Targets and tracks left without a partner within {evaluation.options.gospa_cutoff:.0f} m"
        )
        below.set_ylim(bottom=0.0)
        below.set_xlabel("time, s")
        _legend(below)
    return figure


def _bins(evaluation: Evaluation) -> FloatArray:
    number = int(np.clip(evaluation.scans // 2, 1, _MOST_BINS))
    return np.linspace(evaluation.tables.start, evaluation.tables.stop, number + 1)


def _draw_errors(axes: Axes, errors: Errors, edges: FloatArray, colour: str, name: str) -> None:
    number, _ = np.histogram(errors.time, edges)
    squares, _ = np.histogram(errors.time, edges, weights=np.square(errors.position))
    filled = number > 0
    centres = 0.5 * (edges[1:] + edges[:-1])
    axes.plot(centres[filled], np.sqrt(squares[filled] / number[filled]), color=colour, label=name)


def _legend(axes: Axes) -> None:
    axes.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=2, borderpad=0.0)
