# SPDX-License-Identifier: Apache-2.0
"""A scene of plots given to a tracker, and what came of it in one row of numbers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from radar_common.tables import PLOTS_TOPIC, TRACKS_TOPIC, TRUTH_TOPIC, Table
from radar_eval.bag_tables import lay_out
from radar_eval.evaluation import Evaluation, ScoreOptions, evaluate
from radar_eval.metrics.accuracy import accuracy_scores
from radar_eval.metrics.continuity import continuity_scores
from radar_eval.metrics.per_target import score_targets
from radar_eval.metrics.set_distance import gospa_over_time
from radar_eval.studies.recording import run_tracker
from radar_eval.studies.tracking_peers import PEERS, run_peer
from radar_sim.plot_scenes import PlotScene, PlotSimulator
from secondary_proc.association import ASSOCIATIONS
from secondary_proc.parameters import TrackerParameters
from secondary_proc.smoothing import SMOOTHERS

START = 1_700_000_000_000_000_000

OURS = "ours"


@dataclass(frozen=True, slots=True)
class Contestant:
    """A tracker with its settings.

    Attributes:
        name: for the table.
        changes: of our parameters' defaults; None for one of Stone Soup's trackers.
    """

    name: str
    changes: dict[str, Any] | None = None


def contestants() -> list[Contestant]:
    """List who takes part.

    Returns:
        Ours as it is by default, then with every other smoother and association, then the peers.
    """
    default = TrackerParameters()
    ours = [Contestant(OURS, {})]
    ours += [
        Contestant(f"{OURS}, {name}", {kind: name})
        for kind, names in (("smoother", SMOOTHERS), ("association", ASSOCIATIONS))
        for name in names
        if name != getattr(default, kind)
    ]
    return ours + [Contestant(name) for name in PEERS]


def simulate(scene: PlotScene, seed: int) -> tuple[list[Table], list[Table]]:
    """Draw the plots of a scene.

    Args:
        scene: to simulate.
        seed: of everything random.

    Returns:
        (plots, truth): messages in order of time.
    """
    sectors = list(PlotSimulator(scene, np.random.default_rng(seed), start=START))
    return [sector.plots for sector in sectors], [sector.truth for sector in sectors]


def track(
    contestant: Contestant, scene: PlotScene, plots: Sequence[Table]
) -> tuple[float, list[Table]]:
    """Let a tracker work.

    Args:
        contestant: the tracker.
        scene: where the plots come from; peers are told the density of its false plots.
        plots: messages in order of time.

    Returns:
        (seconds, tracks): time that it took, and its messages.

    Raises:
        EvaluationError: Stone Soup is wanted and not installed.
    """
    if contestant.changes is None:
        radar = scene.scenario.radar
        false = scene.false_plots + sum(patch.per_scan for patch in scene.patches)
        work = partial(run_peer, contestant.name, period=radar.scan_period, false_plots=false)
        return work(plots, reach=radar.range_end)
    return run_tracker(plots, TrackerParameters().changed(contestant.changes))


def judge(
    scene: PlotScene, plots: Sequence[Table], truth: Sequence[Table], tracks: Sequence[Table]
) -> Evaluation:
    """Hold tracks against the truth, by which each plot is labelled exactly.

    Args:
        scene: gives the period.
        plots: messages.
        truth: messages.
        tracks: messages.

    Returns:
        The evaluation.
    """
    tables = lay_out({PLOTS_TOPIC: plots, TRACKS_TOPIC: tracks, TRUTH_TOPIC: truth})
    return evaluate(tables, ScoreOptions(scan_period=scene.scenario.radar.scan_period))


def score_row(evaluation: Evaluation, seconds: float) -> dict[str, float]:
    """Put the outcome into one row.

    Args:
        evaluation: of the tracks.
        seconds: that the tracker took.

    Returns:
        Numbers by name; distances in metres.
    """
    distance, targets = gospa_over_time(evaluation), score_targets(evaluation)
    continuity, accuracy = continuity_scores(evaluation), accuracy_scores(evaluation)
    return {
        "gospa_m": float(np.mean(distance.distance)),
        "gospa_localisation_m": float(np.mean(distance.localisation)),
        "gospa_missed": float(np.mean(distance.missed)),
        "gospa_false": float(np.mean(distance.false)),
        "targets": continuity["targets"],
        "targets_tracked": continuity["targets_tracked"],
        "tracks_per_target": continuity["tracks_per_target"],
        "plots_in_tracks": continuity["plots_in_tracks"],
        "completeness": continuity["completeness"],
        "false_tracks": continuity["false_tracks"],
        "switches": int(targets.switches.sum()),
        "position_rms_m": accuracy["rms_tracked_any_plot_m"],
        "plot_rms_m": accuracy["rms_raw_m"],
        "velocity_rms_m_s": accuracy["rms_velocity_m_s"],
        "scans_to_confirmation": continuity["scans_to_confirmation_mean"],
        "seconds": seconds,
        "plots_per_second": len(evaluation.tables.plots) / seconds,
    }
