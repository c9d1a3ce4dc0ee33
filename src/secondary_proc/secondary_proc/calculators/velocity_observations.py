# SPDX-License-Identifier: Apache-2.0
"""The straight line through n plots when velocity is observed too, by a Doppler radar for instance.

Source: Kuzmin 1967, § 4.4.5, (4.70)-(4.78). c = sigma_y^2 / (sigma_v T_0)^2; without velocity c = 0. Velocity is per
scan; variances are over that of a plot's coordinate.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from secondary_proc.calculators.rule_chain import FloatArray


@dataclass(frozen=True, slots=True)
class AidedWeights:
    """Weights of one estimate.

    Attributes:
        position: of the coordinates of plots 1 to n, shape (n,).
        velocity: of each observed velocity, times the scan period; it is the same for all plots.
    """

    position: FloatArray
    velocity: float


def aided_velocity_weights(plots: int, ratio: float) -> AidedWeights:
    """Weights of the velocity.

    Source: (4.74).

    Args:
        plots: n, at least 2.
        ratio: c.

    Returns:
        The weights.
    """
    i, common = np.arange(1, plots + 1), _common(plots, ratio)
    return AidedWeights(
        np.asarray(6.0 * (2 * i - plots - 1) / common), float(12.0 * ratio / common)
    )


def aided_position_weights(plots: int, ratio: float, ahead: int) -> AidedWeights:
    """Weights of the coordinate in any scan.

    Source: (4.73); (4.75) and (4.76) are ahead = 0 and 1.

    Args:
        plots: n, at least 2.
        ratio: c.
        ahead: scans after the last plot; 1 - n is the first plot.

    Returns:
        The weights.
    """
    i, common = np.arange(1, plots + 1), _common(plots, ratio)
    first = 2.0 * ((plots - 1) * (2 * plots + 2 - 3 * i) + 6.0 * ratio) / common
    first_of_velocity = -6.0 * ratio * (plots - 1) / common
    velocity = aided_velocity_weights(plots, ratio)
    scans = plots + ahead - 1
    return AidedWeights(
        np.asarray(first + scans * velocity.position),
        float(first_of_velocity + scans * velocity.velocity),
    )


def aided_velocity_variance(plots: npt.ArrayLike, ratio: npt.ArrayLike) -> FloatArray:
    """Variance of the velocity.

    Source: (4.77).

    Args:
        plots: n, at least 2, any shape.
        ratio: c, any shape that fits.

    Returns:
        Variance, in the common shape.
    """
    return np.asarray(12.0 / _common(plots, ratio))


def aided_position_variance(
    plots: npt.ArrayLike, ratio: npt.ArrayLike, ahead: npt.ArrayLike = 0
) -> FloatArray:
    """Variance of the coordinate in any scan.

    Source: (4.78) for ahead = 0, corrected: the print has n - 1 and 6 c where (n - 1)^2 and 3 c belong.

    Args:
        plots: n, at least 2, any shape.
        ratio: c, any shape that fits.
        ahead: scans after the last plot, any shape that fits.

    Returns:
        Variance, in the common shape.
    """
    n, p = np.asarray(plots, dtype=float), np.asarray(ahead, dtype=float)
    from_middle = (n - 1.0) / 2.0 + p
    return np.asarray(1.0 / n + from_middle**2 * 12.0 / _common(plots, ratio))


def _common(plots: npt.ArrayLike, ratio: npt.ArrayLike) -> FloatArray:
    n = np.asarray(plots, dtype=float)
    return np.asarray(n * (n**2 - 1.0 + 12.0 * np.asarray(ratio, dtype=float)))
