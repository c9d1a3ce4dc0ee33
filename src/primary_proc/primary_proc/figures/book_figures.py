# SPDX-License-Identifier: Apache-2.0
"""The curves of Kuzmin 1967, chapter 3, that a design rests on, recomputed for the book's values."""

from __future__ import annotations

from pathlib import Path

import matplotlib.pyplot as plt
from matplotlib.figure import Figure

from primary_proc.figures import book_azimuth, book_detection
from radar_common.figure_style import style


def draw_book_figures(folder: Path) -> list[Path]:
    """Draw figures 3.3, 3.7 and 3.19-3.30, four sheets.

    Args:
        folder: where the pictures go; made if it is not there.

    Returns:
        The pictures.

    Raises:
        OSError: the folder cannot be written.
    """
    folder.mkdir(parents=True, exist_ok=True)
    with style():
        return [
            _thresholds(folder / "kuzmin_thresholds.png"),
            _false_alarms(folder / "kuzmin_false_alarms.png"),
            _detection(folder / "kuzmin_detection.png"),
            _azimuth(folder / "kuzmin_azimuth.png"),
        ]


def _thresholds(path: Path) -> Path:
    figure, axes = plt.subplots(1, 2, figsize=(9.0, 3.6), layout="constrained", sharey=True)
    for part, target in zip(axes, ("steady", "fast"), strict=True):
        book_detection.required_amplitude(part, target)
    return _saved(figure, path)


def _false_alarms(path: Path) -> Path:
    figure, axes = plt.subplots(2, 3, figsize=(12.0, 7.0), layout="constrained")
    parts = iter(axes.flat)
    for from_first_one in (False, True):
        for zeros in (2, 3):
            book_detection.accumulator_false_alarms(
                next(parts), zeros, from_first_one=from_first_one
            )
    book_detection.program_false_alarms(next(parts))
    next(parts).remove()
    return _saved(figure, path)


def _detection(path: Path) -> Path:
    figure, axes = plt.subplots(1, 3, figsize=(12.0, 3.8), layout="constrained")
    of_accumulators = "3.25: accumulators, threshold 5, $N_0$ = 11"
    book_detection.detection(axes[0], book_detection.accumulators(), of_accumulators)
    book_detection.detection(
        axes[1], book_detection.programs(), "3.26: program detectors, $N_0$ = 11"
    )
    book_detection.detection_over_length(axes[2])
    return _saved(figure, path)


def _azimuth(path: Path) -> Path:
    figure, axes = plt.subplots(2, 2, figsize=(9.0, 7.0), layout="constrained")
    book_azimuth.potential_accuracy(axes[0, 0])
    book_azimuth.example(axes[0, 1])
    book_azimuth.random_errors(axes[1, 0])
    book_azimuth.random_errors_over_length(axes[1, 1])
    return _saved(figure, path)


def _saved(figure: Figure, path: Path) -> Path:
    figure.savefig(path, dpi=150, metadata={"Software": None})
    plt.close(figure)
    return path
