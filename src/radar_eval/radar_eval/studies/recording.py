# SPDX-License-Identifier: Apache-2.0
"""A recording tried with more and more false plots: one half to choose parameters on, the other to report."""

from __future__ import annotations

import time
from collections.abc import Iterable, Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy import stats

from radar_common.frames import enu_from_polar
from radar_common.tables import (
    NANOSECONDS,
    PLOTS_TOPIC,
    RADAR_FRAME,
    SITE_FRAME,
    TRACKS_TOPIC,
    TRUTH_TOPIC,
    Table,
)
from radar_eval.antenna import Rotation, estimate_rotation
from radar_eval.bag_tables import BagTables, TimedRows, lay_out
from radar_eval.errors import ScoreError
from radar_eval.evaluation import Evaluation, ScoreOptions, evaluate
from radar_eval.false_plots import draw_false_plots
from radar_eval.metrics.per_target import score_targets
from radar_eval.run_record import RunRecord
from radar_eval.scores import compute_scores
from radar_eval.sectors import cut_into_sectors
from secondary_proc.parameters import TrackerParameters
from secondary_proc.tracker import Tracker

HALVES = {"first": (0.0, 0.5), "second": (0.5, 1.0), "all": (0.0, 1.0)}
"""Share of the recording's time at which each part begins and ends."""

_SECONDS_PER_HOUR = 3600.0
_SURE = 0.95


@dataclass(frozen=True, kw_only=True, slots=True)
class TrialOptions:
    """What to try a recording with.

    Attributes:
        half: key of HALVES.
        nearest: m, false plots lie beyond it.
        farthest: m, false plots lie within it.
        parameters: of the tracker.
    """

    half: str
    nearest: float
    farthest: float
    parameters: TrackerParameters


@dataclass(frozen=True, slots=True)
class Recording:
    """Part of a recording that trials are made on.

    Attributes:
        tables: the whole recording's.
        rotation: of its antenna, in seconds after the recording's origin.
        start: seconds at which the part begins.
        stop: seconds at which it ends.
    """

    tables: BagTables
    rotation: Rotation
    start: float
    stop: float

    @classmethod
    def part(cls, tables: BagTables, half: str) -> Recording:
        """Take a part of a recording.

        Args:
            tables: plots and truth.
            half: key of HALVES.

        Returns:
            The part.

        Raises:
            ScoreError: there is no truth.
            RotationError: the plots do not tell how the antenna turned.
        """
        if not len(tables.truth):
            raise ScoreError("a trial needs truth to score by, and this bag has none")
        rotation = estimate_rotation(tables.plots.time, tables.plots.rows["azimuth"])
        begin, end = HALVES[half]
        span = tables.stop - tables.start
        return cls(tables, rotation, tables.start + begin * span, tables.start + end * span)

    def inside(self, timed: TimedRows) -> tuple[npt.NDArray[np.void], npt.NDArray[np.float64]]:
        """Select rows by time.

        Args:
            timed: rows of the recording.

        Returns:
            (rows, time): those of the part.
        """
        chosen = (timed.time >= self.start) & (timed.time <= self.stop)
        return timed.rows[chosen], timed.time[chosen]


def try_levels(
    recording: Recording, options: TrialOptions, levels: Iterable[float], runs: int
) -> Iterator[dict[str, Any]]:
    """Try a recording with several numbers of false plots.

    Args:
        recording: part of it.
        options: what to try it with.
        levels: mean numbers of false plots to add to a scan.
        runs: at each level, with seeds from 1 on; without false plots all runs are alike, and one is made.

    Yields:
        Scores of each run, with the level as `false_plots_added` and the `seed`.
    """
    cases = [(level, seed) for level in levels for seed in range(1, (runs if level else 1) + 1)]
    with ProcessPoolExecutor() as pool:
        yield from pool.map(partial(_scores, recording, options), *zip(*cases, strict=True))


def run_once(
    recording: Recording, options: TrialOptions, level: float, seed: int
) -> tuple[Evaluation, float]:
    """Track a recording with false plots added.

    Args:
        recording: part of it.
        options: what to try it with.
        level: mean number of false plots to add to a scan.
        seed: of the false plots.

    Returns:
        (evaluation, seconds): what came of it, and the time that the tracker took.
    """
    plots = list(_plots(recording, options, level, seed))
    seconds, tracks = run_tracker(plots, options.parameters)
    rows, time = recording.inside(recording.tables.truth)
    truth = _table(rows, time, recording)
    tables = lay_out({PLOTS_TOPIC: plots, TRACKS_TOPIC: tracks, TRUTH_TOPIC: [truth]})
    return evaluate(tables, ScoreOptions(scan_period=recording.rotation.period)), seconds


def run_tracker(plots: Iterable[Table], parameters: TrackerParameters) -> tuple[float, list[Table]]:
    """Feed a tracker with messages, on the clock.

    Args:
        plots: messages in order of time.
        parameters: of the tracker.

    Returns:
        (seconds, tracks): time spent in the tracker, and its messages.
    """
    tracker = Tracker(parameters)
    begin = time.perf_counter()
    tracks = [tracker.process(message) for message in plots]
    tracks.append(tracker.flush())
    return time.perf_counter() - begin, tracks


def summarise(scores: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Put the runs of each level together.

    Args:
        scores: of all runs.

    Returns:
        One object a level: means over its runs; of the false tracks their number, their rate and the rate that the
        true one is below with 95 % certainty (Poisson; Garwood 1936).
    """
    levels = dict.fromkeys(run["false_plots_added"] for run in scores)
    return [
        _level([run for run in scores if run["false_plots_added"] == level]) for level in levels
    ]


def _level(runs: list[dict[str, Any]]) -> dict[str, Any]:
    summary: dict[str, Any] = {
        name: float(np.mean([run[name] for run in runs])) for name in runs[0] if name != "seed"
    }
    false = sum(run["false_tracks"] for run in runs)
    hours = sum(run["duration_s"] for run in runs) / _SECONDS_PER_HOUR
    summary |= {
        "runs": len(runs),
        "hours": hours,
        "false_tracks": false,
        "false_tracks_per_hour": false / hours,
        "false_tracks_per_hour_below": float(stats.chi2.ppf(_SURE, 2 * false + 2) / 2.0 / hours),
    }
    return summary


def _scores(recording: Recording, options: TrialOptions, level: float, seed: int) -> dict[str, Any]:
    evaluation, seconds = run_once(recording, options, level, seed)
    record = RunRecord(len(evaluation.tables.plots) / seconds)
    targets = score_targets(evaluation)
    return {
        "false_plots_added": level,
        "seed": seed,
        "switches": int(targets.switches.sum()),
        **compute_scores(evaluation, record),
    }


def _plots(recording: Recording, options: TrialOptions, level: float, seed: int) -> Iterator[Table]:
    rows, time = recording.inside(recording.tables.plots)
    generator = np.random.default_rng(seed)
    false_time, distance, azimuth = draw_false_plots(
        recording.rotation,
        recording.start,
        recording.stop,
        per_scan=level,
        nearest=options.nearest,
        farthest=options.farthest,
        generator=generator,
    )
    # Errors, amplitude and the like are those of real plots, so that nothing but the place tells them apart.
    false = rows[generator.integers(len(rows), size=len(false_time))]
    false["range"], false["azimuth"] = distance, azimuth
    false["x"], false["y"] = enu_from_polar(distance, azimuth)
    return cut_into_sectors(
        np.concatenate([rows, false]),
        _nanoseconds(recording, np.concatenate([time, false_time])),
        start=int(_nanoseconds(recording, recording.start)),
        stop=int(_nanoseconds(recording, recording.stop)),
        period=recording.rotation.period,
        frame_id=RADAR_FRAME,
    )


def _table(
    rows: npt.NDArray[np.void], time: npt.NDArray[np.float64], recording: Recording
) -> Table:
    rows = rows.copy()
    rows["time_offset"] = time - recording.start
    return Table(int(_nanoseconds(recording, recording.start)), rows, SITE_FRAME)


def _nanoseconds(recording: Recording, time: npt.ArrayLike) -> npt.NDArray[np.int64]:
    after = np.round(np.asarray(time, dtype=float) * NANOSECONDS).astype(np.int64)
    return recording.tables.origin + after
