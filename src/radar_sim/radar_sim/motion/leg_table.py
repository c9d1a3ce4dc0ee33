# SPDX-License-Identifier: Apache-2.0
"""The legs of many targets in rectangular arrays."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import fields

import numpy as np
import numpy.typing as npt

from radar_sim.motion.legs import Leg, Path
from radar_sim.motion.pieces import locate
from radar_sim.motion.turns import centripetal_turn, displacement

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]
IntArray = npt.NDArray[np.intp]


class LegTable:
    """Position, speed and course at the beginning of every leg, and how they change on it."""

    def __init__(self, paths: Sequence[Path]) -> None:
        """Fly all legs of all paths once.

        Args:
            paths: one a target.
        """
        width = 1 + max((len(path.legs) for path in paths), default=0)
        shape = (len(paths), width)
        # A leg that does not exist begins never.
        self._begin = np.full(shape, np.inf)
        leg_values = {field.name: np.zeros(shape) for field in fields(Leg)}
        for row, path in enumerate(paths):
            if path.legs:
                for name, values in leg_values.items():
                    values[row, : len(path.legs)] = [getattr(leg, name) for leg in path.legs]
            begins = path.appears + np.cumsum([0.0, *(leg.duration for leg in path.legs)])
            self._begin[row, : len(begins)] = begins
        self._turn_rate = leg_values["turn_rate"]
        self._acceleration = leg_values["acceleration"]
        self._centripetal = leg_values["centripetal"]
        self._pulled = bool(self._centripetal.any())
        self._position = np.zeros(shape, dtype=complex)
        self._speed = np.zeros(shape)
        self._course = np.zeros(shape)
        if paths:
            self._position[:, 0] = [path.y + 1j * path.x for path in paths]
            self._speed[:, 0] = [path.speed for path in paths]
            self._course[:, 0] = [path.course for path in paths]
        self._first = np.arange(len(paths)) * width
        self._count = np.full(len(paths), width, dtype=np.intp)
        rows = np.arange(len(paths))
        for column in range(width - 1):
            self._speed[:, column] += leg_values["speed_jump"][:, column]
            self._course[:, column] += leg_values["course_jump"][:, column]
            after = self._fly(rows * width + column, leg_values["duration"][:, column])
            for values, value in zip(
                (self._position, self._speed, self._course), after, strict=True
            ):
                values[:, column + 1] = value

    def state(self, target: IntArray, time: FloatArray) -> tuple[ComplexArray, ComplexArray]:
        """Evaluate the motion.

        Args:
            target: index, any shape.
            time: s after the start, same shape.

        Returns:
            Position in m and velocity in m/s, north + i east, same shape.
        """
        leg = locate(self._begin.ravel(), self._first, self._count, target, time)
        position, speed, course = self._fly(leg, time - self._begin.ravel()[leg])
        return position, speed * np.exp(1j * course)

    def _fly(
        self, leg: IntArray, elapsed: FloatArray
    ) -> tuple[ComplexArray, FloatArray, FloatArray]:
        speed, course = self._speed.ravel()[leg], self._course.ravel()[leg]
        acceleration, turn_rate = self._acceleration.ravel()[leg], self._turn_rate.ravel()[leg]
        way = displacement(speed, course, turn_rate, acceleration, elapsed)
        turn = turn_rate * elapsed
        if self._pulled:
            centripetal = self._centripetal.ravel()[leg]
            pulled = (centripetal != 0.0) & (speed > 0.0)
            veer, arc = centripetal_turn(
                np.where(pulled, speed, 1.0), centripetal, acceleration, elapsed
            )
            way = np.where(pulled, np.exp(1j * course) * arc, way)
            turn = np.where(pulled, veer, turn)
        position = self._position.ravel()[leg] + way
        return position, speed + acceleration * elapsed, course + turn
