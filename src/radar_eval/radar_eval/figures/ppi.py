# SPDX-License-Identifier: Apache-2.0
"""The plan position indicator: all plots and tracks of a bag over the truth, as a radar screen would show them."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from matplotlib import patheffects
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from radar_common.frames import enu_from_polar
from radar_common.tables import TrackStatus
from radar_eval.asterix_records import NAUTICAL_MILE
from radar_eval.evaluation import Evaluation
from radar_eval.figures import style
from radar_eval.labelling import FALSE

FloatArray = npt.NDArray[np.float64]

_RING_STEPS = (0.25, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0)
_MOST_RINGS = 6
_VECTOR_SCANS = 8.0
_LABEL_SPACING = 0.028


def draw_ppi(evaluation: Evaluation) -> Figure:
    """Draw the picture.

    Args:
        evaluation: of a bag.

    Returns:
        The figure, 10 by 10 inches.
    """
    with style.style():
        figure = Figure(figsize=(10.0, 10.0), facecolor=style.NIGHT)
        axes = figure.add_axes((0.0, 0.0, 1.0, 1.0), facecolor=style.NIGHT)
        reach = _reach(evaluation)
        _draw_screen(axes, reach)
        _draw_plots(axes, evaluation)
        _draw_truth(axes, evaluation)
        _draw_tracks(axes, evaluation, reach)
        _draw_caption(axes, evaluation)
        _draw_legend(axes)
        axes.set_xlim(-1.09 * reach, 1.09 * reach)
        axes.set_ylim(-1.09 * reach, 1.09 * reach)
        axes.set_aspect("equal")
        axes.axis("off")
    return figure


def _reach(evaluation: Evaluation) -> float:
    farthest = [
        float(ranges.max())
        for ranges in (evaluation.tables.plots.rows["range"], evaluation.paths.rows["range"])
        if len(ranges)
    ]
    step = _ring_step(max(farthest))
    return float(np.ceil(max(farthest) / step - 1e-6)) * step


def _ring_step(reach: float) -> float:
    miles = reach / NAUTICAL_MILE
    fitting = [step for step in _RING_STEPS if miles / step <= _MOST_RINGS]
    return (fitting[0] if fitting else _RING_STEPS[-1]) * NAUTICAL_MILE


def _draw_screen(axes: Axes, reach: float) -> None:
    circle = np.linspace(0.0, 2.0 * np.pi, 361)
    step = _ring_step(reach)
    for ring in np.arange(step, reach + 0.5 * step, step):
        outer = ring > reach - 0.5 * step
        axes.plot(
            *enu_from_polar(np.full_like(circle, ring), circle),
            color=style.NIGHT_LINE,
            linewidth=1.4 if outer else 0.7,
            zorder=1,
        )
        label = f"{ring / NAUTICAL_MILE:g}" + (" NM" if outer else "")
        x, y = enu_from_polar(ring, np.radians(45.0))
        axes.text(
            float(x), float(y), label, color=style.NIGHT_TEXT, fontsize=7.5, ha="center",
            va="center", zorder=2, alpha=0.9,
            bbox={"facecolor": style.NIGHT, "edgecolor": "none", "pad": 1.5},
        )  # fmt: skip
    for degrees in range(0, 360, 30):
        inner, rim, outside = (
            enu_from_polar(reach * share, np.radians(degrees)) for share in (0.0, 1.0, 1.035)
        )
        axes.plot(
            [inner[0], rim[0]], [inner[1], rim[1]],
            color=style.NIGHT_LINE, linewidth=0.5, zorder=1, alpha=0.7,
        )  # fmt: skip
        axes.text(
            float(outside[0]), float(outside[1]), f"{degrees:03d}", color=style.NIGHT_TEXT,
            fontsize=9, ha="center", va="center",
        )  # fmt: skip
    for degrees in range(0, 360, 5):
        ends = [
            enu_from_polar(reach * share, np.radians(degrees))
            for share in (1.0, 1.012 if degrees % 10 == 0 else 1.007)
        ]
        axes.plot([e[0] for e in ends], [e[1] for e in ends], color=style.NIGHT_LINE, linewidth=0.8)


def _draw_plots(axes: Axes, evaluation: Evaluation) -> None:
    rows, label = evaluation.tables.plots.rows, evaluation.labels.target
    x, y = enu_from_polar(rows["range"], rows["azimuth"])
    false = label == FALSE
    # Many plots must make a haze, not a wall: the more there are, the smaller and fainter is each.
    haze = float(np.clip(16_000 / max(int(np.sum(false)), 1), 0.22, 0.85))
    size = float(np.clip(2.0 * (20_000 / max(len(rows), 1)) ** 0.25, 1.6, 3.8))
    for chosen, colour, alpha, scale, layer in (
        (false, style.NIGHT_FALSE, haze, 1.0, 3.0),
        (~false, style.NIGHT_PLOT, 0.6, 1.5, 4.0),
    ):
        axes.plot(
            x[chosen], y[chosen], linestyle="none", marker=".", markersize=scale * size,
            markeredgewidth=0.0, color=colour, alpha=alpha, zorder=layer,
        )  # fmt: skip


def _draw_truth(axes: Axes, evaluation: Evaluation) -> None:
    paths = evaluation.paths
    x, y = enu_from_polar(paths.rows["range"], paths.rows["azimuth"])
    longest = evaluation.options.longest_gap * evaluation.rotation.period
    segments = _segments(x, y, paths.target, paths.time, longest)
    axes.add_collection(
        LineCollection(segments, colors=style.NIGHT_TRUTH, linewidths=0.45, alpha=0.45, zorder=3.5)
    )


def _draw_tracks(axes: Axes, evaluation: Evaluation, reach: float) -> None:
    tracks, history = evaluation.tables.tracks, evaluation.history
    if not len(tracks):
        return
    track = history.track_of_row
    shown = history.confirmed[track] & (tracks.rows["status"] != TrackStatus.ENDED)
    order = np.flatnonzero(shown)[np.argsort(track[shown], kind="stable")]
    rows, time, track = tracks.rows[order], tracks.time[order], track[order]
    if not len(order):
        return
    x, y = rows["x"].astype(float), rows["y"].astype(float)
    colours = np.array(style.track_colours(history.ids), dtype=object)
    colours[history.false] = "#ff5252"
    axes.add_collection(
        LineCollection(
            _segments(x, y, track, time, np.inf),
            colors=colours[np.unique(track)].tolist(),
            linewidths=1.25,
            alpha=0.95,
            zorder=5,
        )
    )
    last = np.append(np.flatnonzero(np.diff(track)), len(track) - 1)
    alive = ~np.isin(history.ids[track[last]], tracks.rows["id"][_ended(tracks.rows)])
    alive &= time[last] > evaluation.tables.stop - 2.0 * evaluation.rotation.period
    ahead = _VECTOR_SCANS * evaluation.rotation.period
    tips = np.stack(
        [
            np.stack([x[last], y[last]], axis=1),
            np.stack([x + ahead * rows["vx"], y + ahead * rows["vy"]], axis=1)[last],
        ],
        axis=1,
    )
    own = colours[track[last]].tolist()
    lively = [colour for colour, lives in zip(own, alive, strict=True) if lives]
    axes.add_collection(LineCollection(list(tips[alive]), colors=lively, linewidths=1.0, zorder=6))
    heads = tips[alive, 0]
    axes.scatter(heads[:, 0], heads[:, 1], s=15, c=lively, marker="s", linewidths=0.0, zorder=6)
    # Those alive come first, as labels that would overlap earlier ones are left out.
    order = np.argsort(~alive, kind="stable")
    numbers = history.ids[track[last]]
    _draw_labels(axes, tips[order], numbers[order], [own[i] for i in order], alive[order], reach)


def _draw_labels(
    axes: Axes,
    tips: FloatArray,
    ids: npt.NDArray[np.uint32],
    colours: list[str],
    alive: npt.NDArray[np.bool_],
    reach: float,
) -> None:
    outline = [patheffects.withStroke(linewidth=2.2, foreground=style.NIGHT)]
    taken: list[FloatArray] = []
    for position, number, colour, lives in zip(tips[:, 0], ids, colours, alive, strict=True):
        place = position + reach * np.array([0.011, 0.011])
        near = [np.abs(place - other) / reach for other in taken]
        if any(d[0] < _LABEL_SPACING and d[1] < 0.6 * _LABEL_SPACING for d in near):
            continue
        taken.append(place)
        axes.text(
            place[0], place[1], str(number), color=colour, va="bottom",
            fontsize=7.5 if lives else 6.0, alpha=1.0 if lives else 0.7,
            path_effects=outline, zorder=7, clip_on=True,
        )  # fmt: skip


def _ended(rows: npt.NDArray[np.void]) -> npt.NDArray[np.bool_]:
    return np.asarray(rows["status"] == TrackStatus.ENDED)


def _draw_caption(axes: Axes, evaluation: Evaluation) -> None:
    minutes = (evaluation.tables.stop - evaluation.tables.start) / 60.0
    lines = [
        f"{minutes:.1f} min, {evaluation.scans:.0f} scans of {evaluation.rotation.period:.2f} s",
        f"{len(evaluation.tables.plots)} plots, {int(evaluation.is_target.sum())} targets, "
        f"{int(evaluation.history.confirmed.sum())} confirmed tracks",
    ]
    axes.text(
        0.015, 0.985, "\n".join(lines), transform=axes.transAxes, va="top",
        color=style.NIGHT_TEXT, fontsize=9, linespacing=1.5,
    )  # fmt: skip


def _draw_legend(axes: Axes) -> None:
    entries = [
        Line2D([], [], color=style.TRACK_COLOURS[0], linewidth=1.4, label="confirmed track, id"),
        Line2D([], [], color=style.NIGHT_TRUTH, linewidth=0.6, alpha=0.7, label="truth"),
        Line2D(
            [], [], linestyle="none", marker=".", markersize=5, color=style.NIGHT_PLOT,
            label="plot of a target",
        ),
        Line2D(
            [], [], linestyle="none", marker=".", markersize=4, color=style.NIGHT_FALSE,
            label="false plot",
        ),
    ]  # fmt: skip
    legend = axes.legend(handles=entries, loc="lower left", labelcolor=style.NIGHT_TEXT)
    legend.set_zorder(8)


def _segments(
    x: FloatArray, y: FloatArray, group: npt.NDArray[np.int64], time: FloatArray, longest: float
) -> list[FloatArray]:
    points = np.stack([x, y], axis=1)
    breaks = (np.diff(group) != 0) | (np.diff(time) > longest)
    return np.split(points, np.flatnonzero(breaks) + 1)
