# SPDX-License-Identifier: Apache-2.0
"""Speed or course as the weighted mean of its values from successive pairs of plots.

Source: Kuzmin 1967, § 4.6.3-4.6.4, (4.113)-(4.117). Velocity is per scan; variances are over that of a plot.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from secondary_proc.calculators.rule_chain import FloatArray


def combine(
    mean: npt.ArrayLike, mean_variance: npt.ArrayLike, value: npt.ArrayLike, variance: npt.ArrayLike
) -> tuple[FloatArray, FloatArray]:
    """Take one more value into the mean.

    Source: (4.113), (4.114).

    Args:
        mean: of the values so far, any shape; a course must be unwrapped.
        mean_variance: its variance, same shape.
        value: new value, same shape.
        variance: its variance, same shape.

    Returns:
        (mean, variance as if the errors of the values were independent), same shape.
    """
    old, new = np.asarray(mean_variance, dtype=float), np.asarray(variance, dtype=float)
    total = old + new
    return (
        np.asarray((np.asarray(mean) * new + np.asarray(value) * old) / total),
        np.asarray(old * new / total),
    )


def mean_velocity_variance(plots: npt.ArrayLike) -> FloatArray:
    """True variance of the mean of n - 1 equally accurate velocities.

    Source: (4.115), squared. Only the first and the last plot are left in the mean, as the others cancel; (4.114) says
    2 / (n - 1), which is n - 1 times too much.

    Args:
        plots: n, at least 2, any shape.

    Returns:
        2 / (n - 1)^2, same shape.
    """
    n = np.asarray(plots, dtype=float)
    return np.asarray(2.0 / (n - 1.0) ** 2)


def least_squares_ratio(plots: npt.ArrayLike) -> FloatArray:
    """Error of the least-squares velocity over that of the mean.

    Source: (4.116).

    Args:
        plots: n, at least 2, any shape.

    Returns:
        Ratio of standard deviations, same shape.
    """
    n = np.asarray(plots, dtype=float)
    return np.asarray(np.sqrt(6.0 * (n - 1.0) / (n * (n + 1.0))))


def mean_prediction_variance(plots: npt.ArrayLike) -> FloatArray:
    """Variance of the next coordinate, predicted from the last plot with the mean velocity.

    Source: (4.117), squared.

    Args:
        plots: n, at least 2, any shape.

    Returns:
        1 + 2 n / (n - 1)^2, same shape.
    """
    n = np.asarray(plots, dtype=float)
    return np.asarray(1.0 + 2.0 * n / (n - 1.0) ** 2)
