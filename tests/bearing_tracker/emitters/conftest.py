# SPDX-License-Identifier: Apache-2.0
"""A small scene that all filters are tried on."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest

from bearing_tracker.emitters import Prior


@dataclass(frozen=True)
class Passage:
    """Bearings of n emitters taken by one observer: shapes (T, n) and (T, n, 2), period in seconds."""

    azimuth: np.ndarray
    observer: np.ndarray
    truth: np.ndarray
    std: float
    period: float

    def prior(self, speed_std=10.0):
        return Prior.between(1e3, 60e3, speed_std=speed_std, emitters=self.azimuth.shape[1])

    def run(self, chosen, looks=None, prior=None, rows=slice(None)):
        n = self.azimuth[:, rows].shape[1]
        std, seconds = np.full(n, self.std), np.full(n, self.period)
        prior = (prior or self.prior()).take(np.arange(self.azimuth.shape[1])[rows])
        belief = chosen.start(self.azimuth[0, rows], std, self.observer[0, rows], prior)
        for look in range(1, looks or len(self.azimuth)):
            belief = chosen.step(
                belief,
                seconds,
                self.observer[look, rows],
                self.azimuth[look, rows],
                std,
                np.ones(n, bool),
            )
        return belief


def passage(emitters=6, looks=40, turn=0.8, std=0.005, period=5.0, seed=3):
    random = np.random.default_rng(seed)
    seconds = period * np.arange(looks)
    course = np.where(seconds < 0.5 * seconds[-1], turn, -turn)
    moves = 120.0 * period * np.stack([np.sin(course), np.cos(course)], axis=-1)[:-1]
    observer = np.concatenate([np.zeros((1, 2)), np.cumsum(moves, axis=0)])
    bearing, distance = random.uniform(0, 2 * np.pi, emitters), random.uniform(8e3, 30e3, emitters)
    start = (distance * np.array([np.sin(bearing), np.cos(bearing)])).T
    velocity = random.normal(0.0, 5.0, (emitters, 2))
    places = start + seconds[:, None, None] * velocity
    truth = np.concatenate([places, np.broadcast_to(velocity, places.shape)], axis=-1)
    relative = places - observer[:, None]
    azimuth = np.arctan2(relative[..., 0], relative[..., 1])
    azimuth = np.mod(azimuth + std * random.standard_normal(azimuth.shape), 2 * np.pi)
    everywhere = np.broadcast_to(observer[:, None], (looks, emitters, 2)).copy()
    return Passage(azimuth, everywhere, truth, std, period)


@pytest.fixture(name="passage")
def passage_fixture():
    return passage


@pytest.fixture(scope="session")
def usual():
    return passage()
