# SPDX-License-Identifier: Apache-2.0
"""Texture: how the mean power of clutter varies over the ground and from turn to turn.

A normal field has independent values at knots in range and azimuth. Between two knots it is their sum with the
weights cos and sin of an angle that goes from 0 to a quarter turn, so its variance is one everywhere; nothing is left
of the correlation at two knot distances. A table turns it into the amplitude of the law.

The rows of knots follow the antenna: each is drawn when the beam gets there, from the row of the turn before.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from radar_common.frames import FloatArray
from radar_sim.clutter.amplitude_laws import texture_quantile
from radar_sim.radar import Radar

Float32Array = npt.NDArray[np.float32]

_FARTHEST = 5.5  # Standard deviations: passed by one knot in twenty-five million.
_TABLE = 8192


@dataclass(frozen=True, slots=True)
class Grain:
    """How far texture reaches.

    Attributes:
        along: distance of knots in range, m.
        across: distance of knots in azimuth, rad.
        lifetime: time in which the correlation of the normal field falls to 1/e, s; inf for texture that stays.
    """

    along: float
    across: float
    lifetime: float


class Texture:
    """Amplitude factors of mean square one for successive pulses."""

    def __init__(
        self,
        law: str,
        shape: float,
        grain: Grain,
        radar: Radar,
        ranges: FloatArray,
        rng: np.random.Generator,
    ) -> None:
        """Lay out the knots.

        Args:
            law: of the amplitude, one of LAWS.
            shape: of the law.
            grain: distances in which it varies.
            radar: how the antenna turns.
            ranges: centres of the range cells, m, shape (cells,).
            rng: source of randomness.
        """
        normal = np.linspace(-_FARTHEST, _FARTHEST, _TABLE)
        self._table = np.sqrt(texture_quantile(law, shape, normal)).astype(np.float32)
        self._per_turn = max(2, round(2.0 * math.pi / grain.across))
        self._pulses_per_knot = radar.pulses_per_scan / self._per_turn
        self._memory = math.exp(-radar.scan_period / grain.lifetime)
        step = max(grain.along, radar.range_step)
        along = (ranges - ranges[0]) / step
        self._knot = np.floor(along).astype(np.int64)
        angle = (along - self._knot) * (math.pi / 2.0)
        self._near, self._far = np.cos(angle).astype(np.float32), np.sin(angle).astype(np.float32)
        self._rng = rng
        self._rows = np.empty((self._per_turn, len(ranges)), np.float32)
        self._drawn = np.full(self._per_turn, -1, np.int64)

    def amplitude(self, first: int, pulses: int) -> Float32Array:
        """Factors of successive pulses.

        Args:
            first: number of the first pulse, not before those of earlier calls.
            pulses: how many.

        Returns:
            Root of the texture, shape (pulses, cells).
        """
        along = np.arange(first, first + pulses) / self._pulses_per_knot
        knot = np.floor(along).astype(np.int64)
        angle = ((along - knot) * (math.pi / 2.0))[:, None]
        before, after = np.cos(angle).astype(np.float32), np.sin(angle).astype(np.float32)
        field = np.empty((pulses, self._rows.shape[1]), np.float32)
        share = np.empty_like(field)
        begins = [0, *np.flatnonzero(np.diff(knot)) + 1, pulses]
        for begin, end in pairwise(begins):
            part = slice(begin, end)
            np.multiply(before[part], self._row(int(knot[begin])), out=field[part])
            np.multiply(after[part], self._row(int(knot[begin]) + 1), out=share[part])
        field += share
        return self._look_up(field)

    def _row(self, number: int) -> Float32Array:
        place = number % self._per_turn
        turns = (number - self._drawn[place]) // self._per_turn
        row = self._rows[place]
        if self._drawn[place] < 0:
            row[:] = self._fresh()
        elif turns and self._memory < 1.0:
            memory = self._memory**turns
            row *= np.float32(memory)
            row += np.float32(math.sqrt(1.0 - memory**2)) * self._fresh()
        self._drawn[place] = number
        return row

    def _fresh(self) -> Float32Array:
        knots = self._rng.standard_normal(int(self._knot[-1]) + 2, dtype=np.float32)
        return np.asarray(self._near * knots[self._knot] + self._far * knots[self._knot + 1])

    def _look_up(self, field: Float32Array) -> Float32Array:
        field += np.float32(_FARTHEST)
        field *= np.float32((_TABLE - 1) / (2.0 * _FARTHEST))
        return np.take(self._table, field.astype(np.intp), mode="clip")
