# SPDX-License-Identifier: Apache-2.0
"""Alpha-beta smoothing: memory grows with the track until the coefficients reach their optimum against manoeuvres.

Source: Kuzmin 1967, (4.82)-(4.87) for the growing coefficients, (4.107)-(4.112) for the optimum. Range and the
direction across it are smoothed each with its own coefficients because their errors differ by an order of magnitude.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from secondary_proc.calculators.alpha_beta_gains import growing_coefficients, steady_coefficients
from secondary_proc.motion import FloatArray, predict_covariance, predict_state
from secondary_proc.smoothing.interface import Measured, Smoothed, joseph_update


class AlphaBetaSmoother:
    """Growing, then bounded alpha-beta filter along range and across it."""

    memory: np.dtype[Any] = np.dtype(float)

    def __init__(
        self, acceleration: float, noise_density: float, criterion: str = "smoothed"
    ) -> None:
        """Set what the filter must follow.

        Args:
            acceleration: of a manoeuvre that the coefficients are the optimum for, m/s^2.
            noise_density: power spectral density of the acceleration that the covariance accounts for, m^2/s^3.
            criterion: what the coefficients are the best for, one of GAIN_RULES.
        """
        self._acceleration = acceleration
        self._density = noise_density
        self._criterion = criterion

    def update(self, measured: Measured) -> Smoothed:
        """Combine prediction and plot.

        Args:
            measured: tracks and plots.

        Returns:
            The tracks at the time of their plots; memory stays as it is.
        """
        alpha, beta = self._coefficients(measured)
        sine, cosine = np.sin(measured.azimuth), np.cos(measured.azimuth)
        axes = np.stack(
            [np.stack([sine, cosine], axis=1), np.stack([cosine, -sine], axis=1)], axis=1
        )
        position_gain = axes.transpose(0, 2, 1) @ (alpha[:, :, None] * axes)
        rate_gain = axes.transpose(0, 2, 1) @ (beta[:, :, None] * axes)
        rate_gain /= measured.seconds[:, None, None]
        gain = np.concatenate([position_gain, rate_gain], axis=1)
        state = predict_state(measured.state, measured.seconds)
        innovation = measured.position - state[:, :2]
        state += (gain @ innovation[:, :, None])[:, :, 0]
        covariance = predict_covariance(measured.covariance, measured.seconds, self._density)
        covariance = joseph_update(covariance, gain, measured.position_covariance)
        return Smoothed(state, covariance, measured.memory)

    def _coefficients(self, measured: Measured) -> tuple[FloatArray, FloatArray]:
        sine, cosine = np.sin(measured.azimuth), np.cos(measured.azimuth)
        xx, xy, yy = (measured.position_covariance[:, i, j] for i, j in ((0, 0), (0, 1), (1, 1)))
        along = xx * sine**2 + 2 * xy * sine * cosine + yy * cosine**2
        variance = np.stack([along, xx + yy - along], axis=1)
        second_increment = self._acceleration * measured.seconds[:, None] ** 2
        steady = steady_coefficients(second_increment**2 / variance, self._criterion)
        growing = growing_coefficients(measured.hits[:, None])
        bounded = steady[0] > growing[0]
        return np.where(bounded, steady[0], growing[0]), np.where(bounded, steady[1], growing[1])
