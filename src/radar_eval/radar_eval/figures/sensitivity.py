# SPDX-License-Identifier: Apache-2.0
"""What the detectors lose against the ideal integrator, side by side."""

from __future__ import annotations

import matplotlib.pyplot as plt
from matplotlib.figure import Figure

from radar_common.figure_style import FAINT, LINES, style
from radar_eval.studies.detector_loss import Loss


def draw_sensitivity(losses: list[Loss]) -> Figure:
    """Draw the losses side by side.

    Args:
        losses: of any detectors.

    Returns:
        The figure.
    """
    targets = list(dict.fromkeys(loss.target for loss in losses))
    names = list(dict.fromkeys(loss.detector for loss in losses))
    place = {name: -row for row, name in enumerate(names)}
    with style():
        figure, panels = plt.subplots(
            1,
            len(targets),
            figsize=(9.0, 0.8 + 0.27 * len(names)),
            layout="constrained",
            sharey=True,
            squeeze=False,
        )
        for axes, target in zip(panels[0], targets, strict=True):
            shown = [loss for loss in losses if loss.target == target]
            rows = [place[loss.detector] for loss in shown]
            axes.barh(rows, [loss.loss_db for loss in shown], 0.62, color=FAINT, label="predicted")
            axes.plot(
                [loss.measured_loss_db for loss in shown],
                rows,
                "o",
                color=LINES[0],
                ms=4,
                label="measured",
            )
            axes.set_yticks(list(place.values()), names)
            axes.set(title=f"{target} target", xlabel="loss at 90 % detection, dB")
            axes.grid(visible=False, axis="y")
        panels[0, -1].legend(loc="lower right")
        plt.close(figure)
    return figure
