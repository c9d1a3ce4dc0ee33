# SPDX-License-Identifier: Apache-2.0
"""Whether each target had a track, one track, all the time, soon; and which tracks had no target.

The questions are those of the SIAP measures (completeness, ambiguity, spuriousness; SIAP System Engineering Task
Force, Technical Report 2001-003), counted here over whole tracks.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from radar_common.tables import EndReason, TrackStatus
from radar_eval.evaluation import Evaluation

BoolArray = npt.NDArray[np.bool_]

# A track that ended and says "alive" comes from a version that told no reasons.
_REASONS = {int(reason): reason.name.lower().replace("_", " ") for reason in EndReason} | {
    int(EndReason.ALIVE): "not told"
}


def continuity_scores(evaluation: Evaluation) -> dict[str, float]:
    """Score the lives of the tracks.

    Args:
        evaluation: of a bag.

    Returns:
        Targets (tracked, missed), tracks a target, share of the targets' plots that are in confirmed tracks,
        completeness, false tracks, scans from a target's first plot to its first confirmed track.
    """
    is_target, history = evaluation.is_target, evaluation.history
    follows = history.true & (history.label >= 0)
    follows[follows] = is_target[history.label[follows]]
    tracks_of = np.bincount(history.label[follows], minlength=len(is_target))
    tracked = int(np.sum(tracks_of > 0))
    targets = int(np.sum(is_target))
    wait = _scans_to_confirmation(evaluation, follows)
    covered = looks_covered(evaluation)
    wanted = is_target[evaluation.looks.target] & seen(evaluation)
    return {
        "targets": targets,
        "targets_tracked": tracked,
        "targets_missed": targets - tracked,
        "tracks_per_target": _ratio(int(np.sum(follows)), tracked),
        "plots_in_tracks": _plots_in_tracks(evaluation),
        "completeness": _ratio(int(np.sum(covered & wanted)), int(np.sum(wanted))),
        "confirmed_tracks": int(np.sum(history.confirmed)),
        "false_tracks": int(np.sum(history.false)),
        "scans_to_confirmation_mean": float(np.mean(wait)) if len(wait) else float("nan"),
        "scans_to_confirmation_median": float(np.median(wait)) if len(wait) else float("nan"),
    }


def seen(evaluation: Evaluation) -> BoolArray:
    """Tell which passes lie between the first and the last plot of their target.

    Args:
        evaluation: of a bag.

    Returns:
        Boolean array, shape (looks,).
    """
    target, time = evaluation.looks.target, evaluation.looks.time
    # A plot's time and the pass that it belongs to differ by as much as its azimuth is wrong.
    jitter = 0.1 * evaluation.rotation.period
    return (time >= evaluation.seen_from[target] - jitter) & (
        time <= evaluation.seen_until[target] + jitter
    )


def looks_covered(evaluation: Evaluation) -> BoolArray:
    """Tell at which passes over targets a true confirmed track of the target was alive.

    Args:
        evaluation: of a bag.

    Returns:
        Boolean array, shape (looks,).
    """
    looks, history = evaluation.looks, evaluation.history
    if not len(looks):
        return np.zeros(0, dtype=bool)
    alive = history.true & (history.label >= 0)
    start = float(looks.time.min())
    span = float(np.ptp(looks.time)) + 1.0
    keys = looks.target * span + (looks.time - start)
    target, jitter = history.label[alive], 0.1 * evaluation.rotation.period

    def position(time: npt.NDArray[np.float64]) -> npt.NDArray[np.int64]:
        inside = np.clip(time - start, -0.25, span - 0.5)
        return np.searchsorted(keys, target * span + inside)

    changes = np.zeros(len(looks) + 1, np.int64)
    np.add.at(changes, position(history.confirmed_at[alive] - jitter), 1)
    np.add.at(changes, position(history.last_at[alive] + jitter), -1)
    return np.cumsum(changes[:-1]) > 0


def ends_of_tracks(evaluation: Evaluation) -> dict[str, int]:
    """Count why confirmed tracks ended.

    Args:
        evaluation: of a bag.

    Returns:
        Number of tracks by reason, the most frequent first; none for those that were alive at the end.
    """
    history, tracks = evaluation.history, evaluation.tables.tracks.rows
    ended = tracks["status"] == TrackStatus.ENDED
    ended &= history.confirmed[history.track_of_row]
    reasons, numbers = np.unique(tracks["end_reason"][ended], return_counts=True)
    order = np.argsort(-numbers, kind="stable")
    return {_REASONS.get(int(reasons[i]), "unknown"): int(numbers[i]) for i in order}


def _plots_in_tracks(evaluation: Evaluation) -> float:
    label, history = evaluation.labels.target, evaluation.history
    of_target = label >= 0
    of_target[of_target] = evaluation.is_target[label[of_target]]
    kept = np.zeros(len(label), dtype=bool)
    in_confirmed = history.confirmed[history.of_plots[:, 0]]
    kept[history.of_plots[in_confirmed, 1]] = True
    return _ratio(int(np.sum(kept & of_target)), int(np.sum(of_target)))


def _scans_to_confirmation(evaluation: Evaluation, follows: BoolArray) -> npt.NDArray[np.float64]:
    history = evaluation.history
    first = np.full(len(evaluation.paths), np.inf)
    np.minimum.at(first, history.label[follows], history.confirmed_at[follows])
    confirmed = np.isfinite(first)
    return (first[confirmed] - evaluation.seen_from[confirmed]) / evaluation.rotation.period


def _ratio(part: int, whole: int) -> float:
    return part / whole if whole else float("nan")
