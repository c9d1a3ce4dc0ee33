# SPDX-License-Identifier: Apache-2.0
"""Fused bearings against the better of the two channels, at every moment of jamming, silence and neither."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from radar_eval.command_line import progress
from radar_eval.figures.channels_over_time import Moments, draw_channels_over_time
from radar_eval.figures.style import as_png
from radar_eval.studies.countermeasures_trials import FED, Trial, run_trial
from radar_sim.scenario import load_scenario

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]

PICTURE = "countermeasures.png"

_SCENARIO, _DURATION, _SEEDS = "countermeasures", 240.0, 20
_TRANSMITTING = (1, 2, 3)
"""The fourth target never transmits: there the better channel is the only one."""
_STEP, _BEGIN, _HALF_WINDOW = 0.5, 10.0, 3.0


def study_countermeasures(folder: Path) -> dict[str, Any]:
    """Run the study.

    Args:
        folder: where the picture goes.

    Returns:
        Errors by part of the run and way, for JSON.
    """
    return measure_countermeasures(folder, range(1, _SEEDS + 1), _DURATION)


def measure_countermeasures(folder: Path, seeds: Sequence[int], duration: float) -> dict[str, Any]:
    """Follow the scenario with several seeds and draw the errors over time.

    Args:
        folder: where the picture goes.
        seeds: of the simulator.
        duration: seconds of each run.

    Returns:
        As the study.
    """
    scenario = load_scenario(_SCENARIO)
    time = np.arange(_BEGIN, duration + _STEP / 2.0, _STEP)
    trials = [
        run_trial(scenario, seed, time, _TRANSMITTING)
        for seed in progress(seeds, "seeds", unit="seed")
    ]
    moments = _moments(trials, time)
    figure = draw_channels_over_time(
        moments,
        f"Error of the azimuth, rms of {len(seeds)} runs, mrad",
        ("radar alone", "finder alone"),
        better=True,
    )
    (folder / PICTURE).write_bytes(as_png(figure, dpi=120))
    ratio = moments.fused / moments.better
    return {
        "runs": len(seeds),
        "rms_mrad": {part: _rms(trials, chosen) for part, chosen in _parts(moments).items()},
        "fused_over_better": {
            "median": float(np.nanmedian(ratio)),
            "largest": float(np.nanmax(ratio)),
            "largest_at_s": float(time[np.nanargmax(ratio)]),
            "share_of_time_worse_by_a_tenth": float(np.mean(ratio > 1.1)),
        },
    }


def _parts(moments: Moments) -> dict[str, BoolArray]:
    jammed, silent = moments.truly_jammed, moments.truly_silent
    return {"clear": ~(jammed | silent), "jammed": jammed, "silent": silent}


def _rms(trials: Sequence[Trial], chosen: BoolArray) -> dict[str, float]:
    return {
        way: 1e3
        * float(np.sqrt(np.nanmean([trial.error[way][:, chosen] ** 2 for trial in trials])))
        for way in FED
        if chosen.any()
    }


def _moments(trials: Sequence[Trial], time: FloatArray) -> Moments:
    rms = {}
    for way in FED:
        squares = np.concatenate([trial.error[way] ** 2 for trial in trials])
        rms[way] = 1e3 * np.sqrt(_smoothed(squares))
    jammed, silent = (
        _smoothed(np.concatenate([getattr(trial, name) for trial in trials]), window=0)
        for name in ("jammed", "silent")
    )
    first = trials[0]
    return Moments(
        time,
        **rms,
        jammed=jammed,
        silent=silent,
        truly_jammed=first.truly_jammed,
        truly_silent=first.truly_silent,
    )


def _smoothed(values: FloatArray, window: int = round(_HALF_WINDOW / _STEP)) -> FloatArray:
    """Mean over all rows and a sliding window of columns, of what is there."""
    there = np.isfinite(values)
    total, number = np.where(there, values, 0.0).sum(axis=0), there.sum(axis=0)
    kernel = np.ones(2 * window + 1)
    # Fewer than half of the targets are no fair comparison: those that are easy would stand for all.
    enough = number >= 0.5 * len(values)
    mean = np.convolve(total, kernel, "same") / np.maximum(np.convolve(number, kernel, "same"), 1.0)
    return np.where(enough, mean, np.nan)
