# SPDX-License-Identifier: Apache-2.0
"""The straight line through n plots at equal intervals: hypothesis 1, its weights and errors in closed form.

Source: Kuzmin 1967, § 4.4.3-4.4.4, (4.49)-(4.55), (4.63)-(4.66). Velocity is per scan; variances are over that of a
plot.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from secondary_proc.calculators.rule_chain import FloatArray


def line_velocity_weights(plots: int) -> FloatArray:
    """Weights of the velocity.

    Source: (4.52a).

    Args:
        plots: n, at least 2.

    Returns:
        Weights of plots 1 to n, shape (n,).
    """
    i = np.arange(1, plots + 1)
    return np.asarray((12 * i - 6 - 6 * plots) / (plots * (plots**2 - 1)))


def line_position_weights(plots: int, ahead: int) -> FloatArray:
    """Weights of the coordinate in any scan.

    Source: (4.51a), (4.53); (4.54a) and (4.55a) are ahead = 0 and 1.

    Args:
        plots: n, at least 2.
        ahead: scans after the last plot, p; 1 - n is the first plot.

    Returns:
        Weights of plots 1 to n, shape (n,).
    """
    i = np.arange(1, plots + 1)
    first = -(6 * i - 4 - 4 * plots) / (plots * (plots + 1))
    return np.asarray(first + (plots + ahead - 1) * line_velocity_weights(plots))


def line_velocity_variance(plots: npt.ArrayLike) -> FloatArray:
    """Variance of the velocity.

    Source: (4.63).

    Args:
        plots: n, at least 2, any shape.

    Returns:
        Variance, same shape.
    """
    n = np.asarray(plots, dtype=float)
    return np.asarray(12.0 / (n * (n**2 - 1.0)))


def line_position_variance(plots: npt.ArrayLike, ahead: npt.ArrayLike = 0) -> FloatArray:
    """Variance of the coordinate in any scan.

    Source: (4.66), of which (4.64) and (4.65) are ahead = 0 and 1.

    Args:
        plots: n, at least 2, any shape.
        ahead: scans after the last plot, p, any shape that fits.

    Returns:
        Variance, in the common shape.
    """
    n, p = np.asarray(plots, dtype=float), np.asarray(ahead, dtype=float)
    numerator = (n - 1.0) * (2.0 * n - 1.0) + 6.0 * p * (n - 1.0) + 6.0 * p**2
    return np.asarray(2.0 * numerator / (n * (n**2 - 1.0)))
