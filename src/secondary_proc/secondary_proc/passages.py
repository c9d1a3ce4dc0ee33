# SPDX-License-Identifier: Apache-2.0
"""What a passage of the beam changes in tracks: a plot, a miss, the verdict on a candidate."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from radar_common.tables import EndReason, TrackStatus
from secondary_proc import score
from secondary_proc.detection import DetectionByRange
from secondary_proc.initiation import Evidence, Initiation
from secondary_proc.plots import AZIMUTH, RANGE, FloatArray, Plots
from secondary_proc.smoothing import Measured, Smoother
from secondary_proc.track_store import Columns

if TYPE_CHECKING:
    from secondary_proc.parameters import TrackerParameters

BoolArray = npt.NDArray[np.bool_]

# Plain numbers: numpy takes several times as long to compare with a member of an enumeration.
TENTATIVE = int(TrackStatus.TENTATIVE)
CONFIRMED = int(TrackStatus.CONFIRMED)
COASTING = int(TrackStatus.COASTING)
ENDED = int(TrackStatus.ENDED)
_ALIVE, _MISSES, _SCORE = int(EndReason.ALIVE), int(EndReason.MISSES), int(EndReason.SCORE)
_OUT_OF_COVERAGE = int(EndReason.OUT_OF_COVERAGE)
_NOT_CONFIRMED = int(EndReason.NOT_CONFIRMED)


def take_plots(tracks: Columns, plots: Plots, gain: FloatArray, smoother: Smoother) -> None:
    """Give tracks their plots.

    Args:
        tracks: changed, n of them.
        plots: n of them.
        gain: of the score, shape (n,).
        smoother: that improves the state.
    """
    tracks.hits += 1
    tracks.misses[:] = 0
    tracks.status[tracks.status == COASTING] = CONFIRMED
    smoothed = smoother.update(
        Measured(
            state=tracks.state,
            covariance=tracks.covariance,
            memory=tracks.memory,
            hits=tracks.hits,
            seconds=plots.time - tracks.time,
            position=plots.position,
            position_covariance=plots.covariance,
            azimuth=plots.azimuth,
        )
    )
    tracks.state[:], tracks.covariance[:] = smoothed.state, smoothed.covariance
    tracks.memory[:] = smoothed.memory
    tracks.passed[:], tracks.schedule[:] = plots.time, np.inf
    tracks.plot[:] = plots.values[RANGE : AZIMUTH + 1]
    tracks.score += gain
    np.maximum(tracks.best, tracks.score, out=tracks.best)


def take_misses(
    tracks: Columns, parameters: TrackerParameters, detection: DetectionByRange
) -> BoolArray:
    """Count a passage without a plot; confirmed tracks coast or end by it.

    Args:
        tracks: changed, n of them.
        parameters: misses in a row that end a confirmed track, and the range beyond which there are no plots.
        detection: probability of a plot per passage.

    Returns:
        Which tracks are tentative and wait for the verdict of their rule, shape (n,).
    """
    tentative: BoolArray = tracks.status == TENTATIVE
    x, y = (tracks.state[:, :2] + tracks.state[:, 2:] * (tracks.expected - tracks.time)[:, None]).T
    distance = np.hypot(x, y)
    probability = detection.probability(distance)
    allowed = parameters.confirmed_misses
    tracks.misses += 1
    tracks.score += score.miss(probability)
    tracks.crossing[:] = tracks.expected
    spent = score.is_spent(tracks.best, tracks.score, allowed, probability)
    reason = np.where(tracks.misses >= allowed, _MISSES, np.where(spent, _SCORE, _ALIVE))
    reason = np.where(distance > parameters.maximum_range, _OUT_OF_COVERAGE, reason)
    tracks.reason[:] = np.where(tentative, _ALIVE, reason)
    tracks.status[:] = np.where(tentative, TENTATIVE, np.where(reason == _ALIVE, COASTING, ENDED))
    return tentative


def judge(
    tracks: Columns, tentative: BoolArray, initiation: Initiation, *, found: bool, threshold: float
) -> int:
    """Let the rule of initiation decide about candidates.

    Args:
        tracks: changed, n of them.
        tentative: which of them are candidates, shape (n,).
        initiation: the rule.
        found: whether the passage brought a plot.
        threshold: score of confirmation.

    Returns:
        How many have been confirmed.
    """
    verdict = initiation.judge(
        Evidence(
            rule=tracks.rule[tentative],
            found=np.full(int(np.count_nonzero(tentative)), found),
            hits=tracks.hits[tentative],
            misses=tracks.misses[tentative],
            score=tracks.score[tentative],
            threshold=threshold,
        )
    )
    tracks.rule[tentative] = verdict.rule
    tracks.status[tentative] = np.where(
        verdict.dropped, ENDED, np.where(verdict.confirmed, CONFIRMED, TENTATIVE)
    )
    tracks.reason[tentative] = np.where(verdict.dropped, _NOT_CONFIRMED, _ALIVE)
    return int(np.count_nonzero(verdict.confirmed))
