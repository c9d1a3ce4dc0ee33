# SPDX-License-Identifier: Apache-2.0
"""Logarithmic likelihood ratios of "a target" against "false plots".

Source: Sittler 1964; Blackman and Popoli 1999, § 6.2. By the optional stopping theorem a rule that confirms at a
ratio B confirms at most one in B of the candidates that false plots open (Wald 1945), which sets the threshold.
"""

from __future__ import annotations

from math import log, log1p

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]


def hit(
    detection_probability: FloatArray | float,
    distance_squared: FloatArray,
    determinant: FloatArray,
    density: FloatArray,
) -> FloatArray:
    """Gain of a plot in a track's gate.

    Args:
        detection_probability: of a plot per scan, one for all or shape (n,).
        distance_squared: normalised by the covariance of the predicted difference, shape (n,).
        determinant: of that covariance, m^4, shape (n,).
        density: false plots per square metre, shape (n,).

    Returns:
        Gain of the score, shape (n,).
    """
    expected_false = 2.0 * np.pi * np.sqrt(determinant) * density
    return np.log(detection_probability / expected_false) - distance_squared / 2.0


def false_plots_nearer(
    distance_squared: FloatArray, determinant: FloatArray, density: FloatArray
) -> FloatArray:
    """Number of false plots to expect nearer to the prediction than a plot.

    The ellipse through the plot has the area pi d^2 sqrt(det S) (Kuzmin 1967, (4.146)).

    Args:
        distance_squared: d^2, normalised by the covariance S of the predicted difference, shape (n,).
        determinant: of S, m^4, shape (n,).
        density: false plots per square metre, shape (n,).

    Returns:
        Number, shape (n,).
    """
    return np.pi * distance_squared * np.sqrt(determinant) * density


def second_plot(
    detection_probability: FloatArray | float,
    area: FloatArray,
    density: FloatArray,
    skipped: npt.NDArray[np.integer],
) -> FloatArray:
    """Score of a pair of plots, the second anywhere in the annulus around the first.

    Args:
        detection_probability: of a plot per scan.
        area: of the annulus, m^2, shape (n,).
        density: false plots per square metre, shape (n,).
        skipped: scans without a plot between both, shape (n,).

    Returns:
        Score, shape (n,).
    """
    return np.log(detection_probability / (area * density)) + skipped * miss(detection_probability)


def miss(detection_probability: FloatArray | float) -> FloatArray | float:
    """Change of the score by a scan without a plot.

    Args:
        detection_probability: of a plot per scan, one for all or shape (n,).

    Returns:
        The change, negative.
    """
    if isinstance(detection_probability, np.ndarray):
        return np.log1p(-detection_probability)
    return log1p(-detection_probability)


def is_spent(
    best: FloatArray, score: FloatArray, misses: int, detection_probability: FloatArray | float
) -> npt.NDArray[np.bool_]:
    """Tell which tracks have lost more since their best than a row of misses costs.

    False plots now and then end every row of misses, but do not bring back what the misses cost.

    Args:
        best: highest score so far, shape (n,).
        score: present one, shape (n,).
        misses: in a row that end a track anyhow.
        detection_probability: of a plot per scan.

    Returns:
        Shape (n,).
    """
    return best - score > -(misses + 1) * miss(detection_probability)


def confirmation_threshold(candidates_per_hour: float, false_tracks_per_hour: float) -> float:
    """Score above which tracks count as true.

    Args:
        candidates_per_hour: plots that open candidates.
        false_tracks_per_hour: confirmed false tracks allowed among them.

    Returns:
        Threshold, never below a ratio of ten.
    """
    return log(max(candidates_per_hour / false_tracks_per_hour, 10.0))
