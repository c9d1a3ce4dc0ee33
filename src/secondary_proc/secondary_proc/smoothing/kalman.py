# SPDX-License-Identifier: Apache-2.0
"""Kalman filter of uniform motion that widens its bandwidth while the target manoeuvres.

The measurement is the plot converted to x and y with the covariance that the radar's errors have there.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from secondary_proc.motion import (
    inverse_2x2,
    normalised_square,
    predict_covariance,
    predict_state,
    unit_noise,
)
from secondary_proc.smoothing.interface import Measured, Smoothed, joseph_update
from secondary_proc.smoothing.manoeuvre import ManoeuvreDetector

_FORGETTING = 0.5


class KalmanSmoother:
    """Kalman filter whose process noise follows the normalised innovation."""

    memory: np.dtype[Any] = np.dtype(float)

    def __init__(
        self, quiet_density: float, manoeuvre_density: float, detector: ManoeuvreDetector
    ) -> None:
        """Set the two levels of the process noise.

        Args:
            quiet_density: power spectral density of the acceleration between manoeuvres, m^2/s^3.
            manoeuvre_density: the same in a manoeuvre.
            detector: of the innovations that begin one.
        """
        self._quiet = quiet_density
        self._manoeuvre = manoeuvre_density
        self._detector = detector

    def update(self, measured: Measured) -> Smoothed:
        """Combine prediction and plot.

        Args:
            measured: tracks and plots.

        Returns:
            The tracks at the time of their plots; memory is the manoeuvre's present intensity, 0 to 1.
        """
        seconds, error = measured.seconds, measured.position_covariance
        state = predict_state(measured.state, seconds)
        innovation = measured.position - state[:, :2]
        covariance = predict_covariance(measured.covariance, seconds, self._quiet)
        expected = covariance[:, :2, :2] + error
        fresh = self._detector.declared(normalised_square(innovation, expected)[0], 2)
        intensity = np.where(fresh, 1.0, _FORGETTING * measured.memory)
        if np.count_nonzero(intensity):
            more = (self._manoeuvre - self._quiet) * intensity
            covariance += more[:, None, None] * unit_noise(seconds)
            expected = covariance[:, :2, :2] + error
        inverse, _ = inverse_2x2(expected)
        gain = covariance[:, :, :2] @ inverse
        state += (gain @ innovation[:, :, None])[:, :, 0]
        return Smoothed(state, joseph_update(covariance, gain, error), intensity)
