# SPDX-License-Identifier: Apache-2.0
"""Filters of several models of motion that share what they know, each weighted by how well it foretells the plots.

Source: Blom and Bar-Shalom 1988 (interacting multiple models); the target switches between models at rates in time, so
that the antenna's period and missed plots change nothing.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from secondary_proc.motion import FloatArray, inverse_2x2, normalised_square
from secondary_proc.smoothing.interface import Measured, Smoothed, joseph_update
from secondary_proc.smoothing.manoeuvre import ManoeuvreDetector
from secondary_proc.smoothing.motion_models import MotionModel

_LEAST_WEIGHT = 1e-12
_LEAST_SPEED = 20.0


class InteractingModelsSmoother:
    """Interacting multiple models: quiet flight first, then the kinds of manoeuvre."""

    def __init__(
        self,
        models: Sequence[MotionModel],
        manoeuvre_acceleration: float,
        interval: float,
        duration: float,
        detector: ManoeuvreDetector,
    ) -> None:
        """Set the models and how they follow each other.

        Args:
            models: quiet flight, then at least one kind of manoeuvre, all kinds equally likely.
            manoeuvre_acceleration: standard deviation of the accelerations in a manoeuvre, m/s^2.
            interval: mean time of quiet flight between manoeuvres, s.
            duration: mean duration of a manoeuvre, s.
            detector: of plots that even the last model does not explain.
        """
        count, size = len(models), max(model.size for model in models)
        self.memory: np.dtype[Any] = np.dtype(
            [
                ("weight", float, (count,)),
                ("state", float, (count, size)),
                ("covariance", float, (count, size, size)),
            ]
        )
        self._models = models
        self._size = size
        self._detector = detector
        self._acceleration = manoeuvre_acceleration
        kinds = count - 1
        self._rate = 1.0 / interval + 1.0 / duration
        quiet = interval / (interval + duration)
        self._prior = np.array([quiet] + [(1.0 - quiet) / kinds] * kinds)
        self._interval, self._duration = interval, duration

    def update(self, measured: Measured) -> Smoothed:
        """Combine predictions and plot.

        Args:
            measured: tracks and plots.

        Returns:
            The tracks at the time of their plots; memory holds every model's state and weight.
        """
        seconds = measured.seconds
        weight, states, covariances = self._mixed(measured)
        turn_std = self._turn_std(measured.state)
        for number, model in enumerate(self._models):
            states[:, number], covariances[:, number] = model.predict(
                states[:, number], covariances[:, number], seconds, turn_std
            )
        likelihood = self._correct(measured, states, covariances)
        likelihood -= likelihood.max(axis=1, keepdims=True)
        weight = np.maximum(weight * np.exp(likelihood), _LEAST_WEIGHT)
        weight /= weight.sum(axis=1, keepdims=True)
        memory = np.empty(len(weight), self.memory)
        memory["weight"], memory["state"], memory["covariance"] = weight, states, covariances
        state, covariance = _moments(weight[:, None], states, covariances)
        return Smoothed(state[:, 0, :4], covariance[:, 0, :4, :4], memory)

    def _correct(
        self, measured: Measured, states: FloatArray, covariances: FloatArray
    ) -> FloatArray:
        """Correct every model's prediction by the plot, in place; logarithmic likelihoods, shape (n, models)."""
        shape, size = states.shape[:2], self._size
        models = shape[1]
        # One update of all models' states: numpy costs by the call.
        state = states.reshape(-1, size)
        spread = covariances.reshape(-1, size, size)
        error = measured.position_covariance.repeat(models, axis=0)
        expected = spread[:, :2, :2] + error
        innovation = measured.position.repeat(models, axis=0) - state[:, :2]
        square, determinant = normalised_square(innovation, expected)
        last = slice(models - 1, None, models)
        sharper = self._detector.declared(square[last], 2).nonzero()[0]
        if len(sharper):
            # A turn sharper than the last model allows for: it is widened by as much as it was wrong, lest it claim
            # to know the velocity.
            rows = sharper * models + models - 1
            spread[rows] *= square[rows, None, None]
            expected[rows] = spread[rows, :2, :2] + error[rows]
            square[rows], determinant[rows] = normalised_square(innovation[rows], expected[rows])
        gain = spread[:, :, :2] @ inverse_2x2(expected)[0]
        state += (gain @ innovation[:, :, None])[:, :, 0]
        spread[:] = joseph_update(spread, gain, error)
        return -0.5 * (square + np.log(determinant)).reshape(shape)

    def transition(self, seconds: FloatArray) -> FloatArray:
        """Probabilities to go from one model to another.

        Args:
            seconds: time between two plots, shape (n,).

        Returns:
            From the model of the first index to that of the second, shape (n, models, models).
        """
        # A manoeuvre of one kind becomes one of another only through quiet flight.
        fade = np.exp(-self._rate * seconds)[:, None, None]
        stay = np.exp(-seconds / self._duration)[:, None, None]
        count = len(self._models)
        matrix = np.empty((len(seconds), count, count))
        quiet, kind = self._prior[0], self._prior[1:]
        matrix[:, :1, 0] = quiet + (1.0 - quiet) * fade[:, 0]
        matrix[:, :1, 1:] = kind * (1.0 - fade)
        matrix[:, 1:, 0] = quiet * (1.0 - fade[:, 0])
        among = 1.0 - matrix[:, 1:, :1] - stay
        matrix[:, 1:, 1:] = stay * np.eye(count - 1) + among / (count - 1)
        return matrix

    def _mixed(self, measured: Measured) -> tuple[FloatArray, FloatArray, FloatArray]:
        memory = measured.memory
        before, states, covariances = memory["weight"], memory["state"], memory["covariance"]
        new = before[:, 0] == 0.0
        if new.any():
            before, states, covariances = before.copy(), states.copy(), covariances.copy()
            before[new] = self._prior
            states[new, :, :4] = measured.state[new, None]
            covariances[new, :, :4, :4] = measured.covariance[new, None]
            covariances[new, :, 4:, 4:] = (
                self._turn_std(measured.state[new])[:, None, None, None] ** 2
            )
        joint = before[:, :, None] * self.transition(measured.seconds)
        weight = joint.sum(axis=1)
        share = (joint / weight[:, None]).transpose(0, 2, 1)
        return weight, *_moments(share, states, covariances)

    def _turn_std(self, state: FloatArray) -> FloatArray:
        speed = np.hypot(state[:, 2], state[:, 3])
        return self._acceleration / np.maximum(speed, _LEAST_SPEED)


def _moments(
    weight: FloatArray, states: FloatArray, covariances: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Means and covariances of several mixtures of the same models.

    Args:
        weight: of the models in each mixture, shape (n, mixtures, models).
        states: shape (n, models, size).
        covariances: shape (n, models, size, size).

    Returns:
        (mean, covariance), shapes (n, mixtures, size) and (n, mixtures, size, size).
    """
    count, models, size = states.shape
    mean = weight @ states
    away = states[:, None] - mean[:, :, None]
    spread = weight @ covariances.reshape(count, models, size * size)
    spread = spread.reshape(*mean.shape, size)
    spread += (away * weight[..., None]).transpose(0, 1, 3, 2) @ away
    spread += spread.transpose(0, 1, 3, 2).copy()
    spread *= 0.5
    return mean, spread
