# SPDX-License-Identifier: Apache-2.0
"""The recursion of the alpha-beta filter with gains that may change from scan to scan, velocity observed or not.

Source: Kuzmin 1967, § 4.5.1-4.5.3, (4.79)-(4.91). Velocity is per scan.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from secondary_proc.calculators.alpha_beta_gains import aided_coefficients, growing_coefficients
from secondary_proc.calculators.rule_chain import FloatArray


@dataclass(frozen=True, slots=True)
class Gains:
    """Gains of each plot after the start, each of shape (scans,).

    Attributes:
        alpha: of the coordinate's residual in the coordinate.
        beta: of the coordinate's residual in the velocity.
        aid_position: of the velocity's residual in the coordinate, Delta_n.
        aid_velocity: of the velocity's residual in the velocity, nabla_n.
    """

    alpha: FloatArray
    beta: FloatArray
    aid_position: FloatArray
    aid_velocity: FloatArray


def bounded_gains(plots: int, alpha: float, beta: float) -> Gains:
    """Growing memory that stops to grow where the coordinate's gain has fallen to its bound.

    Source: (4.82a), (4.86) and the remark after figure 4.10; alpha = beta = 0 is the growing memory itself.

    Args:
        plots: n, at least 3.
        alpha: bound of the coordinate's gain, which the optimum against manoeuvres sets.
        beta: velocity's gain from there on.

    Returns:
        Gains of plots 3 to n.
    """
    growing = growing_coefficients(np.arange(3, plots + 1))
    bounded = growing[0] < alpha
    none = np.zeros(plots - 2)
    return Gains(
        np.where(bounded, alpha, growing[0]), np.where(bounded, beta, growing[1]), none, none
    )


def second_increment_gains(plots: int, intensity: float) -> Gains:
    """Optimal gains where the velocity changes at random from scan to scan: the Kalman form.

    Source: (4.88), (4.89), with the covariance that the book does not write down.

    Args:
        plots: n, at least 3.
        intensity: rms second increment over the error of a plot, sigma_gamma / sigma_y.

    Returns:
        Gains of plots 3 to n.
    """
    covariance = np.array([[1.0, 1.0], [1.0, 2.0]])
    move, noise = np.array([[1.0, 1.0], [0.0, 1.0]]), np.full((2, 2), intensity**2)
    gains = np.empty((plots - 2, 2))
    for gain in gains:
        covariance = move @ covariance @ move.T + noise
        gain[:] = covariance[:, 0] / (covariance[0, 0] + 1.0)
        covariance = covariance - np.outer(gain, covariance[0])
    none = np.zeros(plots - 2)
    return Gains(gains[:, 0], gains[:, 1], none, none)


def aided_gains(plots: int, ratio: float) -> Gains:
    """Growing memory with observed velocity, equal to the least-squares line through all observations.

    Source: (4.90), (4.91), alpha_n corrected.

    Args:
        plots: n, at least 3.
        ratio: c = sigma_y^2 / (sigma_v T_0)^2.

    Returns:
        Gains of plots 3 to n.
    """
    return Gains(*aided_coefficients(np.arange(3, plots + 1), ratio))


def run_filter(
    gains: Gains,
    plots: FloatArray,
    start: tuple[FloatArray, FloatArray],
    velocities: FloatArray | None = None,
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Filter the plots of many tracks.

    Args:
        gains: one of each attribute a plot.
        plots: coordinates after the start, shape (scans, ...).
        start: coordinate and velocity before the first of them, each of shape (...).
        velocities: observed, times the scan period, shape (scans, ...); None if there are none.

    Returns:
        (predicted coordinate, smoothed coordinate, smoothed velocity), each of shape (scans, ...).
    """
    coordinate, velocity = start
    predicted, smoothed, speed = np.empty((3, *plots.shape))
    for scan, plot in enumerate(plots):
        predicted[scan] = coordinate + velocity
        off = plot - predicted[scan]
        faster = 0.0 if velocities is None else velocities[scan] - velocity
        coordinate = predicted[scan] + gains.alpha[scan] * off + gains.aid_position[scan] * faster
        velocity = velocity + gains.beta[scan] * off + gains.aid_velocity[scan] * faster
        smoothed[scan], speed[scan] = coordinate, velocity
    return predicted, smoothed, speed
