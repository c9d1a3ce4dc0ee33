# SPDX-License-Identifier: Apache-2.0
"""Paths of legs: what a scenario or a random model says of one target's motion."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from radar_sim.motion.pieces import Pieces

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Leg:
    """A piece of a path, at a constant turn rate or a constant centripetal acceleration.

    Attributes:
        duration: s.
        turn_rate: rad/s, positive clockwise; zero where there is a centripetal acceleration.
        acceleration: along the course, m/s².
        centripetal: across the course, m/s², positive to the right.
        course_jump: sudden change of course at its beginning, rad.
        speed_jump: sudden change of speed at its beginning, m/s.
    """

    duration: float
    turn_rate: float = 0.0
    acceleration: float = 0.0
    centripetal: float = 0.0
    course_jump: float = 0.0
    speed_jump: float = 0.0


@dataclass(frozen=True, slots=True)
class Path:
    """How one target moves and how long it is there.

    Attributes:
        x: m east at the time of appearance.
        y: m north.
        speed: m/s.
        course: rad clockwise from north.
        legs: one after the other.
        appears: s after the start of the simulation.
        disappears: s after the start of the simulation, inf for never.
        pieces: motion by polynomials instead of speed, course and legs; None for those.
        wander: added to either; None for none.
    """

    x: float
    y: float
    speed: float
    course: float
    legs: tuple[Leg, ...] = ()
    appears: float = 0.0
    disappears: float = np.inf
    pieces: Pieces | None = None
    wander: Pieces | None = None


@dataclass(frozen=True, slots=True)
class State:
    """Where targets are and how they move, every array of the same shape: m and m/s, east and north."""

    x: FloatArray
    y: FloatArray
    vx: FloatArray
    vy: FloatArray
