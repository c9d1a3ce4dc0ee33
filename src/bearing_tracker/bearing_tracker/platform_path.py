# SPDX-License-Identifier: Apache-2.0
"""Where the platform was when a bearing was taken: fixes in, positions at any time out."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from radar_common.health import Health

FloatArray = npt.NDArray[np.float64]

FIX = np.dtype([("time", "<f8"), ("position", "<f8", (3,)), ("variance", "<f8"), ("piece", "<i8")])

_MOST_FIXES = 20_000
_FARTHEST = 1e8
_SLACK = 10.0
"""Metres that noise alone may move a fix."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Limits:
    """What is believed of a platform's path.

    Attributes:
        gap: longest time between two fixes to interpolate in, seconds.
        ahead: longest time after the last fix to extrapolate, seconds.
        speed: a fix that only a faster platform could reach is a jump, m/s.
        memory: seconds of the past that are kept.
    """

    gap: float
    ahead: float
    speed: float
    memory: float


@dataclass(frozen=True, slots=True)
class Places:
    """Positions at some times.

    Attributes:
        known: whether the path tells the position, shape (n,).
        position: metres east, north, up, shape (n, 3); NaN where not known.
        variance: of east and of north, m^2, shape (n,); zero where the fixes tell none.
    """

    known: npt.NDArray[np.bool_]
    position: FloatArray
    variance: FloatArray


class PlatformPath:
    """The platform's fixes of the last time, in order, in pieces between which it jumped."""

    def __init__(self, limits: Limits, health: Health) -> None:
        """Start without a fix.

        Args:
            limits: what is believed.
            health: where refused fixes are counted.
        """
        self.limits = limits
        self._health = health
        self._fixes = np.zeros(64, FIX)
        self._size = 0
        self._suspect: np.void | None = None

    @property
    def end(self) -> float:
        """Time of the last fix in seconds, -inf before the first."""
        return float(self._fixes["time"][self._size - 1]) if self._size else -np.inf

    def put(self, time: float, position: tuple[float, float, float], variance: float = 0.0) -> None:
        """Take in a fix; one that is known already, too old or out of reach is dropped and counted.

        Args:
            time: seconds.
            position: metres east, north, up.
            variance: of east and of north, m^2, 0 if not known.
        """
        if not (np.isfinite(position).all() and np.abs(position).max() <= _FARTHEST):
            self._health.drop("fixes that are nowhere")
            return
        if time <= self.end - self.limits.memory:
            self._health.drop("fixes older than the path")
            return
        fix = np.zeros(1, FIX)[0]
        fix["time"], fix["position"], fix["variance"] = time, position, variance
        place = int(np.searchsorted(self._fixes["time"][: self._size], time))
        if place == self._size:
            self._append(fix)
        elif self._fixes["time"][place] == time:
            self._health.drop("fixes of a time that has one")
        else:
            self._insert(place, fix)

    def at(self, times: FloatArray) -> Places:
        """Tell where the platform was.

        Args:
            times: seconds, shape (n,).

        Returns:
            Interpolated between the fixes before and after, extrapolated a little way after the last.
        """
        fixes = self._fixes[: self._size]
        if self._size < 2:
            # One fix tells nothing of any other time.
            exact = np.isin(times, fixes["time"])
            position = np.full((len(times), 3), np.nan)
            position[exact] = fixes["position"]
            return Places(exact, position, np.where(exact, fixes["variance"].sum(), 0.0))
        after = np.clip(np.searchsorted(fixes["time"], times, side="left"), 1, self._size - 1)
        earlier, later = fixes[after - 1], fixes[after]
        interval = later["time"] - earlier["time"]
        whole = (interval <= self.limits.gap) & (earlier["piece"] == later["piece"])
        inside = (times >= earlier["time"]) & (times <= later["time"] + self.limits.ahead)
        # A fix is true at its own time, whatever gap or jump lies beside it.
        on_earlier, on_later = times == earlier["time"], times == later["time"]
        known = (whole & inside) | on_earlier | on_later
        share = np.where(on_earlier, 0.0, (times - earlier["time"]) / interval)
        share = np.where(on_later, 1.0, share)
        position = earlier["position"] + share[:, None] * (later["position"] - earlier["position"])
        weight = np.clip(share, 0.0, 1.0)
        variance = (1.0 - weight) * earlier["variance"] + weight * later["variance"]
        return Places(
            known, np.where(known[:, None], position, np.nan), np.where(known, variance, 0.0)
        )

    def _append(self, fix: np.void) -> None:
        if not self._size or self._reaches(self._fixes[self._size - 1], fix):
            if self._suspect is not None:
                self._health.drop("fixes that jump")
                self._suspect = None
            fix["piece"] = self._fixes["piece"][self._size - 1] if self._size else 0
            self._write(self._size, fix)
        elif self._suspect is None:
            self._suspect = fix
        elif self._suspect["time"] != fix["time"] and self._reaches(self._suspect, fix):
            # One fix elsewhere is an error; a second one beside it means that the platform is there now.
            self._health.count("jumps of the platform")
            pair = sorted((self._suspect, fix), key=lambda item: float(item["time"]))
            piece = self._fixes["piece"][self._size - 1] + 1
            self._suspect = None
            for one in pair:
                one["piece"] = piece
                self._write(self._size, one)
        else:
            self._health.drop("fixes that jump")
            self._suspect = fix

    def _insert(self, place: int, fix: np.void) -> None:
        beside = self._fixes[max(place - 1, 0) : place + 1]
        fitting = [one for one in beside if self._reaches(one, fix)]
        whole = beside["piece"][0] == beside["piece"][-1]
        # Between two pieces a fix belongs to the one it fits; within a piece it must fit both neighbours.
        if not fitting or (whole and len(fitting) < len(beside)):
            self._health.drop("fixes that jump")
            return
        fix["piece"] = fitting[0]["piece"]
        self._write(place, fix)

    def _reaches(self, known: np.void, fix: np.void) -> bool:
        away = float(np.linalg.norm(fix["position"] - known["position"]))
        return away <= self.limits.speed * abs(float(fix["time"] - known["time"])) + _SLACK

    def _write(self, place: int, fix: np.void) -> None:
        self._fixes[place + 1 : self._size + 1] = self._fixes[place : self._size]
        self._fixes[place] = fix
        self._size += 1
        if self._size < len(self._fixes):
            return
        kept = self._fixes["time"] > self.end - self.limits.memory
        kept[: self._size - _MOST_FIXES] &= self._size <= _MOST_FIXES
        remaining = self._fixes[kept]
        self._size = len(remaining)
        self._fixes = np.zeros(max(2 * self._size, 64), FIX)
        self._fixes[: self._size] = remaining
