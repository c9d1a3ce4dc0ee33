# SPDX-License-Identifier: Apache-2.0
"""Probability of detection and false plots, against range."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from matplotlib.figure import Figure

from radar_eval.asterix_records import NAUTICAL_MILE
from radar_eval.evaluation import Evaluation
from radar_eval.figures import style
from radar_eval.metrics.detection import detection_over_range

FloatArray = npt.NDArray[np.float64]

_CONFIDENCE = 1.96


def draw_over_range(evaluation: Evaluation) -> Figure:
    """Draw both against range.

    Args:
        evaluation: of a bag.

    Returns:
        The figure with two panels.
    """
    counts = detection_over_range(evaluation)
    miles = counts.edges / NAUTICAL_MILE
    centres, width = 0.5 * (miles[1:] + miles[:-1]), float(miles[1] - miles[0])
    looked = counts.looks > 0
    with style.style():
        figure = Figure(figsize=(9.0, 4.6), layout="constrained")
        above, below = figure.subplots(2, 1, sharex=True)
        share = counts.detected[looked] / counts.looks[looked]
        low, high = wilson_interval(share, counts.looks[looked])
        above.vlines(centres[looked], low, high, color=style.FAINT, linewidth=2.4)
        above.plot(centres[looked], share, "o", color=style.TRACK_COLOUR, markersize=3.6)
        above.set_ylim(0.0, 1.03)
        above.set_title("Probability of detection a pass of the antenna, with its 95 % interval")
        below.bar(centres, counts.false_plots, width=0.86 * width, color=style.PLOT_COLOUR)
        below.set_title(f"False plots a scan, in rings of {width:.2g} NM")
        below.set_xlabel("range, NM")
        below.set_xlim(0.0, float(miles[-1]))
        below.grid(visible=False, axis="x")
    return figure


def wilson_interval(
    share: FloatArray, number: npt.NDArray[np.int64]
) -> tuple[FloatArray, FloatArray]:
    """95 % confidence interval of a probability (Wilson 1927).

    Args:
        share: observed, shape (n,).
        number: of trials, at least one, shape (n,).

    Returns:
        (low, high), each shape (n,).
    """
    z = _CONFIDENCE
    scale = 1.0 + z**2 / number
    centre = (share + z**2 / (2.0 * number)) / scale
    half = z / scale * np.sqrt(share * (1.0 - share) / number + z**2 / (4.0 * number**2))
    return centre - half, centre + half
