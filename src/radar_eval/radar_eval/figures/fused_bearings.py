# SPDX-License-Identifier: Apache-2.0
"""A bag's fused bearings beside what radar and direction finder told, against time."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from matplotlib.figure import Figure

from radar_eval.bearing_evaluation import AngleErrors, BearingEvaluation
from radar_eval.figures.channels_over_time import Moments, draw_channels_over_time

FloatArray = npt.NDArray[np.float64]

_MOST_BINS = 120
_ROWS_A_BIN = 8


def draw_fused_bearings(evaluation: BearingEvaluation) -> Figure:
    """Draw errors of bearings and states of channels against time.

    Args:
        evaluation: of a bag.

    Returns:
        The figure with two panels.
    """
    fused, rows = evaluation.fused, evaluation.tables.fused.rows
    number = int(np.clip(len(rows) // _ROWS_A_BIN, 2, _MOST_BINS))
    edges = np.linspace(fused.time[0], fused.time[-1] + 1e-6, number + 1)
    told = len(evaluation.jammed) == len(rows)
    jammed, silent = (
        _mean(fused.time, truly.astype(float), edges) > 0.5 if told else np.zeros(number, bool)
        for truly in (evaluation.jammed, evaluation.silent)
    )
    moments = Moments(
        0.5 * (edges[1:] + edges[:-1]),
        _rms(fused, edges),
        _rms(evaluation.active, edges),
        _rms(evaluation.passive, edges),
        1.0 - _mean(fused.time, rows["active_health"][:, 0], edges),
        1.0 - _mean(fused.time, rows["passive_health"][:, 0], edges),
        jammed,
        silent,
    )
    return draw_channels_over_time(
        moments,
        "Error of the azimuth, root mean square, mrad",
        ("plots", "passive bearings"),
        better=False,
    )


def _rms(errors: AngleErrors, edges: FloatArray) -> FloatArray:
    return 1e3 * np.sqrt(_mean(errors.time, errors.error**2, edges))


def _mean(time: FloatArray, values: npt.NDArray[np.floating], edges: FloatArray) -> FloatArray:
    """Mean of what is known in each bin, NaN where nothing is."""
    known = np.isfinite(values)
    number, _ = np.histogram(time[known], edges)
    total, _ = np.histogram(time[known], edges, weights=values[known].astype(float))
    return np.where(number > 0, total / np.maximum(number, 1), np.nan)
