# SPDX-License-Identifier: Apache-2.0
"""Two targets that nearness has made one group of bursts are taken apart again, where the signal shows two.

Three rules, each of which only looks at groups that a point target would hardly give:
a group longer in azimuth than a target of its strength is cut where its signal has a valley between two maxima;
bursts in such a group whose azimuths contradict each other are different targets;
a group of three rings or more is cut at a ring that is weak between two strong ones.
A group that is an extended echo anyway stays as it is.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from primary_proc.estimators.azimuth_estimator import Centres
from primary_proc.estimators.envelopes import Envelopes
from primary_proc.plots.ring_merge import Groups
from primary_proc.plots.signal_valley import Valleys, signal_valleys
from radar_common.antenna_pattern import PATTERNS

FloatArray = npt.NDArray[np.float64]

_ALPHA = np.linspace(0.0, 3.0, 301)
_LONGER = 1.25
_MORE = 3.0
_SURE = 4.0
_COMPARABLE = 0.1
_SPLIT_ERROR = 0.125


class Extents(NamedTuple):
    """How far groups of bursts reach.

    Attributes:
        begin: first start, shape (groups,).
        length: pulses from there to the last end, shape (groups,).
        nearest: nearest ring, shape (groups,).
        rings: rings from there to the farthest, shape (groups,).
        cut: not zero where a burst was cut off by its limit, shape (groups,).
    """

    begin: npt.NDArray[np.int64]
    length: npt.NDArray[np.int64]
    nearest: npt.NDArray[np.int64]
    rings: npt.NDArray[np.int64]
    cut: npt.NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class Targets:
    """Bursts ordered by target.

    Attributes:
        groups: the bursts; one that covers two targets is there twice.
        centres: azimuth of each burst.
        burst: which of the bursts given each one is, shape (n,).
        size: bursts of each target, shape (targets,).
        extents: of each target.
    """

    groups: Groups
    centres: Centres
    burst: npt.NDArray[np.intp]
    size: npt.NDArray[np.int64]
    extents: Extents


class TargetSeparator:
    """Takes groups of bursts apart.

    Attributes:
        target_rings: most rings that a target fills.
        longest: limit of a burst's length, in pulses.
    """

    def __init__(
        self,
        pattern: str,
        pulses: float,
        threshold: float,
        target_rings: int,
        longest: int,
        valley_db: float,
    ) -> None:
        """Work out how long the burst of a target is.

        Args:
            pattern: antenna pattern's name.
            pulses: N_0.
            threshold: power over the mean noise power that makes a one.
            target_rings: most rings that a target fills.
            longest: limit of a burst's length, in pulses.
            valley_db: how far the signal falls between two targets, in dB.
        """
        shape = np.minimum.accumulate(PATTERNS[pattern](_ALPHA))
        self._power = np.log(threshold / np.maximum(shape, 1e-9) ** 2)
        self._width = pulses * _ALPHA
        self._pulses, self.target_rings = pulses, target_rings
        self.longest = longest
        self._valley = 10.0 ** (valley_db / 10.0)

    def separate(self, groups: Groups, centres: Centres, envelopes: Envelopes) -> Targets:
        """Take apart what is more than one target.

        Args:
            groups: bursts, powers filled in; at least one.
            centres: azimuth of each burst.
            envelopes: the stored signal.

        Returns:
            The targets.
        """
        bursts, first = groups.bursts, groups.first
        burst = np.arange(len(bursts))
        size = np.concatenate([first[1:], [len(bursts)]]) - first
        extents = _extents(bursts, first)
        whole = self.of_a_target(extents)
        ring, power = bursts["ring"], bursts["power"]
        width = np.interp(np.log(np.maximum.reduceat(power, first)), self._power, self._width)
        long = whole & (extents.length > _LONGER * width + _MORE)
        wide = whole & (extents.rings > 2)
        any_long, any_wide = np.logical_or.reduce(long), np.logical_or.reduce(wide)
        if not (any_long or any_wide):
            return Targets(groups, centres, burst, size, extents)

        group = np.repeat(np.arange(len(first)), size)
        label, position, std = group, centres.position, centres.std
        if any_long:
            strongest = _strongest(group, power)[first[long]]
            begin, last = extents.begin[long], (extents.begin + extents.length)[long]
            valleys = signal_valleys(
                envelopes, ring[strongest], begin, last, self._pulses, self._valley
            )
            if valleys.deep.any():
                burst, label, place = _cut(bursts, group, np.flatnonzero(long), valleys)
                inside = np.isnan(place)
                position = np.where(inside, position[burst], place)
                std = np.where(inside, std[burst], _SPLIT_ERROR * self._pulses)
            label = self._by_azimuth(label, long[group[burst]], position, std, power[burst])
        if any_wide:
            label = self._in_range(label, wide[group[burst]], ring[burst], power[burst])
        if label is group:
            return Targets(groups, centres, burst, size, extents)
        order = np.argsort(label, kind="stable")
        burst, label = burst[order], label[order]
        bursts, first = bursts[burst], np.flatnonzero(np.diff(label, prepend=-1))
        return Targets(
            Groups(bursts, first),
            Centres(position[order], std[order]),
            burst,
            np.diff(first, append=len(bursts)),
            _extents(bursts, first),
        )

    def of_a_target(self, extents: Extents) -> npt.NDArray[np.bool_]:
        """Tell which groups are no larger than a target; others are extended echoes.

        Args:
            extents: of the groups.

        Returns:
            Shape (groups,).
        """
        small = (extents.rings <= self.target_rings) & (extents.length <= self.longest)
        return np.asarray(small & (extents.cut == 0))

    def _by_azimuth(
        self,
        label: npt.NDArray[np.int64],
        rows: npt.NDArray[np.bool_],
        position: FloatArray,
        std: FloatArray,
        power: npt.NDArray[np.float32],
    ) -> npt.NDArray[np.int64]:
        """Part from the strongest burst those almost as strong that lie elsewhere beyond doubt."""
        strongest = _strongest(label, power)
        apart = position - position[strongest]
        doubt = np.maximum(self._pulses / 2.0, _SURE * np.hypot(std, std[strongest]))
        elsewhere = rows & (np.abs(apart) > doubt) & (power > _COMPARABLE * power[strongest])
        if not elsewhere.any():
            return label
        return 3 * label + np.where(elsewhere, np.where(apart > 0.0, 2, 1), 0)

    def _in_range(
        self,
        label: npt.NDArray[np.int64],
        rows: npt.NDArray[np.bool_],
        ring: npt.NDArray[np.int32],
        power: npt.NDArray[np.float32],
    ) -> npt.NDArray[np.int64]:
        """Cut at the ring that is weakest against the strongest rings to both sides."""
        if not rows.any():
            return label
        found, target = np.unique(label[rows], return_inverse=True)
        nearest = np.full(len(found), np.iinfo(np.int32).max)
        np.minimum.at(nearest, target, ring[rows])
        column = ring[rows] - nearest[target]
        profile = np.zeros((len(found), self.target_rings))
        np.maximum.at(profile, (target, column), power[rows])
        near = np.maximum.accumulate(profile, axis=1)
        far = np.maximum.accumulate(profile[:, ::-1], axis=1)[:, ::-1]
        depth = np.minimum(near, far) / np.maximum(profile, 1.0)
        bottom = depth.argmax(axis=1)
        each = np.arange(len(found))
        deep = depth[each, bottom] >= self._valley
        if not deep.any():
            return label
        # What is seen in the valley belongs to the stronger of the rings beside it.
        inner = np.clip(bottom, 1, self.target_rings - 2)
        first_beyond = bottom + (profile[each, inner - 1] >= profile[each, inner + 1])
        beyond = np.zeros(len(label), np.int64)
        beyond[rows] = deep[target] & (column >= first_beyond[target])
        return 3 * label + beyond


def _extents(bursts: npt.NDArray[np.void], first: npt.NDArray[np.int64]) -> Extents:
    """Measure groups; the largest is the smallest with its sign changed, so that one call does."""
    ends = np.empty((len(bursts), 5), np.int64)
    ends[:, 0], ends[:, 1] = bursts["start"], bursts["ring"]
    np.negative(bursts["end"], out=ends[:, 2])
    np.negative(ends[:, 1], out=ends[:, 3])
    np.negative(bursts["overflow"], out=ends[:, 4], dtype=np.int64)
    begin, nearest, last, farthest, cut = np.minimum.reduceat(ends, first).T
    return Extents(begin, -last - begin, nearest, 1 - farthest - nearest, cut)


def _strongest(
    label: npt.NDArray[np.int64], power: npt.NDArray[np.float32]
) -> npt.NDArray[np.intp]:
    """Give for each burst the index of the strongest with its label."""
    order = np.lexsort((power, label))
    ordered = label[order]
    return order[np.searchsorted(ordered, label, side="right") - 1]


def _cut(
    bursts: npt.NDArray[np.void],
    group: npt.NDArray[np.int64],
    long: npt.NDArray[np.intp],
    valleys: Valleys,
) -> tuple[npt.NDArray[np.intp], npt.NDArray[np.int64], FloatArray]:
    """Cut groups at valleys.

    Returns:
        (burst, label, place): the bursts, those over a valley twice, the side they are on, and the maximum of the
        signal there for those whose own middle says nothing any more, NaN for others.
    """
    which = np.full(int(group[-1]) + 1, -1)
    which[long[valleys.deep]] = np.flatnonzero(valleys.deep)
    valley = which[group]
    cut = valley >= 0
    over = (
        cut & (bursts["start"] <= valleys.bottom[valley]) & (bursts["end"] > valleys.bottom[valley])
    )
    burst = np.concatenate([np.arange(len(bursts)), np.flatnonzero(over)])
    second = np.arange(len(burst)) >= len(bursts)
    after = cut & (bursts["start"] > valleys.bottom[valley])
    side = after[burst] | second
    maximum = np.where(side, valleys.after[valley[burst]], valleys.before[valley[burst]])
    return burst, 3 * group[burst] + side, np.where(over[burst], maximum, np.nan)
