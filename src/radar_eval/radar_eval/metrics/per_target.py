# SPDX-License-Identifier: Apache-2.0
"""How each single target fared, and which fared worst."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from radar_eval.evaluation import Evaluation
from radar_eval.labelling import FALSE
from radar_eval.metrics.accuracy import track_errors

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]

FAR_OFF = 300.0
"""Position error in metres from which on a row of a track counts as trouble."""
_COST_OF_A_BREAK = 10


@dataclass(frozen=True, slots=True)
class TargetScores:
    """Scores of the targets of the tracking scores, one entry each.

    Attributes:
        target: index into the paths.
        plots: number of its plots.
        lost: number of these in no confirmed track.
        tracks: true confirmed tracks of it.
        switches: how often two of its plots in a row were in different confirmed tracks.
        rows: of its settled tracks.
        rms: m, position error of these rows; NaN without any.
        far_off: number of these rows farther off than FAR_OFF.
    """

    target: IntArray
    plots: IntArray
    lost: IntArray
    tracks: IntArray
    switches: IntArray
    rows: IntArray
    rms: FloatArray
    far_off: IntArray

    @property
    def trouble(self) -> IntArray:
        """Plots lost, rows far off, and ten for each track too many, shape (targets,)."""
        return self.lost + self.far_off + _COST_OF_A_BREAK * np.maximum(self.tracks - 1, 0)

    def worst(self, number: int) -> IntArray:
        """Find the targets with the most trouble.

        Args:
            number: how many, at most.

        Returns:
            Positions in these arrays, the worst first; targets without trouble are left out.
        """
        order = np.lexsort((-np.nan_to_num(self.rms), -self.trouble))
        return order[self.trouble[order] > 0][:number]


def score_targets(evaluation: Evaluation) -> TargetScores:
    """Score every target by itself.

    Args:
        evaluation: of a bag.

    Returns:
        The scores.
    """
    history, label = evaluation.history, evaluation.labels.target
    all_targets = len(evaluation.paths)
    # A plot may stand in two tracks that one plot opened; the elder one counts.
    track_of_plot = np.full(len(label), FALSE)
    pairs = history.of_plots[history.confirmed[history.of_plots[:, 0]]][::-1]
    track_of_plot[pairs[:, 1]] = pairs[:, 0]
    own = np.flatnonzero(label != FALSE)
    lost = own[track_of_plot[own] == FALSE]
    follows = history.label[history.true & (history.label != FALSE)]
    errors = track_errors(evaluation)
    of_row = history.label[history.track_of_row[errors.index]]
    rows = _count(of_row, all_targets)
    squares = np.bincount(of_row, np.square(errors.position), minlength=all_targets)
    target = np.flatnonzero(evaluation.is_target)
    mean = np.divide(squares, rows, out=np.full(all_targets, np.nan), where=rows > 0)
    return TargetScores(
        target=target,
        plots=evaluation.plots_of[target],
        lost=_count(label[lost], all_targets)[target],
        tracks=_count(follows, all_targets)[target],
        switches=_switches(label, track_of_plot, all_targets)[target],
        rows=rows[target],
        rms=np.sqrt(mean)[target],
        far_off=_count(of_row[errors.position > FAR_OFF], all_targets)[target],
    )


def _switches(label: IntArray, track: IntArray, targets: int) -> IntArray:
    held = np.flatnonzero((label != FALSE) & (track != FALSE))
    # Plots are in order of time, and the sort keeps it within each target.
    held = held[np.argsort(label[held], kind="stable")]
    changed = (np.diff(label[held]) == 0) & (np.diff(track[held]) != 0)
    return _count(label[held][1:][changed], targets)


def _count(of: IntArray, targets: int) -> IntArray:
    return np.bincount(of, minlength=targets)
