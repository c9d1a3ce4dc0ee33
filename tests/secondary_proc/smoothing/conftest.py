# SPDX-License-Identifier: Apache-2.0
"""Plots of many targets for a smoother alone: each track has one plot in every step, at a time of its own."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest

from secondary_proc.motion import noise_density, two_point_state
from secondary_proc.parameters import TrackerParameters
from secondary_proc.smoothing import SMOOTHERS, Measured


@dataclass
class Scene:
    """Plots as positions.

    Attributes:
        seconds: since the plot before, shape (plots - 1, tracks).
        truth: (x, y, vx, vy), shape (plots, tracks, 4).
        position: measured, shape (plots, tracks, 2).
        covariance: of its error, shape (plots, tracks, 2, 2).
    """

    seconds: np.ndarray
    truth: np.ndarray
    position: np.ndarray
    covariance: np.ndarray

    def only(self, which):
        return Scene(
            self.seconds[:, which],
            self.truth[:, which],
            self.position[:, which],
            self.covariance[:, which],
        )

    def moved(self, angle, shift):
        """The same scene, turned about the origin and shifted."""
        sine, cosine = np.sin(angle), np.cos(angle)
        turn = np.array([[cosine, -sine], [sine, cosine]])
        truth = np.concatenate(
            [self.truth[..., :2] @ turn.T + shift, self.truth[..., 2:] @ turn.T], axis=-1
        )
        return Scene(
            self.seconds,
            truth,
            self.position @ turn.T + shift,
            turn @ self.covariance @ turn.T,
        )


def straight_flights(tracks, plots, seed, *, density=0.0, noise=1.0, scale=1.0, speed=250.0):
    """Flights with white acceleration, at intervals of 3 to 9 s; errors of 20 m in range, 60 to 120 m across."""
    random = np.random.default_rng(seed)
    seconds = random.choice([3.0, 4.0, 4.5, 9.0], size=(plots - 1, tracks))
    truth = np.empty((plots, tracks, 4))
    place, course = random.uniform(-np.pi, np.pi, (2, tracks))
    truth[0, :, :2] = random.uniform(30e3, 60e3, tracks)[:, None] * np.stack(
        [np.sin(place), np.cos(place)], axis=1
    )
    truth[0, :, 2:] = speed * np.stack([np.sin(course), np.cos(course)], axis=1)
    for step, dt in enumerate(seconds):
        shove = np.sqrt(density) * random.standard_normal((2, tracks, 2))
        root, dt = np.sqrt(dt)[:, None], dt[:, None]
        faster = root * shove[0]
        # Displacement by white acceleration, correlated with the gain of speed.
        aside = dt * root * (shove[0] / 2.0 + shove[1] / np.sqrt(12.0))
        truth[step + 1, :, :2] = truth[step, :, :2] + dt * truth[step, :, 2:] + aside
        truth[step + 1, :, 2:] = truth[step, :, 2:] + faster
    across = random.uniform(60.0, 120.0, tracks)
    azimuth = np.arctan2(truth[..., 0], truth[..., 1])
    axes = np.stack(
        [
            np.stack([np.sin(azimuth), np.cos(azimuth)], axis=-1),
            np.stack([np.cos(azimuth), -np.sin(azimuth)], axis=-1),
        ],
        axis=-1,
    )
    deviations = np.stack([np.full(tracks, 20.0), across], axis=-1)
    root = scale * axes * deviations[:, None]
    error = (root @ random.standard_normal((plots, tracks, 2, 1)))[..., 0]
    return Scene(seconds, truth, truth[..., :2] + noise * error, root @ np.swapaxes(root, -1, -2))


def run_smoother(scene, parameters, *, azimuth=None, start=None):
    """States and covariances from the second plot on, which opens the tracks."""
    smoother = SMOOTHERS[parameters.smoother](parameters)
    tracks = scene.seconds.shape[1]
    if start is None:
        start = two_point_state(
            scene.position[0],
            scene.covariance[0],
            scene.position[1],
            scene.covariance[1],
            scene.seconds[0],
            noise_density(parameters.acceleration),
        )
    state, covariance = start
    if azimuth is None:
        azimuth = np.arctan2(scene.position[..., 0], scene.position[..., 1])
    memory = np.zeros(tracks, smoother.memory)
    states, covariances = [state], [covariance]
    for plot in range(2, len(scene.position)):
        smoothed = smoother.update(
            Measured(
                state,
                covariance,
                memory,
                np.full(tracks, plot + 1),
                scene.seconds[plot - 1],
                scene.position[plot],
                scene.covariance[plot],
                azimuth[plot],
            )
        )
        state, covariance, memory = smoothed.state, smoothed.covariance, smoothed.memory
        states.append(state)
        covariances.append(covariance)
    return np.array(states), np.array(covariances)


VARIANTS = {
    "kalman": {"smoother": "kalman"},
    "alpha_beta": {"smoother": "alpha_beta"},
    "alpha_beta, predicted": {
        "smoother": "alpha_beta",
        "alpha_beta_criterion": "predicted",
    },
    "alpha_beta, second increment": {
        "smoother": "alpha_beta",
        "alpha_beta_criterion": "second_increment",
    },
    "polynomial": {"smoother": "polynomial"},
    "polynomial, lines": {"smoother": "polynomial", "polynomial_degree": 1},
    "speed_course": {"smoother": "speed_course"},
    "speed_course, weighted mean": {
        "smoother": "speed_course",
        "speed_course_weights": "weighted_mean",
    },
    "imm": {"smoother": "imm"},
    "imm, turns": {"smoother": "imm", "imm_manoeuvres": "turns"},
}


@pytest.fixture(scope="session")
def flights():
    return straight_flights


@pytest.fixture(scope="session")
def smooth():
    return run_smoother


@pytest.fixture(params=list(VARIANTS))
def variant(request):
    """Makes the parameters of every smoother in every way to use it."""
    return lambda **more: TrackerParameters(**VARIANTS[request.param], **more)


@pytest.fixture(params=[name for name in VARIANTS if name != "imm, turns"])
def straight_variant(request):
    """The same without that which expects turns, so that flights without any are not what it expects."""
    return lambda **more: TrackerParameters(**VARIANTS[request.param], **more)


@pytest.fixture(scope="session")
def variants():
    return VARIANTS
