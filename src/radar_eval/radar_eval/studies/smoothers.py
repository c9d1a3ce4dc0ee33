# SPDX-License-Identifier: Apache-2.0
"""All smoothers of the tracker on the same simulated flights, straight and manoeuvring."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from radar_common.frames import enu_from_polar
from radar_eval.command_line import progress
from radar_eval.figures.smoothers import draw_smoothers
from radar_eval.figures.style import as_png
from radar_eval.studies.smoother_flights import FLIGHTS, Flight, Plotted, Radar, plots_of
from radar_eval.studies.smoother_outcome import Outcome
from radar_eval.studies.smoother_trials import Trial, track_alone
from secondary_proc.parameters import TrackerParameters

PICTURE = "smoothers.png"
PERIODS = (4.0, 10.0)
CONTESTANTS: dict[str, dict[str, Any]] = {
    "imm": {"smoother": "imm"},
    "imm, turns": {"smoother": "imm", "imm_manoeuvres": "turns"},
    "kalman": {"smoother": "kalman"},
    "alpha_beta": {"smoother": "alpha_beta"},
    "polynomial": {"smoother": "polynomial"},
    "speed_course": {"smoother": "speed_course"},
}
"""What is compared, by the name in the picture; all else is as by default."""


def compare_smoothers(
    targets: int = 300,
    seed: int = 1,
    *,
    periods: tuple[float, ...] = PERIODS,
    flights: tuple[Flight, ...] = FLIGHTS,
) -> list[Outcome]:
    """Let all smoothers follow the same plots.

    Args:
        targets: of each flight.
        seed: of places, courses, errors and misses.
        periods: of the antenna, s.
        flights: to follow.

    Returns:
        One entry a flight, period and smoother.
    """
    trials = [(flight, Radar(period)) for period in periods for flight in flights]
    outcomes = []
    for flight, radar in progress(trials, "flights", unit="flight"):
        plotted = plots_of(flight, radar, targets, np.random.default_rng(seed))
        for name, chosen in CONTESTANTS.items():
            parameters = TrackerParameters(
                **chosen, manoeuvre_acceleration=flight.manoeuvre_acceleration
            )
            trial = track_alone(plotted, radar, parameters)
            outcomes.append(_outcome(name, flight, radar, plotted, trial))
    return outcomes


def study_smoothers(folder: Path) -> dict[str, Any]:
    """Run the study.

    Args:
        folder: where the picture goes.

    Returns:
        All outcomes, for JSON.
    """
    outcomes = compare_smoothers()
    (folder / PICTURE).write_bytes(as_png(draw_smoothers(outcomes)))
    return {"outcomes": [asdict(outcome) for outcome in outcomes]}


def _outcome(name: str, flight: Flight, radar: Radar, plotted: Plotted, trial: Trial) -> Outcome:
    begin, end = flight.window
    counted = plotted.found & (plotted.time >= begin) & (plotted.time <= end)
    taken = counted & np.isfinite(trial.state[..., 0])
    truth = np.concatenate([plotted.position, plotted.velocity], axis=-1)[taken]
    error = trial.state[taken] - truth
    weighted = np.linalg.solve(trial.covariance[taken], error[:, :, None])[:, :, 0]
    measured = np.stack(enu_from_polar(plotted.range, plotted.azimuth), axis=-1)
    return Outcome(
        smoother=name,
        flight=flight.name,
        period=radar.period,
        plots=int(counted.sum()),
        plot_rms=_rms((measured - plotted.position)[taken]),
        position_rms=_rms(error[:, :2]),
        velocity_rms=_rms(error[:, 2:]),
        lost=float(trial.lost[counted].mean()),
        tracks_per_target=float(trial.opened.sum() / plotted.time.shape[1]),
        nees=float((error * weighted).sum(axis=1).mean()),
    )


def _rms(errors: np.ndarray[Any, np.dtype[np.float64]]) -> float:
    return float(np.sqrt((errors**2).sum(axis=-1).mean()))
