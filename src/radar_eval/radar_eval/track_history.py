# SPDX-License-Identifier: Apache-2.0
"""What became of each track: its plots, its life, and the target that most of its plots came from."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.spatial import cKDTree

from radar_common.tables import TrackStatus
from radar_eval.bag_tables import TimedRows
from radar_eval.labelling import FALSE

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]
BoolArray = npt.NDArray[np.bool_]

# Range and azimuth are copied bit by bit; a time is added to another stamp, which may change its last bits.
_TIME_TOLERANCE = 1e-5


@dataclass(frozen=True, slots=True)
class TrackHistory:
    """Tracks and their plots; one entry a track unless said otherwise.

    Attributes:
        ids: as published, shape (k,).
        track_of_row: index of the track of each row of the table, shape (rows,).
        plot_of_row: index of the plot of each row, FALSE for a prediction, shape (rows,).
        plots: number of plots.
        confirmed: whether it was ever confirmed.
        confirmed_at: seconds, infinite if it never was.
        first_at: seconds of its first row.
        last_at: seconds of its last row that is not its end.
        label: target that most of its plots came from, FALSE if none did.
        purity: share of its plots that came from that target.
        of_plots: (track, plot) pairs, shape (pairs, 2), each once.
    """

    ids: npt.NDArray[np.uint32]
    track_of_row: IntArray
    plot_of_row: IntArray
    plots: IntArray
    confirmed: BoolArray
    confirmed_at: FloatArray
    first_at: FloatArray
    last_at: FloatArray
    label: IntArray
    purity: FloatArray
    of_plots: npt.NDArray[np.int64]

    @property
    def false(self) -> BoolArray:
        """Confirmed tracks of which less than half of the plots came from one target, shape (k,)."""
        return self.confirmed & (self.purity < 0.5)

    @property
    def true(self) -> BoolArray:
        """Confirmed tracks that are not false, shape (k,)."""
        return self.confirmed & ~self.false


def trace_tracks(tracks: TimedRows, plots: TimedRows, target_of_plot: IntArray) -> TrackHistory:
    """Find the plots of each track and the target behind it.

    Args:
        tracks: rows of dtype TRACK.
        plots: rows of dtype PLOT, shape (n,).
        target_of_plot: label of each plot or FALSE, shape (n,).

    Returns:
        The history.
    """
    ids, track_of_row = np.unique(tracks.rows["id"], return_inverse=True)
    plot_of_row = join_plots(tracks, plots)
    has_plot = plot_of_row != FALSE
    of_plots = np.unique(
        np.stack([track_of_row[has_plot], plot_of_row[has_plot]], axis=1), axis=0
    ).astype(np.int64)
    number = np.bincount(of_plots[:, 0], minlength=len(ids))
    label, votes = _majority(of_plots[:, 0], target_of_plot[of_plots[:, 1]], len(ids))
    status = tracks.rows["status"]
    sure = np.isin(status, (TrackStatus.CONFIRMED, TrackStatus.COASTING))
    alive = status != TrackStatus.ENDED
    confirmed_at = _extreme(np.minimum, track_of_row[sure], tracks.time[sure], len(ids), np.inf)
    return TrackHistory(
        ids=ids,
        track_of_row=track_of_row,
        plot_of_row=plot_of_row,
        plots=number,
        confirmed=np.isfinite(confirmed_at),
        confirmed_at=confirmed_at,
        first_at=_extreme(np.minimum, track_of_row, tracks.time, len(ids), np.inf),
        last_at=_extreme(np.maximum, track_of_row[alive], tracks.time[alive], len(ids), -np.inf),
        label=label,
        purity=votes / np.maximum(number, 1),
        of_plots=of_plots,
    )


def join_plots(tracks: TimedRows, plots: TimedRows) -> IntArray:
    """Find the plot that each row of a track was updated with.

    Args:
        tracks: rows of dtype TRACK, shape (m,).
        plots: rows of dtype PLOT, shape (n,).

    Returns:
        Index of the plot with the same range, azimuth and time; FALSE for a prediction or a plot that is not there,
        shape (m,).
    """
    found = np.full(len(tracks), FALSE)
    updated = np.flatnonzero(
        np.isfinite(tracks.rows["plot_range"]) & np.isfinite(tracks.rows["plot_azimuth"])
    )
    if not len(plots) or not len(updated):
        return found
    rows = tracks.rows[updated]
    tree = cKDTree(np.stack([plots.rows["range"], plots.rows["azimuth"], plots.time], axis=1))
    nearest = np.asarray(
        tree.query(
            np.stack([rows["plot_range"], rows["plot_azimuth"], tracks.time[updated]], axis=1)
        )[1]
    )
    same = (
        (plots.rows["range"][nearest] == rows["plot_range"])
        & (plots.rows["azimuth"][nearest] == rows["plot_azimuth"])
        & (np.abs(plots.time[nearest] - tracks.time[updated]) <= _TIME_TOLERANCE)
    )
    found[updated[same]] = nearest[same]
    return found


def _majority(track: IntArray, target: IntArray, tracks: int) -> tuple[IntArray, IntArray]:
    label, votes = np.full(tracks, FALSE), np.zeros(tracks, np.int64)
    labelled = target != FALSE
    pairs, counts = np.unique(
        np.stack([track[labelled], target[labelled]], axis=1), axis=0, return_counts=True
    )
    # In rising order of votes, so that the last one written is the winner; ties go to the smaller index.
    order = np.lexsort((-pairs[:, 1], counts))
    label[pairs[order, 0]] = pairs[order, 1]
    votes[pairs[order, 0]] = np.take(counts, order)
    return label, votes


def _extreme(
    choose: np.ufunc, track: IntArray, time: FloatArray, tracks: int, start: float
) -> FloatArray:
    extreme = np.full(tracks, start)
    choose.at(extreme, track, time)
    return extreme
