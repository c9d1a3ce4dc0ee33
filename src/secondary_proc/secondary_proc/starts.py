# SPDX-License-Identifier: Apache-2.0
"""Plots that may be the first of a target, and their pairing with later plots in the annulus of possible speeds.

Source: Kuzmin 1967, § 4.3.1: every plot in the annulus opens a candidate of its own.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from secondary_proc.motion import quadratic_form, trace
from secondary_proc.neighbours import neighbour_pairs
from secondary_proc.plots import PLOT_ROWS, Plots

FloatArray = npt.NDArray[np.float64]
IndexArray = npt.NDArray[np.intp]

_MOST_NEIGHBOURS = 4_000_000


@dataclass(frozen=True, slots=True)
class Annulus:
    """Where the second plot of a target may lie.

    Attributes:
        minimum_speed: m/s.
        maximum_speed: m/s.
        sigmas: by how many standard deviations of the plots' errors both circles are widened.
        longest_gap: turns of the antenna after which a first plot is given up.
    """

    minimum_speed: float
    maximum_speed: float
    sigmas: float
    longest_gap: int


@dataclass(frozen=True, slots=True)
class Pairs:
    """First and second plots of candidates, one row each.

    Attributes:
        start: index of the first plot among the starts, shape (n,).
        plot: index of the second plot, shape (n,).
        gap: turns of the antenna between them, shape (n,).
        area: of the annulus, m^2, shape (n,).
        skipped: starts not looked at because there were too many neighbours.
    """

    start: IndexArray
    plot: IndexArray
    gap: IndexArray
    area: FloatArray
    skipped: int


class Starts:
    """First plots of possible tracks."""

    def __init__(self) -> None:
        """Start without plots."""
        self.plots = Plots(np.zeros((PLOT_ROWS, 0)))
        self._continued: IndexArray = np.zeros(0, np.intp)

    def add(self, plots: Plots, limit: int) -> int:
        """Remember plots.

        Args:
            plots: that no track took.
            limit: of the number remembered; the newest stay.

        Returns:
            Number of plots given up because of the limit.
        """
        both = np.concatenate([self.plots.values, plots.values], axis=1)[:, -limit:]
        lost = len(self.plots) + len(plots) - both.shape[1]
        self.plots = Plots(both)
        self._continued = np.concatenate([self._continued, np.zeros(len(plots), np.intp)])[-limit:]
        return lost

    def forget(self, before: float) -> None:
        """Give up plots that nothing can continue any more.

        Args:
            before: seconds.
        """
        if len(self.plots) and self.plots.time[0] < before:
            kept = self.plots.time >= before
            self.plots = self.plots[kept]
            self._continued = self._continued[kept]

    def pair(self, plots: Plots, period: float, annulus: Annulus) -> Pairs:
        """Find first plots in whose annulus new plots lie.

        A start that has found its second plot in one turn of the antenna takes no other in a later one.

        Args:
            plots: new ones.
            period: of the antenna, seconds.
            annulus: where they may lie.

        Returns:
            Every pair that is possible.
        """
        first = self.plots
        none = np.zeros(0, np.intp)
        if not len(first) or not len(plots):
            return Pairs(none, none, none, np.zeros(0), 0)
        ripe = np.flatnonzero(first.time <= plots.time[-1] - period / 2)
        if not len(ripe):
            return Pairs(none, none, none, np.zeros(0), 0)
        widest = np.sqrt(trace(plots.covariance).max() + trace(first.covariance[ripe]).max())
        longest = min(plots.time[-1] - first.time[ripe].min(), (annulus.longest_gap + 0.5) * period)
        radius = annulus.maximum_speed * longest + annulus.sigmas * widest
        plot, start, skipped = neighbour_pairs(
            plots.position, first.position[ripe], float(radius), _MOST_NEIGHBOURS
        )
        start = ripe[start]
        seconds = plots.time[plot] - first.time[start]
        gap = np.rint(seconds / period).astype(np.intp)
        inside = (gap >= 1) & (gap <= annulus.longest_gap)
        inside &= (self._continued[start] == 0) | (self._continued[start] == gap)
        start, plot, gap, seconds = start[inside], plot[inside], gap[inside], seconds[inside]
        shift = plots.position[plot] - first.position[start]
        distance = np.hypot(shift[:, 0], shift[:, 1])
        direction = shift / np.maximum(distance, 1e-9)[:, None]
        error = plots.covariance[plot] + first.covariance[start]
        variance = quadratic_form(direction, error)
        slack = annulus.sigmas * np.sqrt(np.maximum(variance, 0.0))
        outer = annulus.maximum_speed * seconds + slack
        inner = np.maximum(annulus.minimum_speed * seconds - slack, 0.0)
        inside = (distance <= outer) & (distance >= inner)
        area = np.pi * (outer**2 - inner**2)
        self._continued[start[inside]] = gap[inside]
        return Pairs(start[inside], plot[inside], gap[inside], area[inside], skipped)
