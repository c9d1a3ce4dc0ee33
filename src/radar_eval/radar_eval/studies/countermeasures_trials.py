# SPDX-License-Identifier: Apache-2.0
"""Radar and direction finder under countermeasures, many seeds: the fusion with both channels and with either alone."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from bearing_tracker.bearing_fusion import BearingFusion
from bearing_tracker.fusion_parameters import FusionParameters
from radar_common.frames import wrap_pi
from radar_common.tables import (
    BEARINGS_TOPIC,
    CHANNEL_TRUTH_TOPIC,
    FUSED_BEARINGS_TOPIC,
    PLOTS_TOPIC,
    Table,
)
from radar_eval.bearing_evaluation import BearingEvaluation, evaluate_bearings
from radar_eval.bearing_tables import lay_out_bearings
from radar_sim.bearings.simulator import BearingSimulator
from radar_sim.scenario import Scenario

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]

FED = {
    "fused": (PLOTS_TOPIC, BEARINGS_TOPIC),
    "active": (PLOTS_TOPIC,),
    "passive": (BEARINGS_TOPIC,),
}
"""What the fusion hears in each of the three ways."""


@dataclass(frozen=True, slots=True)
class Trial:
    """One seed, at T times and for the first K sources.

    Attributes:
        error: of each way of FED, radians; NaN where it has no estimate, shape (K, T).
        jammed: probability of jamming that was told with the fused bearing of each target, shape (K, T).
        silent: the same of silence.
        truly_jammed: shape (T,).
        truly_silent: shape (T,).
    """

    error: Mapping[str, FloatArray]
    jammed: FloatArray
    silent: FloatArray
    truly_jammed: BoolArray
    truly_silent: BoolArray


def run_trial(scenario: Scenario, seed: int, time: FloatArray, sources: Sequence[int]) -> Trial:
    """Simulate once and follow the targets in three ways.

    Args:
        scenario: with both channels.
        seed: of the simulator.
        time: at which errors are wanted, seconds, shape (T,).
        sources: ids of the K targets.

    Returns:
        The trial.
    """
    parameters = FusionParameters(active_input="plots")
    messages: dict[str, list[Table]] = {}
    order: list[tuple[str, Table]] = []
    for _, topic, content in BearingSimulator(scenario, seed=seed, duration=float(time[-1])):
        if isinstance(content, Table):
            messages.setdefault(topic, []).append(content)
            order.append((topic, content))
    error, told = {}, {}
    for way, heard in FED.items():
        fusion = BearingFusion(parameters)
        fused = [fusion.process(content) for topic, content in order if topic in heard]
        fused.append(fusion.flush())
        tables = {CHANNEL_TRUTH_TOPIC: messages[CHANNEL_TRUTH_TOPIC], FUSED_BEARINGS_TOPIC: fused}
        evaluation = evaluate_bearings(lay_out_bearings(tables))
        error[way], told[way] = _at(evaluation, time, sources, parameters.end_after)
    jammed, silent = told["fused"]
    return Trial(error, jammed, silent, *_truth(evaluation, time))


def _at(
    evaluation: BearingEvaluation, time: FloatArray, sources: Sequence[int], patience: float
) -> tuple[FloatArray, tuple[FloatArray, FloatArray]]:
    """Carry the latest estimate of each target on to each time by its rate."""
    error, jammed, silent = np.full((3, len(sources), len(time)), np.nan)
    rows, fused = evaluation.tables.fused.rows, evaluation.fused
    for number, source in enumerate(sources):
        target = int(np.searchsorted(evaluation.paths.ids, source))
        mine = np.flatnonzero(fused.target == target)
        if not len(mine):
            continue
        latest = np.searchsorted(fused.time[mine], time, side="right") - 1
        row = mine[np.maximum(latest, 0)]
        age = time - fused.time[row]
        present, _, azimuth = evaluation.paths.polar_at(np.full(len(time), target), time)
        held = (latest >= 0) & (age <= patience) & present
        carried = rows["azimuth"][row] + rows["rate"][row] * age
        error[number] = np.where(held, wrap_pi(carried - azimuth), np.nan)
        jammed[number] = np.where(held, rows["active_health"][row, 1], np.nan)
        silent[number] = np.where(held, rows["passive_health"][row, 1], np.nan)
    return error, (jammed, silent)


def _truth(evaluation: BearingEvaluation, time: FloatArray) -> tuple[BoolArray, BoolArray]:
    channels = evaluation.tables.channels
    latest = np.searchsorted(channels.time, time, side="right") - 1
    rows = channels.rows[np.maximum(latest, 0)]
    return rows["active_health"][:, 0] < 0.5, rows["passive_health"][:, 0] < 0.5
