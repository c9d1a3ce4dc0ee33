# SPDX-License-Identifier: Apache-2.0
"""The bearing simulator: a scenario and a seed become messages in order of the time at which they leave."""

from __future__ import annotations

import heapq
import itertools
from collections.abc import Iterator
from typing import NamedTuple, Self

import numpy as np

from radar_common.odometry import PlatformState
from radar_common.parameters import ParameterError
from radar_common.tables import (
    BEARINGS_TOPIC,
    CHANNEL_TRUTH_TOPIC,
    NANOSECONDS,
    PLATFORM_TOPIC,
    PLOTS_TOPIC,
    RADAR_FRAME,
    SITE_FRAME,
    TRUTH_TOPIC,
    Table,
)
from radar_sim.bearings.active_channel import ActiveChannel
from radar_sim.bearings.direction_finder import DirectionFinder
from radar_sim.bearings.parameters import BearingSimulatorParameters
from radar_sim.bearings.sections import ActiveChannelSection
from radar_sim.bearings.sources import Sources
from radar_sim.bearings.violations import Violations
from radar_sim.scenario import Scenario, load_scenario

_BLOCK = 64
# The radar simulator spawns its streams from the same seed; here are others.
_OWN_STREAMS = 0xB


class Message(NamedTuple):
    """One message.

    Attributes:
        due: s after the start at which it leaves.
        topic: name without the leading slash.
        content: what it holds.
    """

    due: float
    topic: str
    content: Table | PlatformState


class BearingSimulator:
    """Platform, direction finder and active channel of one scenario.

    Targets and traffic are those that a `Simulator` of the same scenario and seed draws.

    Attributes:
        sources: everything that has a bearing.
        start: stamp of simulated time zero, nanoseconds; may be set until the first message is made.
    """

    def __init__(
        self,
        scenario: Scenario,
        *,
        seed: int = 1,
        duration: float = 0.0,
        active: bool = True,
        start: int = 0,
    ) -> None:
        """Draw everything that is drawn once.

        Args:
            scenario: with at least one of the two sensors.
            seed: of all randomness.
            duration: simulated s after which iteration ends, 0 for never.
            active: whether there are plots of the active channel.
            start: stamp of simulated time zero, nanoseconds.

        Raises:
            ParameterError: the scenario says nothing of bearings, or nothing is left to simulate.
        """
        scene = scenario.bearings
        if scene is None:
            raise ParameterError(
                "the scenario has neither direction_finder nor channels.active, so there are no bearings"
            )
        if scene.platform is None and not active:
            raise ParameterError(
                "without a direction_finder, active: false leaves nothing to simulate"
            )
        # The first stream of the seed is that of targets and traffic, here as in the radar simulator.
        (traffic,) = np.random.SeedSequence(seed).spawn(1)
        own = np.random.SeedSequence(seed, spawn_key=(_OWN_STREAMS,)).spawn(5)
        drawing, finding, measuring, jamming, silencing = map(np.random.default_rng, own)
        self.start = start
        self._duration = duration if duration else float("inf")
        targets = scenario.draw(np.random.default_rng(traffic))
        self.sources = Sources(scene, targets, drawing)
        self._finder = (
            DirectionFinder(scene.platform, scene.passive, self.sources, finding)
            if scene.platform
            else None
        )
        self._active = (
            ActiveChannel(scene.active, scenario.radar, self.sources, measuring)
            if scene.active and active
            else None
        )
        listening = scene.platform.section.period if scene.platform else 1.0
        self._silences = Violations(scene.passive, scene.silences, listening, silencing)
        jammed = scene.active or ActiveChannelSection()
        self._jams = Violations(jammed, scene.jams, jammed.period, jamming)
        self._messages: Iterator[Message] | None = None

    @classmethod
    def from_parameters(cls, parameters: BearingSimulatorParameters) -> Self:
        """Build a simulator as the node does.

        Args:
            parameters: scenario, seed, duration and start time.

        Returns:
            The simulator.

        Raises:
            ScenarioError: the scenario cannot be used.
            ParameterError: it says nothing of bearings.
        """
        return cls(
            load_scenario(parameters.scenario),
            seed=parameters.seed,
            duration=parameters.duration,
            active=parameters.active,
            start=parameters.start_time * NANOSECONDS,
        )

    @property
    def has_direction_finder(self) -> bool:
        """Whether there are bearings."""
        return self._finder is not None

    @property
    def has_active_channel(self) -> bool:
        """Whether there are plots."""
        return self._active is not None

    def __iter__(self) -> Iterator[Message]:
        """Iterate over the messages that are still to come."""
        return self

    def __next__(self) -> Message:
        """Make the next message.

        Returns:
            The message.

        Raises:
            StopIteration: the duration is over.
        """
        if self._messages is None:
            streams = [self._odometry(), self._bearings(), self._plots()]
            # Of what is due at once, the platform comes first: a bearing needs its place.
            self._messages = heapq.merge(*streams, key=lambda message: message.due)
        return next(self._messages)

    def _odometry(self) -> Iterator[Message]:
        if self._finder is None:
            return
        for first in itertools.count(0, _BLOCK):
            for time, state in self._finder.odometry(first, _BLOCK, self.start):
                if time > self._duration:
                    return
                yield Message(time, PLATFORM_TOPIC, state)

    def _bearings(self) -> Iterator[Message]:
        if self._finder is not None:
            yield from self._looks(self._finder, BEARINGS_TOPIC, SITE_FRAME, truth=True)

    def _plots(self) -> Iterator[Message]:
        if self._active is not None:
            alone = self._finder is None
            yield from self._looks(self._active, PLOTS_TOPIC, RADAR_FRAME, truth=alone)

    def _looks(
        self, sensor: DirectionFinder | ActiveChannel, topic: str, frame: str, *, truth: bool
    ) -> Iterator[Message]:
        for first in itertools.count(0, _BLOCK):
            for look in sensor.looks(first, _BLOCK, self._jams, self._silences):
                if look.begin > self._duration:
                    return
                stamp = self.start + round(look.begin * NANOSECONDS)
                yield Message(look.due, topic, Table(stamp, look.measured, frame))
                if truth:
                    yield Message(look.due, TRUTH_TOPIC, Table(stamp, look.truth, SITE_FRAME))
                channels = Table(stamp, look.channels, SITE_FRAME)
                yield Message(look.due, CHANNEL_TRUTH_TOPIC, channels)
