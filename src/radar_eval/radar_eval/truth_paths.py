# SPDX-License-Identifier: Apache-2.0
"""The paths of the targets, to be asked for any time, and for when the antenna looked at them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from radar_common.frames import TWO_PI, enu_from_polar, polar_from_enu, wrap_pi
from radar_eval.antenna import Rotation
from radar_eval.bag_tables import TimedRows

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]

# A row of truth at the very end of a path, measured as the antenna passed, may lie this far before it by jitter.
_END_TOLERANCE = 0.03


@dataclass(frozen=True, slots=True)
class Looks:
    """Passes of the antenna over the targets: the chances of a plot.

    Attributes:
        target: index of the target, shape (n,).
        time: seconds, shape (n,).
        range: metres, shape (n,).
        azimuth: radians in [0, 2 pi), shape (n,).
    """

    target: IntArray
    time: FloatArray
    range: FloatArray
    azimuth: FloatArray

    def __len__(self) -> int:
        """Count the passes."""
        return len(self.target)

    def __getitem__(self, index: npt.NDArray[np.bool_]) -> Looks:
        """Select passes."""
        return Looks(self.target[index], self.time[index], self.range[index], self.azimuth[index])


class TruthPaths:
    """Rows of truth as one path a target, straight between its rows."""

    def __init__(self, truth: TimedRows, *, longest_gap: float) -> None:
        """Sort the rows by target.

        Args:
            truth: rows of dtype TRUTH.
            longest_gap: seconds; where two rows of a target lie further apart, it counts as absent between them.
        """
        good = np.isfinite(truth.time) & np.isfinite(truth.rows["range"])
        rows, time = truth.rows[good], truth.time[good]
        order = np.lexsort((time, rows["id"]))
        self.rows = rows[order]
        self.time = time[order]
        self.ids, self._first, self.target = np.unique(
            self.rows["id"], return_index=True, return_inverse=True
        )
        self._longest_gap = longest_gap
        self._span = 1.0 + (float(np.ptp(self.time)) if len(self.time) else 0.0)
        self._start = float(self.time.min()) if len(self.time) else 0.0
        self._keys = self._key(self.target, self.time)
        self._turned = self._unwrap(self.rows["azimuth"])
        self.begin = self.time[self._first]
        self.end = self.time[np.append(self._first[1:], len(self.time))[: len(self.ids)] - 1]

    def __len__(self) -> int:
        """Count the targets."""
        return len(self.ids)

    def columns_at(
        self, target: IntArray, time: FloatArray, *names: str
    ) -> tuple[npt.NDArray[np.bool_], dict[str, FloatArray]]:
        """Interpolate columns of the truth that are linear enough for it: x, y, vx, vy.

        Args:
            target: indices of targets, shape (n,).
            time: seconds, shape (n,).
            names: columns.

        Returns:
            (present, values): whether the target was there, shape (n,), and each column, shape (n,).
        """
        before, after, share, present = self._bracket(target, time)
        return present, {
            name: (1.0 - share) * self.rows[name][before] + share * self.rows[name][after]
            for name in names
        }

    def polar_at(
        self, target: IntArray, time: FloatArray
    ) -> tuple[npt.NDArray[np.bool_], FloatArray, FloatArray]:
        """Interpolate the position as the radar sees it, along the chord between two rows.

        Args:
            target: indices of targets, shape (n,).
            time: seconds, shape (n,).

        Returns:
            (present, range, azimuth): whether the target was there, metres, radians in [0, 2 pi), each shape (n,).
        """
        before, after, share, present = self._bracket(target, time)
        ends = [
            enu_from_polar(self.rows["range"][i], self.rows["azimuth"][i]) for i in (before, after)
        ]
        x, y = ((1.0 - share) * ends[0][axis] + share * ends[1][axis] for axis in (0, 1))
        return present, *polar_from_enu(x, y)

    def looks(self, rotation: Rotation) -> Looks:
        """Find the times at which the antenna passed each target.

        Args:
            rotation: of the antenna, in the seconds of the truth.

        Returns:
            The passes between the first and the last row of each target, without gaps.
        """
        turns = (rotation.angle(self.time) - self._turned) / TWO_PI
        first = np.ceil(turns[self._first] - _END_TOLERANCE)
        last_row = np.append(self._first[1:], len(self.time))[: len(self.ids)] - 1
        number = np.floor(turns[last_row] + _END_TOLERANCE) - first + 1.0
        number = np.maximum(number, 0.0).astype(np.int64)
        target = np.repeat(np.arange(len(self.ids)), number)
        counted = np.arange(len(target)) - np.repeat(np.cumsum(number) - number, number)
        passes = np.repeat(first, number) + counted
        low = float(turns.min()) - 1.0 if len(turns) else 0.0
        span = (float(np.ptp(turns)) if len(turns) else 0.0) + 3.0
        rising = np.maximum.accumulate(self.target * span + turns - low)
        key = np.interp(target * span + passes - low, rising, self._keys)
        time = np.clip(
            key - target * self._span + self._start, self.begin[target], self.end[target]
        )
        present, distance, azimuth = self.polar_at(target, time)
        return Looks(target, time, distance, azimuth)[present]

    def rows_near(self, target: IntArray, time: FloatArray) -> FloatArray:
        """Distance in time to the nearest row of a target.

        Args:
            target: indices of targets, shape (n,).
            time: seconds, shape (n,).

        Returns:
            Seconds, shape (n,).
        """
        before, after, _, _ = self._bracket(target, time)
        return np.minimum(np.abs(time - self.time[before]), np.abs(time - self.time[after]))

    def _key(self, target: IntArray, time: FloatArray) -> FloatArray:
        # One rising number for (target, time), so that one search serves all targets.
        return target * self._span + (time - self._start)

    def _unwrap(self, azimuth: FloatArray) -> FloatArray:
        steps = wrap_pi(np.diff(azimuth, prepend=azimuth[:1]))
        steps[self._first] = 0.0
        turned = np.cumsum(steps)
        return turned - turned[self._first][self.target] + azimuth[self._first][self.target]

    def _bracket(
        self, target: IntArray, time: FloatArray
    ) -> tuple[IntArray, IntArray, FloatArray, npt.NDArray[np.bool_]]:
        inside = np.clip(time, self.begin[target], self.end[target])
        after = np.searchsorted(self._keys, self._key(target, inside), side="left")
        after = np.minimum(after, len(self._keys) - 1)
        # The search may round to a neighbour's row at either end of a path.
        after = np.where(self.target[after] == target, after, after - 1)
        earlier = np.maximum(after - 1, 0)
        before = np.where(self.target[earlier] == target, earlier, after)
        gap = self.time[after] - self.time[before]
        share = np.divide(inside - self.time[before], gap, out=np.zeros_like(gap), where=gap > 0.0)
        share = np.clip(share, 0.0, 1.0)
        on_row = (share == 0.0) | (share == 1.0)
        present = (np.abs(inside - time) < 1e-6) & (on_row | (gap <= self._longest_gap))
        return before, after, share, present
