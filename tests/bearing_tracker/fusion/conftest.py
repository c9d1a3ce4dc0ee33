# SPDX-License-Identifier: Apache-2.0
"""Targets seen through two channels that may be disturbed."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import pytest

from bearing_tracker.fusion import FILTERS, Channel, ChannelPair, Motion, Reading
from bearing_tracker.fusion.azimuth_channels import azimuth_channel, azimuth_pair
from bearing_tracker.fusion.surveillance import surveillance_motion


@dataclass(frozen=True)
class Scene:
    """Steps of many targets: what a filter is given."""

    channels: ChannelPair
    mean: np.ndarray
    covariance: np.ndarray
    motions: list[Motion]
    active: list[Reading]
    passive: list[Reading]

    def follow(self, name):
        """Beliefs after each step."""
        tracker = FILTERS[name](self.channels)
        beliefs = [tracker.start(self.mean, self.covariance)]
        for step in zip(self.motions, self.active, self.passive, strict=True):
            beliefs.append(tracker.step(beliefs[-1], *step))
        return tracker, beliefs[1:]

    def end(self, name, output="mmse"):
        """Estimate after the last step."""
        tracker, beliefs = self.follow(name)
        return tracker.estimate(beliefs[-1], output)

    def rotated(self, angle):
        """The same scene after north has moved."""
        turn = np.array([angle, 0.0])
        return replace(
            self,
            mean=self.mean + turn,
            active=[replace(r, value=np.mod(r.value + angle, 2 * np.pi)) for r in self.active],
            passive=[replace(r, value=np.mod(r.value + angle, 2 * np.pi)) for r in self.passive],
        )

    def part(self, rows):
        """Some of the targets."""

        def of(reading):
            return Reading(
                reading.value[rows],
                reading.covariance[rows],
                reading.reported[rows],
                reading.state[rows],
            )

        return replace(
            self,
            mean=self.mean[rows],
            covariance=self.covariance[rows],
            motions=[Motion(m.transition[rows], m.noise[rows]) for m in self.motions],
            active=[of(reading) for reading in self.active],
            passive=[of(reading) for reading in self.passive],
        )


def azimuth_scene(seed=1, targets=30, steps=12, share=0.8, north=0.0, scale=1.0):
    """Targets that turn slowly about the sensor; angles carry what is near `north`."""
    random = np.random.default_rng(seed)
    chain = ((0.9, 0.1), (0.2, 0.8))
    channels = azimuth_pair(
        azimuth_channel(chain, (1.0, 100.0), (1.0, 1.0)),
        azimuth_channel(chain, (1.0, 400.0), (1.0, 0.0)),
    )
    rate = 0.002 * random.standard_normal(targets)
    azimuth = north + 0.05 * random.standard_normal(targets)
    mean = np.stack([azimuth + 0.01 * random.standard_normal(targets), np.zeros(targets)], axis=1)
    motions, readings = [], ([], [])
    for _ in range(steps):
        seconds = random.uniform(0.5, 4.0, targets)
        azimuth = azimuth + rate * seconds
        motions.append(surveillance_motion(seconds, random.uniform(5e3, 9e4, targets), 3.0, 10.0))
        for reports in readings:
            state = (random.random(targets) < 0.3).astype(np.intp)
            std = scale * random.uniform(0.001, 0.01, targets)
            value = azimuth + std * np.where(state, 10.0, 1.0) * random.standard_normal(targets)
            reported = random.random(targets) < share
            value[~reported] = np.nan
            covariance = np.where(reported, std**2, np.nan)[:, None, None]
            reports.append(Reading(np.mod(value, 2 * np.pi)[:, None], covariance, reported, state))
    covariance = np.tile(np.diag([1e-4, 1e-5]), (targets, 1, 1))
    return Scene(channels, mean, covariance, motions, *readings)


def linear_scene(seed=2, targets=5, steps=20, missing=False):
    """Plain numbers: three components of the state, readings of two and one, three and two states of the channels."""
    random = np.random.default_rng(seed)

    def chain(states):
        rows = random.random((states, states)) + np.eye(states)
        return rows / rows.sum(axis=1, keepdims=True)

    def noise(states, size):
        factor = np.tril(random.standard_normal((states, size, size)))
        return factor + 2.0 * np.arange(1, states + 1)[:, None, None] * np.eye(size)

    channels = ChannelPair(
        Channel(chain(3), random.standard_normal((3, 2, 3)), noise(3, 2), np.zeros(2, bool)),
        Channel(chain(2), random.standard_normal((2, 1, 3)), noise(2, 1), np.zeros(1, bool)),
        np.zeros(3, bool),
    )
    transition = np.eye(3) + 0.1 * random.standard_normal((3, 3))
    shape = 0.3 * random.standard_normal((3, 3))
    motion = Motion(transition, shape @ shape.T)

    def readings(size):
        return [
            Reading(
                3.0 * random.standard_normal((targets, size)),
                np.eye(size),
                random.random(targets) < 0.7 if missing else np.ones(targets, bool),
                random.integers(0, 2, targets),
            )
            for _ in range(steps)
        ]

    return Scene(
        channels,
        random.standard_normal((targets, 3)),
        np.eye(3),
        [motion] * steps,
        readings(2),
        readings(1),
    )


@pytest.fixture
def make_azimuth_scene():
    """Make a scene of azimuths."""
    return azimuth_scene


@pytest.fixture
def make_linear_scene():
    """Make a scene of plain numbers."""
    return linear_scene
