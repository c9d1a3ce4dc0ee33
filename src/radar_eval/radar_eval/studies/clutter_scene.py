# SPDX-License-Identifier: Apache-2.0
"""A clutter scenario of the simulator with targets put into it, held in memory for many extractors to run on."""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.ndimage import uniform_filter

from radar_common.frames import TWO_PI, enu_from_polar
from radar_common.tables import NANOSECONDS, Table
from radar_sim.motion import Path
from radar_sim.radar import Radar
from radar_sim.scenario import Scenario, load_scenario
from radar_sim.simulator import Simulator
from radar_sim.targets import Target

FloatArray = npt.NDArray[np.float64]

WEAK_DB, STRONG_DB = 13.0, 35.0
"""Signal-to-noise ratio of targets in the middle of their way: weak ones for clear areas, strong ones for clutter."""

_SECTORS = 16
_NEAREST, _FARTHEST = 0.2, 0.9
_SPEED = 1.5
_CLUTTER_TURNS = 2
_CLUTTER_RATIO = 2.0
_SMOOTHING = (9, 5)


@dataclass(frozen=True, slots=True)
class Scene:
    """Some turns of a scenario.

    Attributes:
        name: of the scenario.
        radar: of the scenario.
        turns: how many.
        sweeps: sectors, one after the other.
        time: when the beam's axis passes a target, s after the start, shape (looks,).
        distance: of the target then, m, shape (looks,).
        strong: whether it is a strong target, shape (looks,).
        in_clutter: whether clutter there lies 3 dB over the noise, shape (looks,).
    """

    name: str
    radar: Radar
    turns: int
    sweeps: list[Table]
    time: FloatArray
    distance: FloatArray
    strong: npt.NDArray[np.bool_]
    in_clutter: npt.NDArray[np.bool_]


def make_scene(name: str, turns: int, targets: int, seed: int) -> Scene:
    """Simulate a scenario with targets that fly towards the radar or away from it, 1.5 range cells a turn.

    Args:
        name: of the scenario, as the simulator knows it.
        turns: of the antenna.
        targets: of each strength.
        seed: of the places and of the simulator.

    Returns:
        The scene.

    Raises:
        ScenarioError: there is no such scenario.
    """
    scenario = load_scenario(name)
    rng = np.random.default_rng(seed)
    strengths = np.repeat([WEAK_DB, STRONG_DB], targets)
    drawn = tuple(_target(scenario.radar, strength, turns, rng) for strength in strengths)
    simulator = Simulator(
        dataclasses.replace(scenario, targets=drawn), seed=seed, sectors=_SECTORS, scans=turns
    )
    sectors = list(simulator)
    truth = np.concatenate([sector.truth.rows for sector in sectors])
    stamps = np.repeat(
        [sector.truth.stamp / NANOSECONDS for sector in sectors],
        [len(sector.truth.rows) for sector in sectors],
    )
    disturbed = _disturbed(scenario, seed)
    radar = scenario.radar
    pulse = (truth["azimuth"] / TWO_PI * len(disturbed)).astype(int)
    cell = ((truth["range"] - radar.range_start) / radar.range_step).astype(int)
    return Scene(
        name=name,
        radar=radar,
        turns=turns,
        sweeps=[sector.sweeps for sector in sectors],
        time=stamps + truth["time_offset"],
        distance=truth["range"].astype(float),
        strong=truth["id"] > targets,
        in_clutter=disturbed[pulse, cell],
    )


def _target(radar: Radar, snr_db: float, turns: int, rng: np.random.Generator) -> Target:
    """One target on a radial course, of the wanted strength in the middle of its way."""
    middle = radar.range_end * rng.uniform(_NEAREST, _FARTHEST)
    azimuth = rng.uniform(0.0, TWO_PI)
    speed = _SPEED * radar.range_step / radar.scan_period
    outwards = rng.random() < 0.5
    half_way = 0.5 * turns * _SPEED * radar.range_step
    start = middle - half_way if outwards else middle + half_way
    east, north = enu_from_polar(start, azimuth)
    course = azimuth if outwards else azimuth + math.pi
    at_reference = snr_db - 40.0 * math.log10(radar.reference_range / middle)
    path = Path(x=float(east), y=float(north), speed=speed, course=course)
    return Target(path, at_reference, "none")


def _disturbed(scenario: Scenario, seed: int) -> npt.NDArray[np.bool_]:
    """Where the mean power without targets is twice that of noise, shape (pulses of a turn, cells)."""
    radar = scenario.radar
    bare = dataclasses.replace(scenario, targets=(), traffic=())
    sectors = list(Simulator(bare, seed=seed, sectors=_SECTORS, scans=_CLUTTER_TURNS))
    video = np.concatenate([sector.sweeps.rows["video"] for sector in sectors])
    power = np.square(video, dtype=float) / (2.0 * radar.noise_level**2)
    mean = power.reshape(_CLUTTER_TURNS, -1, radar.cells).mean(axis=0)
    return np.asarray(uniform_filter(mean, _SMOOTHING, mode="nearest") > _CLUTTER_RATIO)
