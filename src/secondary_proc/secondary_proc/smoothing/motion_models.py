# SPDX-License-Identifier: Apache-2.0
"""Models of motion between which a target switches: uniform, or a coordinated turn.

The state is (x, y, vx, vy), with the turn rate as fifth where one of the models needs it.

Source: Bar-Shalom, Li, Kirubarajan 2001, (11.7.1-4) to (11.7.2-8) for the turn and its derivatives.
"""

from __future__ import annotations

from typing import Protocol

import numpy as np

from secondary_proc.motion import FloatArray, predict_covariance, predict_state, unit_noise

_SLOWEST_TURN = 1e-5


class MotionModel(Protocol):
    """Moves the states of many tracks."""

    size: int
    """Length of the shortest state that it can move, 4 or 5."""

    def predict(
        self, state: FloatArray, covariance: FloatArray, seconds: FloatArray, turn_std: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Predict.

        Args:
            state: (x, y, vx, vy) and perhaps the turn rate anticlockwise, m, m/s and rad/s, shape (n, size).
            covariance: of the state, shape (n, size, size).
            seconds: time to predict over, shape (n,).
            turn_std: standard deviation of the turn rates of manoeuvres at this speed, rad/s, shape (n,).

        Returns:
            (state, covariance), same shapes.
        """
        ...


class UniformMotion:
    """Straight flight at one speed, but for white acceleration; of a turn rate to come nothing is known."""

    size = 4

    def __init__(self, noise_density: float) -> None:
        """Set the noise.

        Args:
            noise_density: power spectral density of the acceleration, m^2/s^3.
        """
        self._density = noise_density

    def predict(
        self, state: FloatArray, covariance: FloatArray, seconds: FloatArray, turn_std: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Predict.

        Args:
            state: shape (n, 4) or (n, 5).
            covariance: of the state, shape (n, 4, 4) or (n, 5, 5).
            seconds: time to predict over, shape (n,).
            turn_std: standard deviation of the turn rates of manoeuvres, rad/s, shape (n,).

        Returns:
            (state, covariance), same shapes.
        """
        if state.shape[1] == self.size:
            moved = predict_state(state, seconds)
            return moved, predict_covariance(covariance, seconds, self._density)
        moved, spread = np.zeros_like(state), np.zeros_like(covariance)
        moved[:, :4] = predict_state(state[:, :4], seconds)
        spread[:, :4, :4] = predict_covariance(covariance[:, :4, :4], seconds, self._density)
        spread[:, 4, 4] = turn_std**2
        return moved, spread


class CoordinatedTurn:
    """Turn at a rate that changes slowly."""

    size = 5

    def __init__(self, noise_density: float, memory: float) -> None:
        """Set the noise.

        Args:
            noise_density: power spectral density of the acceleration beside the turn's, m^2/s^3.
            memory: seconds in which the turn rate changes as much as turn rates differ.
        """
        self._density = noise_density
        self._memory = memory

    def predict(
        self, state: FloatArray, covariance: FloatArray, seconds: FloatArray, turn_std: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Predict.

        Args:
            state: shape (n, 5).
            covariance: of the state, shape (n, 5, 5).
            seconds: time to predict over, shape (n,).
            turn_std: standard deviation of the turn rates of manoeuvres, rad/s, shape (n,).

        Returns:
            (state, covariance), same shapes.
        """
        vx, vy, rate = state[:, 2:].T
        slow = np.abs(rate) < _SLOWEST_TURN
        rate = np.where(slow, _SLOWEST_TURN, rate)
        angle = rate * seconds
        sine, cosine = np.sin(angle), np.cos(angle)
        ahead, aside = sine / rate, (1.0 - cosine) / rate
        # Derivatives of both by the rate; the differences lose digits only where the terms are negligible.
        ahead_slope = (seconds * cosine - ahead) / rate
        aside_slope = (seconds * sine - aside) / rate
        jacobian = np.zeros((len(state), 5, 5))
        jacobian[:, range(5), range(5)] = 1.0
        jacobian[:, 0, 2] = jacobian[:, 1, 3] = ahead
        jacobian[:, 0, 3], jacobian[:, 1, 2] = -aside, aside
        jacobian[:, 2, 2] = jacobian[:, 3, 3] = cosine
        jacobian[:, 2, 3], jacobian[:, 3, 2] = -sine, sine
        moved = (jacobian @ state[:, :, None])[:, :, 0]
        jacobian[:, 0, 4] = ahead_slope * vx - aside_slope * vy
        jacobian[:, 1, 4] = aside_slope * vx + ahead_slope * vy
        jacobian[:, 2, 4] = -seconds * moved[:, 3]
        jacobian[:, 3, 4] = seconds * moved[:, 2]
        spread = jacobian @ covariance @ jacobian.transpose(0, 2, 1)
        spread[:, :4, :4] += self._density * unit_noise(seconds)
        spread[:, 4, 4] += turn_std**2 * seconds / self._memory
        return moved, spread
