# SPDX-License-Identifier: Apache-2.0
"""One target's story: its path with plots and tracks, how far off they were, and how fast it flew."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from radar_common.figure_style import LINES
from radar_common.frames import enu_from_polar
from radar_common.tables import TrackStatus
from radar_eval.evaluation import Evaluation
from radar_eval.figures import style
from radar_eval.labelling import FALSE
from radar_eval.metrics.per_target import FAR_OFF, TargetScores

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]

_MARGIN = 0.06
_LEAST_SPAN = 2e3
_TRUTH_COLOUR = style.INK
_FALSE_COLOUR = style.FAINT


def draw_case(evaluation: Evaluation, scores: TargetScores, case: int, title: str) -> Figure:
    """Draw a target.

    Args:
        evaluation: of a bag.
        scores: of its targets.
        case: position of the target in the scores.
        title: begins the line above the picture.

    Returns:
        The figure: a map, and over time errors, speed and course.
    """
    target = int(scores.target[case])
    tracks = _tracks_of(evaluation, target)
    with style.style():
        figure = Figure(figsize=(12.0, 6.4), layout="constrained")
        grid = figure.add_gridspec(3, 2, width_ratios=(1.15, 1.0), height_ratios=(1.5, 1.0, 1.0))
        place = figure.add_subplot(grid[:, 0])
        error = figure.add_subplot(grid[0, 1])
        speed = figure.add_subplot(grid[1, 1], sharex=error)
        course = figure.add_subplot(grid[2, 1], sharex=error)
        _draw_map(place, evaluation, target, tracks)
        _draw_errors(error, evaluation, target, tracks)
        _draw_motion(speed, course, evaluation, target, tracks)
        for axes in (error, speed):
            axes.tick_params(labelbottom=False)
        course.set_xlabel("time, s")
        figure.suptitle(f"{title}: {_summary(scores, case)}", x=0.01, ha="left", fontsize=11)
    return figure


def _summary(scores: TargetScores, case: int) -> str:
    tracks = int(scores.tracks[case])
    rms = scores.rms[case]
    error = "no settled track" if np.isnan(rms) else f"{rms:.0f} m RMS"
    return (
        f"{tracks} track{'s' * (tracks != 1)}, {scores.lost[case]} of {scores.plots[case]} plots lost, "
        f"{error}, {scores.far_off[case]} of {scores.rows[case]} rows over {FAR_OFF:.0f} m off"
    )


def _tracks_of(evaluation: Evaluation, target: int) -> IntArray:
    """Confirmed tracks that hold a plot of the target, those of the target itself or of another one."""
    history = evaluation.history
    own = evaluation.labels.target[history.of_plots[:, 1]] == target
    found = np.unique(history.of_plots[own, 0])
    found = found[history.confirmed[found]]
    return found[np.argsort(history.first_at[found], kind="stable")]


def _rows_of(evaluation: Evaluation, track: int) -> IntArray:
    history, tracks = evaluation.history, evaluation.tables.tracks
    alive = tracks.rows["status"] != TrackStatus.ENDED
    return np.flatnonzero((history.track_of_row == track) & alive)


def _draw_map(axes: Axes, evaluation: Evaluation, target: int, tracks: IntArray) -> None:
    paths, plots = evaluation.paths, evaluation.tables.plots
    own_truth = paths.target == target
    x, y = enu_from_polar(paths.rows["range"][own_truth], paths.rows["azimuth"][own_truth])
    _set_window(axes, x, y)
    axes.plot(x / 1e3, y / 1e3, color=_TRUTH_COLOUR, linewidth=1.0, label="truth", zorder=3)
    axes.plot(x[:1] / 1e3, y[:1] / 1e3, "o", color=_TRUTH_COLOUR, markersize=5, zorder=3)
    label = evaluation.labels.target
    px, py = enu_from_polar(plots.rows["range"], plots.rows["azimuth"])
    during = (plots.time >= paths.begin[target]) & (plots.time <= paths.end[target])
    false = during & (label == FALSE) & _within(axes, px, py)
    # Many false plots must make a haze behind the case, not hide it.
    haze = float(np.clip(500.0 / max(int(np.sum(false)), 1), 0.15, 1.0))
    for chosen, colour, size, alpha, name in (
        (false, _FALSE_COLOUR, 3.0, haze, "false plots of this time"),
        (during & (label != FALSE) & (label != target), LINES[4], 3.0, 0.6, "other targets' plots"),
        (label == target, LINES[2], 5.0, 1.0, "its plots"),
    ):
        axes.plot(
            px[chosen] / 1e3, py[chosen] / 1e3, ".", color=colour, markersize=size,
            markeredgewidth=0.0, label=name, zorder=2, alpha=alpha,
        )  # fmt: skip
    for number, track in enumerate(tracks):
        rows = evaluation.tables.tracks.rows[_rows_of(evaluation, int(track))]
        colour = _track_colour(number)
        axes.plot(
            rows["x"] / 1e3, rows["y"] / 1e3, color=colour, linewidth=1.5, zorder=4,
            label=f"track {evaluation.history.ids[track]}",
        )  # fmt: skip
        coasting = rows["status"] == TrackStatus.COASTING
        axes.plot(
            rows["x"][coasting] / 1e3, rows["y"][coasting] / 1e3, "x", color=colour,
            markersize=3.5, markeredgewidth=0.8, zorder=4,
        )  # fmt: skip
    axes.set_xlabel("km east of the radar; the dot is the beginning, crosses are predictions")
    axes.set_ylabel("km north")
    axes.legend(loc="best", fontsize=7.5, framealpha=0.85, frameon=True, edgecolor="none")


def _within(axes: Axes, x: FloatArray, y: FloatArray) -> npt.NDArray[np.bool_]:
    (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
    inside = (x / 1e3 > left) & (x / 1e3 < right) & (y / 1e3 > low) & (y / 1e3 < high)
    return np.asarray(inside)


def _set_window(axes: Axes, x: FloatArray, y: FloatArray) -> None:
    span = max(float(np.ptp(x)), float(np.ptp(y)), _LEAST_SPAN)
    half = (0.5 + _MARGIN) * span / 1e3
    for middle, limit in (
        (0.5 * (x.min() + x.max()) / 1e3, axes.set_xlim),
        (0.5 * (y.min() + y.max()) / 1e3, axes.set_ylim),
    ):
        limit(middle - half, middle + half)
    axes.set_aspect("equal")


def _draw_errors(axes: Axes, evaluation: Evaluation, target: int, tracks: IntArray) -> None:
    plots = evaluation.tables.plots
    own = np.flatnonzero(evaluation.labels.target == target)
    _, distance, azimuth = evaluation.paths.polar_at(np.full(len(own), target), plots.time[own])
    true_x, true_y = enu_from_polar(distance, azimuth)
    x, y = enu_from_polar(plots.rows["range"][own], plots.rows["azimuth"][own])
    axes.plot(
        plots.time[own], np.hypot(x - true_x, y - true_y), ".", color=LINES[2], markersize=3.5,
        alpha=0.6, label="plots",
    )  # fmt: skip
    for number, track in enumerate(tracks):
        index = _rows_of(evaluation, int(track))
        rows, time = evaluation.tables.tracks.rows[index], evaluation.tables.tracks.time[index]
        present, truth = evaluation.paths.columns_at(np.full(len(index), target), time, "x", "y")
        off = np.hypot(rows["x"] - truth["x"], rows["y"] - truth["y"])
        axes.plot(
            time[present], off[present], color=_track_colour(number),
            label=f"track {evaluation.history.ids[track]}",
        )  # fmt: skip
    axes.axhline(FAR_OFF, color=style.MUTED, linewidth=0.7, linestyle=":")
    axes.set_yscale("symlog", linthresh=FAR_OFF)
    axes.set_yticks([0, 100, 200, 300, 1000, 3000], ["0", "100", "200", "300", "1000", "3000"])
    axes.set_ylim(0.0, 5e3)
    axes.set_title("Position error, m (linear up to 300, then logarithmic)")


def _draw_motion(
    speed: Axes, course: Axes, evaluation: Evaluation, target: int, tracks: IntArray
) -> None:
    paths = evaluation.paths
    own = paths.target == target
    vx, vy = paths.rows["vx"][own].astype(float), paths.rows["vy"][own].astype(float)
    speed.plot(paths.time[own], np.hypot(vx, vy), color=_TRUTH_COLOUR, linewidth=1.0)
    _plot_course(course, paths.time[own], vx, vy, _TRUTH_COLOUR, 1.0)
    highest = 1.4 * float(np.nanmax(np.hypot(vx, vy), initial=10.0))
    for number, track in enumerate(tracks):
        index = _rows_of(evaluation, int(track))
        index = index[evaluation.tables.tracks.rows["hits"][index] > 1]
        rows, time = evaluation.tables.tracks.rows[index], evaluation.tables.tracks.time[index]
        colour = _track_colour(number)
        speed.plot(time, rows["speed"], color=colour, linewidth=1.0)
        _plot_course(course, time, rows["vx"], rows["vy"], colour, 1.0)
    speed.set_ylim(0.0, highest)
    speed.set_title("Speed, m/s (black: as the aircraft reports it)")
    course.set_ylim(0, 360)
    course.set_yticks([0, 90, 180, 270, 360])
    course.set_title("Course, degrees")


def _plot_course(
    axes: Axes, time: FloatArray, vx: FloatArray, vy: FloatArray, colour: str, width: float
) -> None:
    degrees = np.degrees(np.arctan2(vx, vy)) % 360.0
    # A line through the whole chart at each pass over north would say nothing.
    across = np.flatnonzero(np.abs(np.diff(degrees)) > 180.0) + 1
    axes.plot(
        np.insert(time, across, np.nan), np.insert(degrees, across, np.nan), color=colour,
        linewidth=width,
    )  # fmt: skip


def _track_colour(number: int) -> str:
    colours = [LINES[0], LINES[1], LINES[3], LINES[6], LINES[5]]
    return colours[number % len(colours)]
