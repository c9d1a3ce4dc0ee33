# SPDX-License-Identifier: Apache-2.0
"""Two channels, what a filter makes of them and how sure it is of each: figure 2 of Detkov 2022, and the errors."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullLocator

from radar_common.figure_style import FAINT, INK, LINES, MUTED, style
from radar_eval.published.detkov_trials import Followed, Setup, Trials

FloatArray = npt.NDArray[np.float64]

_ACTIVE, _PASSIVE, _BOTH = range(3)
_ACTIVE_COLOUR, _PASSIVE_COLOUR, _FUSED_COLOUR = LINES[1], LINES[3], LINES[0]
_HEIGHTS = (1.0, 1.0, 1.25, 1.0, 0.7, 1.25)


def draw_channel_fusion(
    setup: Setup, trials: Trials, followed: Mapping[str, Followed], run: int
) -> Figure:
    """Draw one run from the readings to the probabilities, and the errors over all runs.

    Args:
        setup: of the test.
        trials: its runs.
        followed: answers of the filters `dcmp`, `kalman` and `oracle`.
        run: number of the run that is shown.

    Returns:
        The figure.
    """
    step = np.arange(1.0, setup.steps + 1.0)
    truth, best = trials.truth[:, run], followed["dcmp"]
    mean = best.mean["mmse"][:, _BOTH, run]
    deviation = np.sqrt(np.einsum("kii->ki", best.covariance["mmse"][:, _BOTH, run]))
    with style():
        figure = Figure(figsize=(9.0, 10.4), layout="constrained")
        panels = figure.subplots(6, 1, sharex=True, height_ratios=_HEIGHTS)
        for axes in panels:
            _shade(axes, setup)
        _name_spans(panels[0], setup)
        for axes, values, colour in (
            (panels[0], trials.active[:, run], _ACTIVE_COLOUR),
            (panels[1], trials.passive[:, run], _PASSIVE_COLOUR),
        ):
            axes.plot(step, truth[:, 0], color=FAINT, lw=1.2)
            axes.plot(step, values, ".", color=colour, ms=3.2)
        panels[0].margins(y=0.16)
        panels[0].set_title("Readings of the active channel over the true bearing")
        panels[1].set_title("Readings of the passive channel over the true bearing")

        blind = followed["kalman"].mean["mmse"][:, _BOTH, run, 0]
        panels[2].plot(
            step, blind, color=MUTED, lw=0.9, ls=(0, (4, 2)), label="ignoring disturbances"
        )
        _estimate(panels[2], step, truth[:, 0], mean[:, 0], deviation[:, 0])
        panels[2].set_title("Bearing from both channels")
        _estimate(panels[3], step, truth[:, 1], mean[:, 1], deviation[:, 1])
        panels[3].set_title("Its rate, a second")
        _legend(panels[2])

        for channel, colour, name in (
            (_ACTIVE, _ACTIVE_COLOUR, "active"),
            (_PASSIVE, _PASSIVE_COLOUR, "passive"),
        ):
            probability = best.undisturbed[:, _BOTH, run, channel]
            panels[4].plot(step, probability, color=colour, lw=1.1, label=name)
        panels[4].set(title="Probability that the channel is undisturbed", ylim=(-0.04, 1.04))
        _legend(panels[4])

        for name, column, colour, line, label in (
            ("dcmp", _ACTIVE, _ACTIVE_COLOUR, "-", "active alone"),
            ("dcmp", _PASSIVE, _PASSIVE_COLOUR, "-", "passive alone"),
            ("dcmp", _BOTH, _FUSED_COLOUR, "-", "both"),
            ("oracle", _BOTH, INK, ":", "both, told the truth"),
        ):
            error = followed[name].mean["mmse"][:, column, :, 0] - trials.truth[..., 0]
            panels[5].plot(
                step, np.sqrt(np.mean(error**2, axis=1)), color=colour, ls=line, lw=1.3, label=label
            )
        panels[5].set(
            title=f"Error of the bearing, rms of {trials.active.shape[1]} runs",
            xlabel="time, s",
            yscale="log",
            xlim=(1, setup.steps),
        )
        panels[5].yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        panels[5].yaxis.set_major_formatter("{x:g}")
        panels[5].yaxis.set_minor_locator(NullLocator())
        _legend(panels[5])
    return figure


def _estimate(
    axes: Axes, step: FloatArray, truth: FloatArray, mean: FloatArray, deviation: FloatArray
) -> None:
    axes.plot(step, truth, color=INK, lw=1.0, label="truth")
    axes.plot(step, mean, color=_FUSED_COLOUR, lw=1.2, label="estimate")
    low, high = mean - 2.0 * deviation, mean + 2.0 * deviation
    axes.fill_between(step, low, high, color=_FUSED_COLOUR, alpha=0.18, lw=0, label="± 2 std")


def _legend(axes: Axes) -> None:
    """Beside the title, where no curve is."""
    axes.legend(loc="lower right", bbox_to_anchor=(1.0, 0.97), ncols=4, borderpad=0.2)


def _spans(setup: Setup) -> list[tuple[float, float, str, str]]:
    spans = []
    for states, colour, name in zip(
        setup.states,
        (_ACTIVE_COLOUR, _PASSIVE_COLOUR),
        ("active channel jammed", "passive channel silent"),
        strict=True,
    ):
        disturbed = np.flatnonzero(states) + 1
        spans.append((disturbed[0] - 0.5, disturbed[-1] + 0.5, colour, name))
    return spans


def _shade(axes: Axes, setup: Setup) -> None:
    for begin, end, colour, _ in _spans(setup):
        axes.axvspan(begin, end, color=colour, alpha=0.08, lw=0)


def _name_spans(axes: Axes, setup: Setup) -> None:
    for begin, end, colour, name in _spans(setup):
        axes.text(
            0.5 * (begin + end),
            0.98,
            name,
            color=colour,
            ha="center",
            va="top",
            fontsize=8.0,
            transform=axes.get_xaxis_transform(),
        )
