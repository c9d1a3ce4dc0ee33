# SPDX-License-Identifier: Apache-2.0
"""Curves of one design: detection and azimuth accuracy against the signal-to-noise ratio."""

from __future__ import annotations

from pathlib import Path

import matplotlib.pyplot as plt
from matplotlib.axes import Axes

from primary_proc.prediction import Prediction
from radar_common.figure_style import style


def draw_design(prediction: Prediction, folder: Path) -> Path:
    """Draw a design.

    Args:
        prediction: of its quality.
        folder: where the picture goes; made if it is not there.

    Returns:
        The picture, `design.png`.

    Raises:
        OSError: the folder cannot be written.
    """
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / "design.png"
    with style():
        figure, (detection, azimuth) = plt.subplots(1, 2, figsize=(9.0, 3.6), layout="constrained")
        _draw_detection(detection, prediction)
        _draw_azimuth(azimuth, prediction)
        figure.suptitle(
            f"{prediction.detector}, {prediction.pulses_in_burst:.3g} pulses in a burst, "
            f"{prediction.false_plots:.3g} false plots a turn",
            x=0.01,
            ha="left",
        )
        figure.savefig(path, dpi=150, metadata={"Software": None})
        plt.close(figure)
    return path


def _draw_detection(axes: Axes, prediction: Prediction) -> None:
    snr_db = [quality.snr_db for quality in prediction.quality]
    for target in prediction.quality[0].detection:
        found = [quality.detection[target] for quality in prediction.quality]
        axes.plot(snr_db, found, label=target)
    axes.set(title="probability of detection", xlabel="SNR at the beam's axis, dB", ylim=(0, 1.02))
    axes.legend(loc="lower right")


def _draw_azimuth(axes: Axes, prediction: Prediction) -> None:
    snr_db = [quality.snr_db for quality in prediction.quality]
    axes.plot(snr_db, [quality.azimuth_std_deg for quality in prediction.quality])
    axes.set(
        title="standard deviation of the azimuth, steady target, deg",
        xlabel="SNR at the beam's axis, dB",
    )
    axes.set_ylim(bottom=0.0)
