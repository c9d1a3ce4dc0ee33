# SPDX-License-Identifier: Apache-2.0
"""The simulator: a scenario and a seed become sectors of sweeps, each with its truth."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple, Self

import numpy as np
import numpy.typing as npt

from radar_common.parameters import ParameterError
from radar_common.tables import NANOSECONDS, RADAR_FRAME, SITE_FRAME, TRUTH, Table, sweep_dtype
from radar_sim.bursts import find_crossings, make_echoes, pulses_to_either_side
from radar_sim.digitiser import Digitiser
from radar_sim.echoes import EchoQueue
from radar_sim.parameters import SimulatorParameters
from radar_sim.receiver import Receiver
from radar_sim.reception import Reception
from radar_sim.scenario import Scenario, load_scenario
from radar_sim.signal_strength import snr_db_at_range
from radar_sim.waveform_receiver import WaveformReceiver


class Sector(NamedTuple):
    """One sector as it is published.

    Attributes:
        sweeps: its pulses, rows of `sweep_dtype`.
        truth: targets that the beam's axis passed in it, rows of TRUTH.
    """

    sweeps: Table
    truth: Table


class Simulator:
    """Turns the antenna, sector by sector.

    Noise, fluctuation, traffic and every source of clutter and interference have independent streams of the seed and
    draw in order of pulses and bursts, so the number of sectors changes nothing in the data but their division into
    messages.

    Attributes:
        radar: the scenario's radar.
        targets: all targets, the traffic drawn.
        start: stamp of the first pulse, nanoseconds; may be set until the first sector is made.
    """

    def __init__(
        self,
        scenario: Scenario,
        *,
        seed: int = 1,
        sectors: int = 32,
        scans: int = 0,
        sample: str = "float32",
        video_law: str = "linear",
        start: int = 0,
    ) -> None:
        """Draw the traffic and point the antenna north.

        Args:
            scenario: radar and targets.
            seed: of all randomness.
            sectors: messages a turn.
            scans: turns after which iteration ends, 0 for never.
            sample: type of a video sample: float32, uint8 or uint16.
            video_law: linear or logarithmic.
            start: stamp of the first pulse, nanoseconds.

        Raises:
            ParameterError: there are more sectors than pulses.
        """
        pulses = scenario.radar.pulses_per_scan
        if sectors > pulses:
            raise ParameterError(f"sectors {sectors} exceed the {pulses:g} pulses of a turn")
        *streams, disturbing = np.random.SeedSequence(seed).spawn(6)
        traffic, noise, phase, fluctuation, field_phase = map(np.random.default_rng, streams)
        self.radar = scenario.radar
        self.targets = scenario.draw(traffic)
        self._fluctuation = fluctuation
        digitiser = Digitiser(self.radar, sample, video_law)
        self._receiver: Receiver | WaveformReceiver = (
            Receiver(self.radar, digitiser, noise, phase, field_phase)
            if self.radar.independent_cells
            else WaveformReceiver(self.radar, digitiser, noise)
        )
        self._disturbances = scenario.disturb(disturbing)
        self._dtype = sweep_dtype(self.radar.cells, sample)
        self._sectors = sectors
        self._number = scans * sectors if scans else None
        self.start = start
        self._sector = 0
        self._turns_made = 0
        self._echoes = EchoQueue()
        self._truth = np.empty(0, TRUTH)

    @classmethod
    def from_parameters(cls, parameters: SimulatorParameters) -> Self:
        """Build a simulator as the node does.

        Args:
            parameters: scenario, seed, number of scans and sectors, sample type, video law, start time.

        Returns:
            The simulator.

        Raises:
            ScenarioError: the scenario cannot be used.
            ParameterError: there are more sectors than pulses.
        """
        return cls(
            load_scenario(parameters.scenario),
            seed=parameters.seed,
            sectors=parameters.sectors,
            scans=parameters.scans,
            sample=parameters.sample,
            video_law=parameters.video_law,
            start=parameters.start_time * NANOSECONDS,
        )

    @property
    def elapsed(self) -> float:
        """Simulated time up to the end of the latest sector, s."""
        return self._first_pulse(self._sector) * self.radar.pulse_interval

    def __iter__(self) -> Iterator[Sector]:
        """Iterate over the sectors that are still to come."""
        return self

    def __next__(self) -> Sector:
        """Make the next sector.

        Returns:
            Its sweeps and its truth, both with the stamp of its first pulse.

        Raises:
            StopIteration: all scans are done.
        """
        if self._sector == self._number:
            raise StopIteration
        first, after = self._first_pulse(self._sector), self._first_pulse(self._sector + 1)
        self._sector += 1
        self._look_ahead(after)
        stamp = self.start + round(first * self.radar.pulse_interval * NANOSECONDS)
        since_start = (stamp - self.start) / NANOSECONDS
        sweeps = self._sweeps(first, after, since_start)
        truth = self._take_truth(after, since_start)
        return Sector(Table(stamp, sweeps, RADAR_FRAME), Table(stamp, truth, SITE_FRAME))

    def _first_pulse(self, sector: int) -> int:
        return math.ceil(sector * self.radar.pulses_per_scan / self._sectors)

    def _sweeps(self, first: int, after: int, since_start: float) -> npt.NDArray[np.void]:
        radar = self.radar
        pulses = np.arange(first, after)
        rows = np.empty(len(pulses), self._dtype)
        rows["azimuth"] = radar.azimuth(pulses)
        rows["time_offset"] = pulses * radar.pulse_interval - since_start
        rows["range_start"] = radar.range_start
        rows["range_step"] = radar.range_step
        reception = Reception(first, len(pulses), radar.cells)
        reception.add_echoes(self._echoes.take(after))
        for disturbance in self._disturbances:
            disturbance.add_to(reception)
        self._receiver.receive(rows["video"], reception)
        return rows

    def _take_truth(self, after: int, since_start: float) -> npt.NDArray[np.void]:
        taken = int(np.searchsorted(self._truth["time_offset"], after * self.radar.pulse_interval))
        truth, self._truth = self._truth[:taken].copy(), self._truth[taken:]
        truth["time_offset"] -= since_start
        return truth

    def _look_ahead(self, after: int) -> None:
        # The first pulses of a burst come before the turn in which the axis passes its target.
        reached = (after + pulses_to_either_side(self.radar)) / self.radar.pulses_per_scan
        while self._turns_made <= reached:
            self._make_turn(self._turns_made)
            self._turns_made += 1

    def _make_turn(self, turn: int) -> None:
        crossings = find_crossings(self.targets, self.radar, turn)
        echoes = make_echoes(crossings, self.targets, self.radar, self._fluctuation)
        self._echoes.add(echoes)
        covered = (crossings.distance >= self.radar.range_start) & (
            crossings.distance < self.radar.range_end
        )
        truth = np.zeros(len(crossings.target), TRUTH)
        for name in ("x", "y", "vx", "vy"):
            truth[name] = getattr(crossings.state, name)
        truth["id"] = crossings.target + 1
        truth["time_offset"] = crossings.time
        truth["range"] = crossings.distance
        truth["azimuth"] = crossings.azimuth
        truth["snr_db"] = snr_db_at_range(
            self.radar, self.targets.snr_db[crossings.target], np.maximum(crossings.distance, 1.0)
        )
        truth = truth[covered]
        order = np.argsort(truth["time_offset"], kind="stable")
        self._truth = np.concatenate([self._truth, truth[order]])
