# SPDX-License-Identifier: Apache-2.0
"""GOSPA between the targets and the confirmed tracks, once a scan."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from radar_common.tables import TrackStatus
from radar_eval.evaluation import Evaluation
from radar_eval.gospa import gospa

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class GospaOverTime:
    """GOSPA at the end of each scan.

    Attributes:
        time: seconds after the bag's origin, shape (scans,).
        distance: m, shape (scans,).
        localisation: root of the sum of the squared distances of the pairs, m, shape (scans,).
        missed: number of targets without a track, shape (scans,).
        false: number of tracks without a target, shape (scans,).
    """

    time: FloatArray
    distance: FloatArray
    localisation: FloatArray
    missed: FloatArray
    false: FloatArray


def gospa_over_time(evaluation: Evaluation) -> GospaOverTime:
    """Compare the pictures at the end of each scan.

    A target is there from its first to its last plot; a track from its confirmation until it ends, carried on with its
    last velocity.

    Args:
        evaluation: of a bag.

    Returns:
        The distance and its parts.
    """
    cutoff, period = evaluation.options.gospa_cutoff, evaluation.rotation.period
    # The last turn is left out: a target whose last plot was in it would already seem to be gone.
    time = np.arange(evaluation.tables.start + period, evaluation.tables.stop - period, period)
    targets = _targets_at(evaluation, time)
    tracks = _tracks_at(evaluation, time)
    parts = [gospa(x, y, cutoff=cutoff) for x, y in zip(targets, tracks, strict=True)]
    alone = cutoff**2 / 2.0
    return GospaOverTime(
        time,
        np.array([part.distance for part in parts]),
        np.sqrt([part.localisation for part in parts]),
        np.array([part.missed / alone for part in parts]),
        np.array([part.false / alone for part in parts]),
    )


def gospa_scores(evaluation: Evaluation) -> dict[str, float]:
    """Score the whole picture.

    Args:
        evaluation: of a bag.

    Returns:
        Means over the scans: distance, number missed, number false; and the cutoff.
    """
    over_time = gospa_over_time(evaluation)
    means = [
        float(np.mean(values)) if len(values) else float("nan")
        for values in (over_time.distance, over_time.missed, over_time.false)
    ]
    return {
        "gospa_m": means[0],
        "gospa_missed": means[1],
        "gospa_false": means[2],
        "gospa_cutoff_m": evaluation.options.gospa_cutoff,
    }


def _targets_at(evaluation: Evaluation, time: FloatArray) -> list[FloatArray]:
    begin, end = evaluation.seen_from, evaluation.seen_until
    scan, target = np.nonzero((begin <= time[:, None]) & (time[:, None] <= end))
    present, position = evaluation.paths.columns_at(target, time[scan], "x", "y")
    points = np.stack([position["x"], position["y"]], axis=1)[present]
    return _by_scan(points, scan[present], len(time))


def _tracks_at(evaluation: Evaluation, time: FloatArray) -> list[FloatArray]:
    tracks, history = evaluation.tables.tracks, evaluation.history
    rows = tracks.rows
    order = np.lexsort((tracks.time, history.track_of_row))
    track, row_time, status = history.track_of_row[order], tracks.time[order], rows["status"][order]
    later = np.append(np.where(track[1:] == track[:-1], row_time[1:], np.inf), np.inf)[: len(order)]
    # A track that is never told to have ended lasts until a plot is overdue.
    until = np.minimum(later, row_time + 1.5 * evaluation.rotation.period)
    shown = np.isin(status, (TrackStatus.CONFIRMED, TrackStatus.COASTING))
    first = np.searchsorted(time, row_time[shown])
    number = np.searchsorted(time, until[shown]) - first
    index = np.repeat(order[shown], number)
    scan = np.repeat(first, number) + np.arange(len(index))
    scan -= np.repeat(np.cumsum(number) - number, number)
    ahead = time[scan] - tracks.time[index]
    points = np.stack(
        [
            rows["x"][index] + ahead * rows["vx"][index],
            rows["y"][index] + ahead * rows["vy"][index],
        ],
        axis=1,
    )
    return _by_scan(points, scan, len(time))


def _by_scan(points: FloatArray, scan: npt.NDArray[np.int64], scans: int) -> list[FloatArray]:
    order = np.argsort(scan, kind="stable")
    return np.split(points[order], np.searchsorted(scan[order], np.arange(1, scans)))
