# SPDX-License-Identifier: Apache-2.0
"""How many of the antenna's passes over targets gave a plot, and how many plots came from no target."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from radar_eval.evaluation import Evaluation
from radar_eval.labelling import FALSE

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class DetectionOverRange:
    """Detection in rings of range; one entry a ring.

    Attributes:
        edges: m, limits of the rings, shape (rings + 1,).
        looks: passes over targets.
        detected: passes with a plot.
        false_plots: plots of no target, a scan.
    """

    edges: FloatArray
    looks: npt.NDArray[np.int64]
    detected: npt.NDArray[np.int64]
    false_plots: FloatArray


def detection_scores(evaluation: Evaluation) -> dict[str, float]:
    """Score detection.

    Args:
        evaluation: of a bag.

    Returns:
        Number of plots, probability of detection, plots and false plots a scan.
    """
    labels, plots = evaluation.labels, len(evaluation.tables.plots)
    false = int(np.sum(labels.target == FALSE))
    looks = len(evaluation.looks)
    detected = int(np.sum(labels.plot_of_look != FALSE))
    return {
        "plots": plots,
        "plots_per_scan": plots / evaluation.scans,
        "false_plots_per_scan": false / evaluation.scans,
        "looks": looks,
        "probability_of_detection": detected / looks if looks else float("nan"),
    }


def detection_over_range(evaluation: Evaluation, *, rings: int = 24) -> DetectionOverRange:
    """Count detections and false plots in rings of equal width.

    Args:
        evaluation: of a bag.
        rings: number of rings.

    Returns:
        The counts.
    """
    plots = evaluation.tables.plots.rows["range"]
    looks = evaluation.looks.range
    farthest = max([1.0, *(float(r.max()) for r in (plots, looks) if len(r))])
    edges = np.linspace(0.0, farthest * (1.0 + 1e-9), rings + 1)
    detected = evaluation.labels.plot_of_look != FALSE
    false = evaluation.labels.target == FALSE
    return DetectionOverRange(
        edges,
        np.histogram(looks, edges)[0],
        np.histogram(looks[detected], edges)[0],
        np.histogram(plots[false], edges)[0] / evaluation.scans,
    )
