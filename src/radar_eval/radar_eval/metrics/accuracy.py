# SPDX-License-Identifier: Apache-2.0
"""How far plots and tracks lie from the truth."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from radar_common.frames import enu_from_polar
from radar_common.tables import TrackStatus
from radar_eval.evaluation import Evaluation
from radar_eval.labelling import FALSE

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class Errors:
    """Position errors, one entry an observation.

    Attributes:
        index: of the plot or of the track's row, shape (n,).
        time: seconds after the bag's origin, shape (n,).
        position: m, shape (n,).
    """

    index: IntArray
    time: FloatArray
    position: FloatArray

    def __getitem__(self, chosen: npt.NDArray[np.bool_]) -> Errors:
        """Select observations."""
        return Errors(self.index[chosen], self.time[chosen], self.position[chosen])


def accuracy_scores(evaluation: Evaluation) -> dict[str, float]:
    """Score the position errors, as root mean squares.

    Args:
        evaluation: of a bag.

    Returns:
        Of the targets' plots; of settled confirmed tracks, updated with plots of their targets, and with any plots; of
        the very plots of the former; and of the velocity of the same rows where the truth has one.
    """
    raw, any_plot = plot_errors(evaluation), track_errors(evaluation)
    tracked = any_plot[_updated_rightly(evaluation, any_plot.index)]
    updating = evaluation.history.plot_of_row[tracked.index]
    return {
        "rms_raw_m": _rms(raw.position),
        "rms_tracked_m": _rms(tracked.position),
        "rms_raw_of_tracked_m": _rms(raw.position[np.isin(raw.index, updating)]),
        "rms_tracked_any_plot_m": _rms(any_plot.position),
        "rms_velocity_m_s": _rms(_velocity_errors(evaluation, tracked)),
    }


def plot_errors(evaluation: Evaluation) -> Errors:
    """Position errors of the plots of targets.

    Args:
        evaluation: of a bag.

    Returns:
        One entry a plot of a target.
    """
    plots, target = evaluation.tables.plots, evaluation.labels.target
    index = np.flatnonzero(target != FALSE)
    index = index[evaluation.is_target[target[index]]]
    rows, time = plots.rows[index], plots.time[index]
    _, distance, azimuth = evaluation.paths.polar_at(target[index], time)
    x, y = enu_from_polar(rows["range"], rows["azimuth"])
    true_x, true_y = enu_from_polar(distance, azimuth)
    return Errors(index, time, np.hypot(x - true_x, y - true_y))


def track_errors(evaluation: Evaluation) -> Errors:
    """Position errors of settled tracks, each at the time of the plot that it was just updated with.

    Args:
        evaluation: of a bag.

    Returns:
        One entry a row of a true track that is confirmed and past its first plots.
    """
    tracks, history = evaluation.tables.tracks, evaluation.history
    track = history.track_of_row
    settled = (
        (tracks.rows["status"] == TrackStatus.CONFIRMED)
        & (tracks.rows["hits"] > evaluation.options.settled_after)
        & (history.plot_of_row != FALSE)
    )
    settled &= (history.true & (history.label != FALSE))[track]
    index = np.flatnonzero(settled)
    label, time = history.label[track[index]], tracks.time[index]
    present, truth = evaluation.paths.columns_at(label, time, "x", "y")
    rows = tracks.rows[index]
    error = np.hypot(rows["x"] - truth["x"], rows["y"] - truth["y"])
    return Errors(index[present], time[present], error[present])


def _updated_rightly(evaluation: Evaluation, index: IntArray) -> npt.NDArray[np.bool_]:
    history = evaluation.history
    label = history.label[history.track_of_row[index]]
    return np.asarray(evaluation.labels.target[history.plot_of_row[index]] == label)


def _velocity_errors(evaluation: Evaluation, settled: Errors) -> FloatArray:
    history, rows = evaluation.history, evaluation.tables.tracks.rows[settled.index]
    label = history.label[history.track_of_row[settled.index]]
    _, truth = evaluation.paths.columns_at(label, settled.time, "vx", "vy")
    error = np.hypot(rows["vx"] - truth["vx"], rows["vy"] - truth["vy"])
    return error[np.isfinite(error)]


def _rms(values: FloatArray) -> float:
    return float(np.sqrt(np.mean(np.square(values)))) if len(values) else float("nan")
