# SPDX-License-Identifier: Apache-2.0
"""Whether the errors of the tracks are as large as the tracks say.

NEES is the square of the state's error, normalised by its covariance; NIS that of the innovation. Where the models
are right both are chi-square variables, of four and of two degrees of freedom (Bar-Shalom, Li, Kirubarajan 2001,
§ 5.4). The innovation is not in the table of tracks, but the residual r of the plot against the updated state is: with
the optimal gain r = R S^-1 nu and its covariance R S^-1 R = R - H P H', so that r' (R - H P H')^-1 r = nu' S^-1 nu.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy import stats

from radar_common.frames import enu_covariance, enu_from_polar
from radar_common.tables import TrackStatus
from radar_eval.evaluation import Evaluation
from radar_eval.labelling import FALSE

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]

STATE_DEGREES, PLOT_DEGREES = 4, 2


@dataclass(frozen=True, slots=True)
class Normalised:
    """Normalised squares, one entry a row of a confirmed true track with a plot of its target.

    Attributes:
        index: of the row, shape (n,).
        value: NEES or NIS, shape (n,).
    """

    index: IntArray
    value: FloatArray


def consistency_scores(evaluation: Evaluation) -> dict[str, float]:
    """Score what the tracks say of their own errors.

    Args:
        evaluation: of a bag.

    Returns:
        Mean of NIS; two where the smoother's models and the plots' errors are right.
    """
    found = innovations(evaluation).value
    return {"nis_mean": float(np.mean(found)) if len(found) else float("nan")}


def state_errors(evaluation: Evaluation) -> Normalised:
    """Normalise the errors of the states.

    Args:
        evaluation: of a bag.

    Returns:
        NEES of four degrees of freedom; rows where the truth tells no velocity are left out.
    """
    index = _rows_with_right_plot(evaluation)
    tracks, history = evaluation.tables.tracks, evaluation.history
    label = history.label[history.track_of_row[index]]
    names = ("x", "y", "vx", "vy")
    present, truth = evaluation.paths.columns_at(label, tracks.time[index], *names)
    rows = tracks.rows[index]
    error = np.stack([rows[name] - truth[name] for name in names], axis=1)
    covariance = rows["covariance"].astype(float).reshape(-1, 4, 4)
    known = present & np.isfinite(error).all(axis=1)
    return _normalised(index[known], error[known], covariance[known])


def innovations(evaluation: Evaluation) -> Normalised:
    """Normalise the innovations, for smoothers whose gain is the optimal one.

    Args:
        evaluation: of a bag.

    Returns:
        NIS of two degrees of freedom; rows whose plots tell no errors are left out.
    """
    index = _rows_with_right_plot(evaluation)
    tracks, history = evaluation.tables.tracks, evaluation.history
    rows = tracks.rows[index]
    plots = evaluation.tables.plots.rows[history.plot_of_row[index]]
    x, y = enu_from_polar(plots["range"], plots["azimuth"])
    residual = np.stack([x - rows["x"], y - rows["y"]], axis=1)
    error = enu_covariance(
        plots["range"], plots["azimuth"], plots["range_std"], plots["azimuth_std"]
    )
    covariance = rows["covariance"].astype(float).reshape(-1, 4, 4)[:, :2, :2]
    told = (plots["range_std"] > 0.0) & (plots["azimuth_std"] > 0.0)
    return _normalised(index[told], residual[told], (error - covariance)[told])


def bounds_of_mean(degrees: int, number: int, probability: float = 0.95) -> tuple[float, float]:
    """Bounds for the mean of normalised squares.

    Args:
        degrees: of freedom of one.
        number: of independent ones in the mean.
        probability: with which the mean lies between the bounds.

    Returns:
        (lower, upper).
    """
    tail = 0.5 * (1.0 - probability)
    total = stats.chi2(degrees * number)
    return float(total.ppf(tail)) / number, float(total.ppf(1.0 - tail)) / number


def _rows_with_right_plot(evaluation: Evaluation) -> IntArray:
    tracks, history = evaluation.tables.tracks, evaluation.history
    plot, track = history.plot_of_row, history.track_of_row
    taken = (tracks.rows["status"] == TrackStatus.CONFIRMED) & (plot != FALSE)
    taken &= (history.true & (history.label != FALSE))[track]
    taken &= evaluation.labels.target[plot] == history.label[track]
    return np.flatnonzero(taken)


def _normalised(index: IntArray, error: FloatArray, covariance: FloatArray) -> Normalised:
    # A covariance that is not positive normalises nothing; such rows are no evidence either way.
    positive = np.linalg.eigvalsh(covariance)[:, 0] > 0.0 if len(index) else np.zeros(0, bool)
    index, error, covariance = index[positive], error[positive], covariance[positive]
    solved = np.linalg.solve(covariance, error[:, :, None])[:, :, 0]
    return Normalised(index, np.asarray(np.sum(error * solved, axis=1)))
