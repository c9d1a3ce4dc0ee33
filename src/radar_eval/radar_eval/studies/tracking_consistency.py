# SPDX-License-Identifier: Apache-2.0
"""Whether the tracks' errors are as large as the tracks say, on flights that move as the filter assumes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from radar_common.frames import TWO_PI, enu_from_polar, polar_from_enu, wrap_two_pi
from radar_common.tables import (
    NANOSECONDS,
    PLOT,
    PLOTS_TOPIC,
    RADAR_FRAME,
    SITE_FRAME,
    TRACKS_TOPIC,
    TRUTH,
    TRUTH_TOPIC,
    Table,
)
from radar_eval.bag_tables import lay_out
from radar_eval.evaluation import Evaluation, ScoreOptions, evaluate
from radar_eval.metrics.consistency import innovations, state_errors
from radar_eval.studies.recording import run_tracker
from secondary_proc.motion import noise_density
from secondary_proc.parameters import TrackerParameters

FloatArray = npt.NDArray[np.float64]
Rows = npt.NDArray[np.void]

PERIOD = 4.0

_START = 1_700_000_000 * NANOSECONDS
_RANGE_STD, _AZIMUTH_STD = 30.0, 0.0015
_NEAREST, _FARTHEST = 25e3, 80e3


@dataclass(frozen=True, slots=True)
class ConsistencyRun:
    """Normalised squares of the runs of one smoother.

    Attributes:
        smoother: its name.
        scan: of each state, counted from the first, shape (n,).
        nees: of the states, shape (n,).
        nis_scan: of each innovation, shape (m,).
        nis: of the innovations, shape (m,).
        flights: number of targets.
    """

    smoother: str
    scan: npt.NDArray[np.int64]
    nees: FloatArray
    nis_scan: npt.NDArray[np.int64]
    nis: FloatArray
    flights: int


def run_matched(
    *, flights: int, scans: int, seed: int, smoother: str | None = None
) -> ConsistencyRun:
    """Track flights that move as the filter assumes, each plot with the errors that it tells.

    Uniform motion with white acceleration of the filter's own density; no false plots, none missed.

    Args:
        flights: number of targets, spread over the azimuth so that none comes near another.
        scans: turns of the antenna.
        seed: of everything random.
        smoother: by name; None for the default.

    Returns:
        The normalised squares.
    """
    parameters = TrackerParameters(false_tracks_per_hour=100.0)
    if smoother is not None:
        parameters = parameters.changed({"smoother": smoother})
    density = noise_density(parameters.acceleration)
    messages = list(_messages(flights, scans, density, np.random.default_rng(seed)))
    plots, truth = [message[0] for message in messages], [message[1] for message in messages]
    _, tracks = run_tracker(plots, parameters)
    tables = lay_out({PLOTS_TOPIC: plots, TRACKS_TOPIC: tracks, TRUTH_TOPIC: truth})
    evaluation = evaluate(tables, ScoreOptions(scan_period=PERIOD))
    states, plots_seen = state_errors(evaluation), innovations(evaluation)
    return ConsistencyRun(
        parameters.smoother,
        _scan(evaluation, states.index),
        states.value,
        _scan(evaluation, plots_seen.index),
        plots_seen.value,
        flights,
    )


def mean_over_scans(
    scan: npt.NDArray[np.int64], value: FloatArray, scans: int
) -> tuple[FloatArray, npt.NDArray[np.int64]]:
    """Average normalised squares over the flights.

    Args:
        scan: of each, shape (n,).
        value: shape (n,).
        scans: number of them.

    Returns:
        (mean, number): of each scan, shape (scans,); NaN and 0 where there is none.
    """
    number = np.bincount(scan, minlength=scans)[:scans]
    total = np.bincount(scan, value, minlength=scans)[:scans]
    return np.divide(total, number, out=np.full(scans, np.nan), where=number > 0), number


def _scan(evaluation: Evaluation, index: npt.NDArray[np.int64]) -> npt.NDArray[np.int64]:
    return np.floor(evaluation.tables.tracks.time[index] / PERIOD).astype(np.int64)


def _messages(
    flights: int, scans: int, density: float, rng: np.random.Generator
) -> list[tuple[Table, Table]]:
    """Plots and truth, one message of each a turn."""
    azimuth = TWO_PI * (np.arange(flights) + 0.5) / flights
    x, y = enu_from_polar(rng.uniform(_NEAREST, _FARTHEST, flights), azimuth)
    speed = rng.uniform(100.0, 200.0, flights)
    outward = azimuth + rng.choice([0.0, np.pi], flights) + rng.normal(0.0, 0.02, flights)
    state = np.stack([x, y, *enu_from_polar(speed, outward)], axis=1)
    time = PERIOD * azimuth / TWO_PI
    made = []
    for scan in range(scans):
        if scan:
            state, time = _advance(state, time, scan, density, rng)
        stamp = _START + round(scan * PERIOD * NANOSECONDS)
        order = np.argsort(time, kind="stable")
        plots, truth = _rows(state, time - scan * PERIOD, rng)
        made.append(
            (Table(stamp, plots[order], RADAR_FRAME), Table(stamp, truth[order], SITE_FRAME))
        )
    return made


def _advance(
    state: FloatArray, time: FloatArray, scan: int, density: float, rng: np.random.Generator
) -> tuple[FloatArray, FloatArray]:
    """Move to the next pass of the beam: the azimuth there is that of the prediction, to a fraction of its error."""
    ahead = state[:, :2] + PERIOD * state[:, 2:]
    azimuth = wrap_two_pi(np.arctan2(ahead[:, 0], ahead[:, 1]))
    later = PERIOD * (scan + azimuth / TWO_PI)
    seconds = (later - time)[:, None]
    first, second = rng.standard_normal((2, len(state), 2)) * np.sqrt(density * seconds)
    moved = state.copy()
    # Integral of white noise and its double integral, of correlation sqrt(3)/2.
    moved[:, :2] += seconds * state[:, 2:] + seconds * (first / 2.0 + second / np.sqrt(12.0))
    moved[:, 2:] += first
    return moved, later


def _rows(state: FloatArray, offset: FloatArray, rng: np.random.Generator) -> tuple[Rows, Rows]:
    plots, truth = np.zeros(len(state), PLOT), np.zeros(len(state), TRUTH)
    for column, name in enumerate(("x", "y", "vx", "vy")):
        truth[name] = state[:, column]
    truth["range"], truth["azimuth"] = polar_from_enu(state[:, 0], state[:, 1])
    truth["id"] = 1 + np.arange(len(state))
    truth["time_offset"] = plots["time_offset"] = offset
    plots["range"] = truth["range"] + _RANGE_STD * rng.standard_normal(len(state))
    plots["azimuth"] = wrap_two_pi(
        truth["azimuth"] + _AZIMUTH_STD * rng.standard_normal(len(state))
    )
    plots["range_std"], plots["azimuth_std"] = _RANGE_STD, _AZIMUTH_STD
    for name in ("amplitude", "snr_db", "quality", "radial_speed", "radial_speed_std"):
        plots[name] = np.nan
    return plots, truth
