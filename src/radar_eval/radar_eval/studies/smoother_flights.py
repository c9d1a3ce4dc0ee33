# SPDX-License-Identifier: Apache-2.0
"""Flights on which smoothers are compared, and the plots of them that a radar makes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from radar_common.frames import TWO_PI
from radar_sim.motion import Fleet, Leg, Path

FloatArray = npt.NDArray[np.float64]

STANDARD_GRAVITY = 9.80665
QUIET = 120.0
"""Seconds of straight flight before the manoeuvre."""
AFTERWARDS = 20.0
"""Seconds after its end that still count to it."""

_NEAREST, _FARTHEST = 30e3, 50e3


@dataclass(frozen=True, slots=True)
class Flight:
    """What all targets of one trial do after their straight beginning.

    Attributes:
        name: for people.
        speed: at the beginning, m/s.
        legs: the manoeuvre; empty for straight flight all the time.
        manoeuvre_acceleration: that a user sets for targets that do so, m/s^2.
    """

    name: str
    speed: float
    legs: tuple[Leg, ...] = ()
    manoeuvre_acceleration: float = 8.0

    @property
    def window(self) -> tuple[float, float]:
        """Seconds between which the errors count: the manoeuvre and what follows, or as much of straight flight."""
        lasting = sum(leg.duration for leg in self.legs) or 100.0
        return QUIET, QUIET + lasting + AFTERWARDS


def _turn(speed: float, gravities: float, angle: float) -> Leg:
    rate = gravities * STANDARD_GRAVITY / speed
    return Leg(abs(angle) / rate, turn_rate=float(np.copysign(rate, angle)))


def _weave(speed: float, gravities: float, swings: int) -> tuple[Leg, ...]:
    first = _turn(speed, gravities, np.pi / 3)
    sides = (_turn(speed, gravities, (-1) ** n * 2 * np.pi / 3) for n in range(1, swings))
    return first, *sides


FLIGHTS = (
    Flight("straight", 200.0),
    Flight("change of speed", 120.0, (Leg(40.0, acceleration=3.0),)),
    Flight("turn, 1 g", 200.0, (_turn(200.0, 1.0, np.pi),)),
    Flight("turn, 3 g", 250.0, (_turn(250.0, 3.0, np.pi),), 30.0),
    Flight("weave, 7 g", 300.0, _weave(300.0, 7.0, 8), 70.0),
)


@dataclass(frozen=True, slots=True)
class Radar:
    """How plots come about.

    Attributes:
        period: of the antenna, s.
        range_std: m.
        azimuth_std: rad.
        detection: probability of a plot per passage.
    """

    period: float
    range_std: float = 50.0
    azimuth_std: float = 2.5e-3
    detection: float = 0.9


@dataclass(frozen=True, slots=True)
class Plotted:
    """Plots of targets that fly alone, one a turn of the antenna and target.

    Attributes:
        time: when the beam passed, s, shape (turns, targets).
        found: whether there is a plot, shape (turns, targets).
        range: measured, m, shape (turns, targets).
        azimuth: measured, rad, shape (turns, targets).
        position: true, east and north in metres, shape (turns, targets, 2).
        velocity: true, m/s, shape (turns, targets, 2).
    """

    time: FloatArray
    found: npt.NDArray[np.bool_]
    range: FloatArray
    azimuth: FloatArray
    position: FloatArray
    velocity: FloatArray


def plots_of(flight: Flight, radar: Radar, targets: int, random: np.random.Generator) -> Plotted:
    """Fly and look.

    Args:
        flight: of every target, from places and on courses of their own.
        radar: that looks.
        targets: how many.
        random: where places, courses, errors and misses come from.

    Returns:
        The plots, until the flight's window ends.
    """
    azimuths = random.uniform(0.0, TWO_PI, targets)
    place = random.uniform(_NEAREST, _FARTHEST, targets) * np.exp(1j * azimuths)
    # Away from the radar or past it: overhead, every tracker has other worries than its smoother.
    courses = azimuths + random.uniform(-np.pi / 2, np.pi / 2, targets)
    legs = (Leg(QUIET), *flight.legs)
    fleet = Fleet(
        [
            Path(x=float(z.imag), y=float(z.real), speed=flight.speed, course=float(q), legs=legs)
            for z, q in zip(place, courses, strict=True)
        ]
    )
    turns = int(np.ceil(flight.window[1] / radar.period))
    who = np.broadcast_to(np.arange(targets), (turns, targets))
    begin = np.arange(turns)[:, None] * radar.period
    time = np.broadcast_to(begin, who.shape).astype(float)
    # The beam meets the target where both azimuths agree: a few steps of a fixed point.
    for _ in range(20):
        state = fleet.state(who, time)
        time = begin + radar.period / TWO_PI * np.mod(np.arctan2(state.x, state.y), TWO_PI)
    state = fleet.state(who, time)
    shape = who.shape
    measured = np.hypot(state.x, state.y) + radar.range_std * random.standard_normal(shape)
    azimuth = np.arctan2(state.x, state.y) + radar.azimuth_std * random.standard_normal(shape)
    return Plotted(
        time,
        random.random(shape) < radar.detection,
        measured,
        np.mod(azimuth, TWO_PI),
        np.stack([state.x, state.y], axis=-1),
        np.stack([state.vx, state.vy], axis=-1),
    )
