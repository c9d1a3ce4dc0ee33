# SPDX-License-Identifier: Apache-2.0
"""Sector messages become one unbroken stream of pulses, or the reason why they do not is counted.

A pulse continues the stream if its range cells are the same, its time is not earlier and its azimuth has gone on by
no more than a few steps. Anything else breaks the stream: what follows starts afresh. North is not special.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from primary_proc.stream.sweep_check import require_sweeps, usable_rows
from radar_common.frames import TWO_PI
from radar_common.health import Health
from radar_common.tables import NANOSECONDS, Table

FloatArray = npt.NDArray[np.float64]

FEWEST_PULSES = 16
"""Pulses that must be there before the rotation is believed."""

_BACK, _AHEAD = -0.6, 4.5  # Steps: encoders are coarse, and three lost pulses do no harm.
_PAUSE = 0.25  # Scans.
_UNEVEN = 0.125  # Share of breaks at which the azimuth cannot be followed.
_STANDING = 0.25  # Share of the known step.
_LEAST_STEP = 1e-6  # rad
_LEARNING = 0.1  # Scans over which the step is averaged.
_NOWHERE = np.zeros(0, np.intp)


@dataclass(frozen=True, slots=True)
class Pulses:
    """Consecutive pulses of one radar.

    Attributes:
        fresh: whether they do not continue the pulses before.
        video: linear envelope, shape (n, cells).
        azimuth: rad, shape (n,).
        time: s after the stream's origin, shape (n,).
        range_start: near edge of cell 0, m.
        range_step: length of a cell, m.
        azimuth_step: mean azimuth from pulse to pulse, rad.
    """

    fresh: bool
    video: npt.NDArray
    azimuth: FloatArray
    time: FloatArray
    range_start: float
    range_step: float
    azimuth_step: float


class _Pulse(NamedTuple):
    """What the next pulse is held against."""

    layout: np.dtype[np.void]
    azimuth: float
    time: float
    range_start: float
    range_step: float


class SweepStream:
    """Orders and checks sectors.

    Attributes:
        origin: nanoseconds since the epoch from which times are counted; None before the first sector.
    """

    def __init__(self, health: Health, envelope: Callable[[npt.NDArray], npt.NDArray]) -> None:
        """Start with no pulse.

        Args:
            health: where breaks and drops are counted.
            envelope: makes linear envelopes of samples, see `expansion`.
        """
        self._health = health
        self._envelope = envelope
        self.origin: int | None = None
        self.restart()

    def take(self, sweeps: Table) -> list[Pulses]:
        """Take a sector.

        Args:
            sweeps: one message of `radar/sweeps`.

        Returns:
            The pulses that can be processed now, split where the stream breaks.

        Raises:
            TableError: the message holds no sweeps.
        """
        require_sweeps(sweeps.rows)
        if self.origin is None:
            self.origin = sweeps.stamp
        rows = usable_rows(sweeps.rows, self._health)
        if not len(rows):
            return []
        time = (sweeps.stamp - self.origin) / NANOSECONDS + rows["time_offset"]
        if self._is_late(float(time[0])):
            return []
        self._latest = float(time[-1])
        if not self._step:
            held = self._hold(rows, time)
            if held is None:
                return []
            rows, time = held
        return self._split(rows, time)

    def restart(self) -> None:
        """Forget the pulses before and what is known of the rotation."""
        self._held: list[tuple[npt.NDArray[np.void], FloatArray]] = []
        self._last: _Pulse | None = None
        self._latest = -np.inf
        self._step = self._period = 0.0
        self._advance, self._advanced = 0.0, 0

    def _is_late(self, time: float) -> bool:
        if time > self._latest:
            return False
        if self._latest - time <= max(self._period, 1.0):
            self._health.drop("sector repeated or out of order")
            return True
        self._health.drop("clock went back")
        self.restart()
        return False

    def _hold(
        self, rows: npt.NDArray[np.void], time: FloatArray
    ) -> tuple[npt.NDArray[np.void], FloatArray] | None:
        """Keep pulses until there are enough to tell the azimuth step from them."""
        if self._held and self._held[0][0].dtype != rows.dtype:
            self._health.drop("too few pulses of a layout", len(self._held))
            self._held = []
        self._held.append((rows, time))
        if sum(len(part) for part, _ in self._held) < FEWEST_PULSES:
            return None
        rows = np.concatenate([part for part, _ in self._held])
        time = np.concatenate([part for _, part in self._held])
        self._held = []
        step = _mean_step(rows["azimuth"])
        if step < _LEAST_STEP:
            self._health.drop("pulses while the antenna stands still or turns back", len(rows))
            return None
        self._step = step
        self._period = TWO_PI / step * (time[-1] - time[0]) / (len(time) - 1)
        return rows, time

    def _split(self, rows: npt.NDArray[np.void], time: FloatArray) -> list[Pulses]:
        """Cut pulses where they do not continue each other."""
        if self._last is not None and self._last.layout != rows.dtype:
            self._health.drop("stream broken by other range cells")
            self._last = None
        azimuth = rows["azimuth"].astype(np.float64)
        start, step = rows["range_start"], rows["range_step"]
        last = self._last or _Pulse(rows.dtype, azimuth[0], time[0], start[0], step[0])
        turn, pause = _advance(last.azimuth, azimuth), _advance(last.time, time)
        jumps = self._jumps(turn, pause)
        others = self._other_cells((start, last.range_start), (step, last.range_step))
        broken = np.unique(np.concatenate([jumps, others])) if len(jumps) or len(others) else jumps
        inner = broken[broken > 0]
        if len(inner) > _UNEVEN * len(rows):
            return self._lose("pulses whose azimuth or time advances unevenly", time)
        fresh = self._last is None or len(inner) < len(broken)
        if not self._follow(
            np.delete(turn, [0] * fresh + [*inner]) if fresh or len(inner) else turn
        ):
            return self._lose("pulses while the antenna stands still or turns back", time)
        self._last = _Pulse(rows.dtype, azimuth[-1], time[-1], start[-1], step[-1])
        video = self._envelope(rows["video"])
        return [
            Pulses(
                fresh=fresh or begin > 0,
                video=video[begin:end],
                azimuth=azimuth[begin:end],
                time=time[begin:end],
                range_start=float(start[begin]),
                range_step=float(step[begin]),
                azimuth_step=self._step,
            )
            for begin, end in pairwise([0, *inner, len(rows)])
        ]

    def _lose(self, reason: str, time: FloatArray) -> list[Pulses]:
        """Give up pulses and what was known of the rotation."""
        self._health.drop(reason, len(time))
        self.restart()
        self._latest = float(time[-1])
        return []

    def _jumps(self, turn: FloatArray, pause: FloatArray) -> npt.NDArray[np.intp]:
        """List the pulses at which azimuth or time does not go on; makes turns the shorter way around."""
        back, ahead = _BACK * self._step, _AHEAD * self._step
        longest = _PAUSE * self._period if self._period else np.inf
        if _within(turn, back, ahead) and _within(pause, 0.0, longest):
            return _NOWHERE
        turn -= TWO_PI * np.rint(turn / TWO_PI)
        jumped = (turn < back) | (turn > ahead) | (pause < 0.0) | (pause > longest)
        where = jumped.nonzero()[0]
        self._health.drop("stream broken by a gap or jump of azimuth or time", len(where))
        return where

    def _other_cells(self, *layouts: tuple[FloatArray, float]) -> npt.NDArray[np.intp]:
        """List the pulses whose range cells are not those of the pulse before: field and value before the pulses."""
        where = _NOWHERE
        for layout, before in layouts:
            if np.logical_or.reduce(layout != before):
                where = np.union1d(where, _advance(before, layout).nonzero()[0])
        self._health.drop("stream broken by other range cells", len(where))
        return where

    def _follow(self, turn: FloatArray) -> bool:
        """Average the azimuth step; tell whether the antenna turns at all."""
        self._advance += float(np.add.reduce(turn))
        self._advanced += len(turn)
        if self._advanced < FEWEST_PULSES:
            return True
        mean = self._advance / self._advanced
        if mean < _STANDING * self._step:
            return False
        share = min(1.0, self._advanced * self._step / (_LEARNING * TWO_PI))
        self._period *= self._step / (self._step + share * (mean - self._step))
        self._step += share * (mean - self._step)
        self._advance, self._advanced = 0.0, 0
        return True


def _advance(before: float, values: FloatArray) -> FloatArray:
    """Difference of each value to the one before it."""
    change = np.empty(len(values))
    np.subtract(values[1:], values[:-1], out=change[1:])
    change[0] = values[0] - before
    return change


def _within(values: FloatArray, low: float, high: float) -> bool:
    return bool(np.minimum.reduce(values) >= low and np.maximum.reduce(values) <= high)


def _mean_step(azimuth: FloatArray) -> float:
    """Mean step without lost pulses; also of an encoder that is coarser than the step."""
    turn = _advance(azimuth[0], azimuth)[1:]
    turn -= TWO_PI * np.rint(turn / TWO_PI)
    middle = float(np.median(turn))
    if middle <= 0.0:
        return float(turn.mean())
    return float(turn[(turn > -middle) & (turn < 1.5 * middle)].mean())
