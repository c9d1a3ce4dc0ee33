# SPDX-License-Identifier: Apache-2.0
"""What every detector loses against the ideal unquantised integrator, predicted and measured."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from primary_proc.calculators.integration.required_ratio import required_snr_db
from primary_proc.choices import METHODS
from primary_proc.methods.detection_method import SettledMethod
from radar_eval.command_line import progress
from radar_eval.figures.sensitivity import draw_sensitivity
from radar_eval.figures.style import as_png
from radar_eval.studies.detector_loss import Loss
from radar_eval.studies.detector_trials import TrialRadar, try_targets

PROGRAMS = ("2/2-2", "3/3-2", "4/4-2", "3/4-2", "3/5-3", "4/7-4", "5/8-4")
DETECTORS = (*PROGRAMS, *(name for name in METHODS if name != "auto"))
IDEAL = {"steady": "likelihood", "fast": "fast-fluctuation"}
PICTURE = "sensitivity.png"

_DETECTION = 0.9
_FALSE_STARTS = 2.4e-6
_LENGTH = 19.0
_SLOPE_DB = 0.25


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
        loss
        for target in progress(IDEAL, "targets", unit="kind")
        for loss in _losses_of(target, radar, detectors, seed)
    ]


def study_sensitivity(folder: Path) -> dict[str, Any]:
    """Run the study.

    Args:
        folder: where the picture goes.

    Returns:
        All losses, for JSON.
    """
    losses = measure_sensitivity()
    (folder / PICTURE).write_bytes(as_png(draw_sensitivity(losses)))
    return {"detection": _DETECTION, "losses": [asdict(loss) for loss in losses]}


def _losses_of(target: str, radar: TrialRadar, detectors: tuple[str, ...], seed: int) -> list[Loss]:
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
                detector,
                target,
                needed,
                needed - ideal,
                found,
                len(seen.found),
                needed - ideal + missing_db,
            )
        )
    return losses


def _settled(radar: TrialRadar, detector: str, target: str) -> SettledMethod:
    parameters = radar.parameters(detector, _FALSE_STARTS, fluctuation=target)
    return radar.design(parameters).method
