# SPDX-License-Identifier: Apache-2.0
"""Everything in a bag that can be held against a truth: the radar's plots and tracks, fused bearings, emitters."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from radar_common.bag import topics
from radar_common.health import Health
from radar_common.tables import TRACKS_TOPIC
from radar_eval.bag_tables import load_tables
from radar_eval.bearing_evaluation import BearingEvaluation, evaluate_bearings
from radar_eval.bearing_tables import load_bearing_tables
from radar_eval.emitter_evaluation import EmitterEvaluation, evaluate_emitters
from radar_eval.evaluation import Evaluation, ScoreOptions, evaluate
from radar_eval.metrics.bearings import bearing_scores
from radar_eval.metrics.emitters import emitter_scores
from radar_eval.run_record import RunRecord
from radar_eval.scores import compute_scores


@dataclass(frozen=True, slots=True)
class WholeBag:
    """What a bag's results are worth; None for what it does not hold.

    Attributes:
        radar: plots and tracks.
        bearings: fused bearings.
        emitters: located emitters.
    """

    radar: Evaluation | None
    bearings: BearingEvaluation | None = None
    emitters: EmitterEvaluation | None = None

    def scores(self, run: RunRecord | None) -> dict[str, Any]:
        """Compute all scores.

        Args:
            run: what the offline run noted down; None if there was none.

        Returns:
            Names and values as docs/radar_eval.md defines them.
        """
        scores: dict[str, Any] = {}
        if self.radar is not None:
            scores |= compute_scores(self.radar, run)
        if self.bearings is not None:
            scores |= bearing_scores(self.bearings)
        if self.emitters is not None:
            scores |= emitter_scores(self.emitters)
        return scores


def evaluate_bag(
    path: str | Path,
    options: ScoreOptions,
    *,
    truth_path: str | Path | None = None,
    health: Health | None = None,
) -> WholeBag:
    """Hold all of a bag against its truth.

    A bag with fused bearings or emitters need have no radar: its plots are scored where it has tracks as well.

    Args:
        path: folder of the bag.
        options: what counts as what.
        truth_path: bag to take the truth from instead.
        health: counts messages that do not hold their table.

    Returns:
        The evaluations.

    Raises:
        BagError: a bag is missing, truncated or not readable.
        ScoreError: there is nothing to score, or no truth.
        RotationError: the plots do not tell how the antenna turned.
    """
    bearings = load_bearing_tables(path, truth_path=truth_path, health=health)
    alone = bearings.has_results and not topics(path).get(TRACKS_TOPIC, 0)
    return WholeBag(
        None
        if alone
        else evaluate(load_tables(path, truth_path=truth_path, health=health), options),
        evaluate_bearings(bearings) if len(bearings.fused) else None,
        evaluate_emitters(bearings) if len(bearings.emitters) else None,
    )
