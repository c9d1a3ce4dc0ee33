# SPDX-License-Identifier: Apache-2.0
"""Kalman filter of uniform motion that widens its bandwidth while the target manoeuvres.

The measurement is the plot converted to x and y with the covariance that the radar's errors have there.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from secondary_proc.motion import (
    inverse_2x2,
    predict_covariance,
    predict_position_covariance,
    predict_state,
    quadratic_form,
)
from secondary_proc.smoothing.interface import Measured, Smoothed, joseph_update

MANOEUVRE_THRESHOLD = 12.0
"""Normalised innovation squared that quiet flight exceeds once in 400 plots (chi-square, two degrees of freedom)."""
_FORGETTING = 0.5


class KalmanSmoother:
    """Kalman filter whose process noise follows the normalised innovation."""

    memory: np.dtype[Any] = np.dtype(float)

    def __init__(self, quiet_density: float, manoeuvre_density: float) -> None:
        """Set the two levels of the process noise.

        Args:
            quiet_density: power spectral density of the acceleration between manoeuvres, m^2/s^3.
            manoeuvre_density: the same in a manoeuvre.
        """
        self._quiet = quiet_density
        self._manoeuvre = manoeuvre_density

    def update(self, measured: Measured) -> Smoothed:
        """Combine prediction and plot.

        Args:
            measured: tracks and plots.

        Returns:
            The tracks at the time of their plots; memory is the manoeuvre's present intensity, 0 to 1.
        """
        state = predict_state(measured.state, measured.seconds)
        innovation = measured.position - state[:, :2]
        spread = predict_position_covariance(measured.covariance, measured.seconds, self._quiet)
        inverse, _ = inverse_2x2(spread + measured.position_covariance)
        fresh = quadratic_form(innovation, inverse) > MANOEUVRE_THRESHOLD
        intensity = np.where(fresh, 1.0, _FORGETTING * measured.memory)
        density = self._quiet + (self._manoeuvre - self._quiet) * intensity
        covariance = predict_covariance(measured.covariance, measured.seconds, density)
        inverse, _ = inverse_2x2(covariance[:, :2, :2] + measured.position_covariance)
        gain = covariance[:, :, :2] @ inverse
        state += (gain @ innovation[:, :, None])[:, :, 0]
        return Smoothed(
            state, joseph_update(covariance, gain, measured.position_covariance), intensity
        )
