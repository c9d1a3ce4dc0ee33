# SPDX-License-Identifier: Apache-2.0
"""The error of fused bearings beside those of both channels, moment by moment, and what was thought of the channels."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullLocator

from radar_common.figure_style import INK, LINES, style

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]

_ACTIVE, _PASSIVE, _FUSED = LINES[1], LINES[3], LINES[0]


@dataclass(frozen=True, slots=True)
class Moments:
    """A run, moment by moment; all arrays have shape (n,).

    Attributes:
        time: seconds.
        fused: rms error of the fused bearings, mrad; NaN where there is none, as in the next two.
        active: the same of the active channel.
        passive: the same of the passive channel.
        jammed: mean probability that the active channel is jammed.
        silent: mean probability that the passive channel is silent.
        truly_jammed: whether it was.
        truly_silent: whether it was.
    """

    time: FloatArray
    fused: FloatArray
    active: FloatArray
    passive: FloatArray
    jammed: FloatArray
    silent: FloatArray
    truly_jammed: BoolArray
    truly_silent: BoolArray

    @property
    def better(self) -> FloatArray:
        """Error of the better channel of the moment; NaN where there is none."""
        return np.fmin(self.active, self.passive)


def draw_channels_over_time(
    moments: Moments, title: str, names: tuple[str, str], *, better: bool
) -> Figure:
    """Draw errors above and probabilities below, with the true disturbances shaded.

    Args:
        moments: of the run.
        title: of the upper panel.
        names: of the active and of the passive channel in the legend.
        better: whether the better of both channels is drawn as a curve of its own.

    Returns:
        The figure.
    """
    time = moments.time
    with style():
        figure = Figure(figsize=(9.0, 5.6), layout="constrained")
        above, below = figure.subplots(2, 1, sharex=True, height_ratios=(2.2, 1.0))
        for axes in (above, below):
            _shade(axes, time, moments.truly_jammed, _ACTIVE)
            _shade(axes, time, moments.truly_silent, _PASSIVE)
        above.plot(time, moments.active, color=_ACTIVE, lw=1.1, label=names[0])
        above.plot(time, moments.passive, color=_PASSIVE, lw=1.1, label=names[1])
        if better:
            above.plot(
                time, moments.better, color=INK, lw=1.1, ls=(0, (4, 2)), label="better of both"
            )
        above.plot(time, moments.fused, color=_FUSED, lw=2.2, label="fused")
        above.set(title=title, yscale="log", xlim=(time[0], time[-1]))
        above.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 3.0, 5.0)))
        above.yaxis.set_major_formatter("{x:g}")
        above.yaxis.set_minor_locator(NullLocator())
        _legend(above)
        for values, truly, colour, name in (
            (moments.jammed, moments.truly_jammed, _ACTIVE, "active channel jammed"),
            (moments.silent, moments.truly_silent, _PASSIVE, "passive channel silent"),
        ):
            below.plot(time, values, color=colour, label=name)
            _name_spans(above, time, truly, colour, name)
        below.set(title="Probability, as told with the fused bearings", ylim=(-0.03, 1.03))
        below.set_xlabel("time, s")
        _legend(below)
    return figure


def _spans(time: FloatArray, disturbed: BoolArray) -> list[tuple[float, float]]:
    edges = np.flatnonzero(np.diff(np.concatenate([[0], disturbed.astype(np.int8), [0]])))
    last = len(time) - 1
    return [
        (float(time[begin]), float(time[min(end, last)]))
        for begin, end in zip(edges[::2], edges[1::2], strict=True)
    ]


def _shade(axes: Axes, time: FloatArray, disturbed: BoolArray, colour: str) -> None:
    for begin, end in _spans(time, disturbed):
        axes.axvspan(begin, end, color=colour, alpha=0.09, lw=0)


def _name_spans(axes: Axes, time: FloatArray, disturbed: BoolArray, colour: str, name: str) -> None:
    for begin, end in _spans(time, disturbed):
        if end - begin >= 0.12 * (time[-1] - time[0]):
            axes.text(
                0.5 * (begin + end),
                0.985,
                name,
                color=colour,
                ha="center",
                va="top",
                fontsize=8.0,
                transform=axes.get_xaxis_transform(),
            )


def _legend(axes: Axes) -> None:
    """Beside the title, where no curve is."""
    axes.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=4, borderpad=0.0)
