# SPDX-License-Identifier: Apache-2.0
"""The models of random motion by their name in a scenario, and what they make of a path."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from radar_sim.motion.correlated import CorrelatedMotion, WanderSection
from radar_sim.motion.increments import FirstIncrementsMotion, SecondIncrementsMotion
from radar_sim.motion.legs import Path
from radar_sim.motion.model import MotionModel
from radar_sim.motion.pieces import Pieces
from radar_sim.motion.polynomials import PiecewiseMotion, PolynomialMotion
from radar_sim.motion.speed_course import ArcsMotion, SpeedCourseMotion

MOTIONS: dict[str, type[MotionModel]] = {
    "polynomial": PolynomialMotion,
    "piecewise": PiecewiseMotion,
    "first-increments": FirstIncrementsMotion,
    "second-increments": SecondIncrementsMotion,
    "correlated": CorrelatedMotion,
    "speed-course": SpeedCourseMotion,
    "arcs": ArcsMotion,
}
"""What `model` may be in a `motion`."""


def draw_paths(
    paths: list[Path],
    motion: MotionModel | None,
    wander: WanderSection | None,
    rng: np.random.Generator,
) -> list[Path]:
    """Let paths move at random.

    Args:
        paths: with first position, speed and course of each.
        motion: takes the place of their legs; None leaves these.
        wander: added to it; None for none.
        rng: source of randomness, not touched where both are None.

    Returns:
        The same paths, their motion drawn.
    """
    if motion is not None:
        speed = np.array([path.speed for path in paths], dtype=float)
        course = np.array([path.course for path in paths], dtype=float)
        drawn = motion.draw(speed, course, rng)
        paths = [
            replace(path, pieces=way) if isinstance(way, Pieces) else replace(path, legs=way)
            for path, way in zip(paths, drawn, strict=True)
        ]
    if wander is not None:
        offsets = wander.draw(len(paths), rng)
        paths = [replace(path, wander=way) for path, way in zip(paths, offsets, strict=True)]
    return paths
