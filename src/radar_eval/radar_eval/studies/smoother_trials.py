# SPDX-License-Identifier: Apache-2.0
"""One smoother on the plots of targets that fly alone: gates and misses as in the tracker, but no other plots."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from radar_common.frames import enu_covariance, enu_from_polar
from radar_eval.studies.smoother_flights import Plotted, Radar
from secondary_proc.motion import (
    noise_density,
    normalised_square,
    predict_position_covariance,
    two_point_state,
)
from secondary_proc.parameters import TrackerParameters
from secondary_proc.smoothing import SMOOTHERS, Measured

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]
IndexArray = npt.NDArray[np.intp]


@dataclass(frozen=True, slots=True)
class Trial:
    """What became of the plots.

    Attributes:
        state: smoothed at the plots that tracks took, NaN elsewhere, shape (turns, targets, 4).
        covariance: of the state, NaN likewise, shape (turns, targets, 4, 4).
        lost: plots that fell beside the gate of their own track, shape (turns, targets).
        opened: tracks that began with this plot, shape (turns, targets).
    """

    state: FloatArray
    covariance: FloatArray
    lost: BoolArray
    opened: BoolArray


class _Tracks:
    """One track a target, or none: a row each."""

    def __init__(self, targets: int, parameters: TrackerParameters) -> None:
        self._parameters = parameters
        self._quiet = noise_density(parameters.acceleration)
        self._manoeuvre = noise_density(parameters.manoeuvre_acceleration)
        self._smoother = SMOOTHERS[parameters.smoother](parameters)
        self.state = np.zeros((targets, 4))
        self.covariance = np.zeros((targets, 4, 4))
        self._memory = np.zeros(targets, self._smoother.memory)
        self._time = np.full(targets, -np.inf)
        self._hits = np.zeros(targets, np.int64)
        self._misses = np.zeros(targets, np.int64)

    def turn(
        self, time: FloatArray, found: BoolArray, plots: Plots
    ) -> tuple[IndexArray, IndexArray, IndexArray]:
        """Take one turn's plots; which targets' tracks took theirs, which lost it, which opened."""
        present = np.flatnonzero(found)
        tracked = present[self._hits[present] >= 2]
        inside = self._in_gate(tracked, time, plots)
        taking, losing = tracked[inside], tracked[~inside]
        self._update(taking, time, plots)
        opening = present[self._hits[present] == 1]
        self._open(opening, time, plots)
        first = present[self._hits[present] == 0]
        self.state[first, :2], self.covariance[first, :2, :2] = plots.at(first)
        self._hits[first], self._time[first] = 1, time[first]
        self._misses += 1
        self._misses[present] = 0
        self._misses[losing] += 1
        allowed = np.where(
            self._hits > 1, self._parameters.confirmed_misses, self._parameters.tentative_misses
        )
        self._hits[self._misses >= allowed] = 0
        return taking, losing, opening

    def _in_gate(self, which: IndexArray, time: FloatArray, plots: Plots) -> BoolArray:
        seconds = time[which] - self._time[which]
        position, error = plots.at(which)
        away = position - self.state[which, :2] - seconds[:, None] * self.state[which, 2:]
        spread = predict_position_covariance(self.covariance[which], seconds, self._manoeuvre)
        square, _ = normalised_square(away, spread + error)
        return np.asarray(square <= self._parameters.gate_sigmas**2)

    def _update(self, which: IndexArray, time: FloatArray, plots: Plots) -> None:
        self._hits[which] += 1
        position, error = plots.at(which)
        smoothed = self._smoother.update(
            Measured(
                state=self.state[which],
                covariance=self.covariance[which],
                memory=self._memory[which],
                hits=self._hits[which],
                seconds=time[which] - self._time[which],
                position=position,
                position_covariance=error,
                azimuth=plots.azimuth[which],
            )
        )
        self.state[which], self.covariance[which] = smoothed.state, smoothed.covariance
        self._memory[which] = smoothed.memory
        self._time[which] = time[which]

    def _open(self, which: IndexArray, time: FloatArray, plots: Plots) -> None:
        position, error = plots.at(which)
        self.state[which], self.covariance[which] = two_point_state(
            self.state[which, :2],
            self.covariance[which, :2, :2],
            position,
            error,
            time[which] - self._time[which],
            self._quiet,
        )
        self._memory[which] = np.zeros(1, self._smoother.memory)
        self._hits[which], self._time[which] = 2, time[which]


class Plots:
    """Plots of one turn as positions."""

    def __init__(self, ranges: FloatArray, azimuth: FloatArray, radar: Radar) -> None:
        """Convert.

        Args:
            ranges: m, shape (targets,).
            azimuth: rad, shape (targets,).
            radar: whose errors they have.
        """
        self.azimuth = azimuth
        self._position = np.stack(enu_from_polar(ranges, azimuth), axis=1)
        self._covariance = enu_covariance(
            ranges,
            azimuth,
            np.full(len(ranges), radar.range_std),
            np.full(len(ranges), radar.azimuth_std),
        )

    def at(self, which: IndexArray) -> tuple[FloatArray, FloatArray]:
        """Positions and covariances.

        Args:
            which: targets, shape (n,).

        Returns:
            Shapes (n, 2) and (n, 2, 2).
        """
        return self._position[which], self._covariance[which]


def track_alone(plotted: Plotted, radar: Radar, parameters: TrackerParameters) -> Trial:
    """Track every target for itself.

    Args:
        plotted: the plots.
        radar: that made them.
        parameters: of the tracker, the smoother among them.

    Returns:
        What became of the plots.
    """
    shape = plotted.time.shape
    state = np.full((*shape, 4), np.nan)
    covariance = np.full((*shape, 4, 4), np.nan)
    lost, opened = np.zeros((2, *shape), bool)
    tracks = _Tracks(shape[1], parameters)
    for turn, time in enumerate(plotted.time):
        plots = Plots(plotted.range[turn], plotted.azimuth[turn], radar)
        taking, losing, opening = tracks.turn(time, plotted.found[turn], plots)
        state[turn, taking] = tracks.state[taking]
        covariance[turn, taking] = tracks.covariance[taking]
        lost[turn, losing] = True
        opened[turn, opening] = True
    return Trial(state, covariance, lost, opened)
