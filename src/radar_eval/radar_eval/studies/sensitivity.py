# SPDX-License-Identifier: Apache-2.0
"""What every detector loses against the ideal unquantised integrator, predicted and measured."""

from __future__ import annotations

import math
from dataclasses import dataclass

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure

from primary_proc.calculators.required_ratio import required_snr_db
from primary_proc.choices import METHODS
from primary_proc.methods.detection_method import SettledMethod
from radar_common.figure_style import FAINT, LINES, style
from radar_eval.studies.detector_trials import TrialRadar, try_targets

PROGRAMS = ("2/2-2", "3/3-2", "4/4-2", "3/4-2", "3/5-3", "4/7-4", "5/8-4")
DETECTORS = (*PROGRAMS, *(name for name in METHODS if name != "auto"))
IDEAL = {"steady": "likelihood", "fast": "fast-fluctuation"}

_DETECTION = 0.9
_FALSE_STARTS = 2.4e-6
_LENGTH = 19.0
_SLOPE_DB = 0.25


@dataclass(frozen=True, slots=True)
class Loss:
    """Sensitivity of one detector to one kind of target.

    Attributes:
        detector: its name.
        target: fluctuation.
        required_snr_db: ratio at which 90 % are detected, as predicted.
        loss_db: that ratio over the ideal integrator's.
        found: share of the targets of that ratio that the extractor found.
        targets: how many there were.
        measured_loss_db: the loss that this share means.
    """

    detector: str
    target: str
    required_snr_db: float
    loss_db: float
    found: float
    targets: int
    measured_loss_db: float


def measure_sensitivity(
    radar: TrialRadar | None = None, detectors: tuple[str, ...] = DETECTORS, seed: int = 1
) -> list[Loss]:
    """Predict and measure, all detectors at the same false starts: 10 false plots on 1024 x 4096 cells.

    Args:
        radar: on trial; None for one with 19 pulses in a burst.
        detectors: names.
        seed: of noise and targets; all detectors see the same.

    Returns:
        One entry a detector and kind of target.
    """
    radar = radar or TrialRadar(4096, 128, pulses_in_burst=_LENGTH)
    return [
        loss for target in IDEAL for loss in _losses_of(target, radar, detectors, seed)
    ]


def draw_sensitivity(losses: list[Loss]) -> Figure:
    """Draw the losses side by side.

    Args:
        losses: of any detectors.

    Returns:
        The figure.
    """
    names = list(dict.fromkeys(loss.detector for loss in losses))
    place = {name: -row for row, name in enumerate(names)}
    with style():
        figure, panels = plt.subplots(
            1, len(IDEAL), figsize=(9.0, 0.8 + 0.27 * len(names)), layout="constrained", sharey=True
        )
        for axes, target in zip(panels, IDEAL, strict=True):
            shown = [loss for loss in losses if loss.target == target]
            rows = [place[loss.detector] for loss in shown]
            axes.barh(rows, [loss.loss_db for loss in shown], 0.62, color=FAINT, label="predicted")
            axes.plot(
                [loss.measured_loss_db for loss in shown], rows, "o", color=LINES[0], ms=4,
                label="measured",
            )  # fmt: skip
            axes.set_yticks(list(place.values()), names)
            axes.set(title=f"{target} target", xlabel="loss at 90 % detection, dB")
            axes.grid(visible=False, axis="y")
        panels[-1].legend(loc="lower right")
    return figure


def _losses_of(
    target: str, radar: TrialRadar, detectors: tuple[str, ...], seed: int
) -> list[Loss]:
    ideal = required_snr_db(_settled(radar, IDEAL[target], target), _DETECTION, target)
    losses = []
    for detector in detectors:
        method = _settled(radar, detector, target)
        needed = required_snr_db(method, _DETECTION, target)
        parameters = radar.parameters(detector, _FALSE_STARTS, fluctuation=target)
        seen = try_targets(radar, parameters, needed, target, np.random.default_rng(seed))
        found = float(seen.found.mean())
        around = needed + np.array([-_SLOPE_DB, _SLOPE_DB])
        low, high = method.detection_probability(around, target)
        missing_db = (_DETECTION - found) * 2.0 * _SLOPE_DB / (high - low)
        losses.append(
            Loss(
                detector, target, needed, needed - ideal, found, len(seen.found),
                needed - ideal + missing_db,
            )  # fmt: skip
        )
    return losses


def _settled(radar: TrialRadar, detector: str, target: str) -> SettledMethod:
    parameters = radar.parameters(detector, _FALSE_STARTS, fluctuation=target)
    method = radar.design(parameters).method
    if not math.isfinite(method.false_starts):
        raise ValueError(f"{detector} has no prediction of its false starts")
    return method
