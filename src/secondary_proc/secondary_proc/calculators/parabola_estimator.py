# SPDX-License-Identifier: Apache-2.0
"""The parabola through n plots at equal intervals: hypothesis 2, its weights and errors in closed form.

Source: Kuzmin 1967, § 4.4.3-4.4.4, (4.56)-(4.61), (4.67), (4.68). Velocity and acceleration are per scan and per scan
squared; variances are over that of a plot.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from secondary_proc.calculators.rule_chain import FloatArray


def parabola_first_weights(plots: int) -> FloatArray:
    """Weights of the coordinate at the first plot.

    Source: (4.57a).

    Args:
        plots: n, at least 3.

    Returns:
        Weights of plots 1 to n, shape (n,).
    """
    n, i = plots, np.arange(1, plots + 1)
    numerator = 3 * (3 * (n + 1) * (n + 2) - 2 * i * (6 * n + 7) + 10 * i**2)
    return np.asarray(numerator / (n * (n + 1) * (n + 2)))


def parabola_velocity_weights(plots: int) -> FloatArray:
    """Weights of the velocity at the first plot; that at the last is (n - 1) accelerations more.

    Source: (4.58a).

    Args:
        plots: n, at least 3.

    Returns:
        Weights of plots 1 to n, shape (n,).
    """
    n, i = plots, np.arange(1, plots + 1)
    numerator = (n + 1) * (n + 2) * (6 * n - 7) - 2 * i * (16 * n**2 - 19) + 30 * i**2 * (n - 1)
    return np.asarray(-6 * numerator / (n * (n**2 - 1) * (n**2 - 4)))


def parabola_acceleration_weights(plots: int) -> FloatArray:
    """Weights of the acceleration.

    Source: (4.59a).

    Args:
        plots: n, at least 3.

    Returns:
        Weights of plots 1 to n, shape (n,).
    """
    n, i = plots, np.arange(1, plots + 1)
    numerator = 60 * ((n + 1) * (n + 2) - 6 * i * (n + 1) + 6 * i**2)
    return np.asarray(numerator / (n * (n**2 - 1) * (n**2 - 4)))


def parabola_last_weights(plots: int) -> FloatArray:
    """Weights of the coordinate at the last plot.

    Source: (4.60a).

    Args:
        plots: n, at least 3.

    Returns:
        Weights of plots 1 to n, shape (n,).
    """
    n, i = plots, np.arange(1, plots + 1)
    numerator = 3 * ((n + 1) * (n + 2) - 2 * i * (4 * n + 3) + 10 * i**2)
    return np.asarray(numerator / (n * (n + 1) * (n + 2)))


def parabola_next_weights(plots: int) -> FloatArray:
    """Weights of the coordinate one scan after the last plot.

    Source: (4.61a).

    Args:
        plots: n, at least 3.

    Returns:
        Weights of plots 1 to n, shape (n,).
    """
    n, i = plots, np.arange(1, plots + 1)
    numerator = 3 * ((n + 2) * (n + 3) - 2 * i * (4 * n + 7) + 10 * i**2)
    return np.asarray(numerator / (n * (n - 1) * (n - 2)))


def parabola_velocity_variance(plots: npt.ArrayLike) -> FloatArray:
    """Variance of the velocity at either end.

    Source: (4.67).

    Args:
        plots: n, at least 3, any shape.

    Returns:
        Variance, same shape.
    """
    n = np.asarray(plots, dtype=float)
    return np.asarray(12 * (2 * n - 1) * (8 * n - 11) / (n * (n**2 - 1) * (n**2 - 4)))


def parabola_acceleration_variance(plots: npt.ArrayLike) -> FloatArray:
    """Variance of the acceleration, which is also the factor K of the manoeuvre detector.

    Source: (4.68).

    Args:
        plots: n, at least 3, any shape.

    Returns:
        Variance, same shape.
    """
    n = np.asarray(plots, dtype=float)
    return np.asarray(720 / (n * (n**2 - 1) * (n**2 - 4)))


def parabola_last_variance(plots: npt.ArrayLike) -> FloatArray:
    """Variance of the coordinate at the last plot, which figure 4.8 shows without a formula.

    Args:
        plots: n, at least 3, any shape.

    Returns:
        Variance, same shape.
    """
    n = np.asarray(plots, dtype=float)
    return np.asarray(3 * (3 * n**2 - 3 * n + 2) / (n * (n + 1) * (n + 2)))


def parabola_next_variance(plots: npt.ArrayLike) -> FloatArray:
    """Variance of the coordinate one scan after the last plot, which figure 4.8 shows without a formula.

    Args:
        plots: n, at least 3, any shape.

    Returns:
        Variance, same shape.
    """
    n = np.asarray(plots, dtype=float)
    return np.asarray(3 * (3 * n**2 + 3 * n + 2) / (n * (n - 1) * (n - 2)))
