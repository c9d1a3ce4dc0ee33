# SPDX-License-Identifier: Apache-2.0
"""Keeps the next passage of every track, calculated for many tracks at once and not before anything asks for it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from secondary_proc.motion import FloatArray, noise_density, predict_state
from secondary_proc.rotation import Rotation
from secondary_proc.schedule import passage
from secondary_proc.track_store import Columns, TrackStore

if TYPE_CHECKING:
    from secondary_proc.parameters import TrackerParameters

_SOON_ENOUGH = 0.25
"""Turns after a plot before the next passage is calculated; nothing can happen to its track sooner."""


class Timetable:
    """When the beam will pass the tracks of a store.

    Attributes:
        soonest: no miss is due before, seconds.
    """

    def __init__(
        self, store: TrackStore, parameters: TrackerParameters, rotation: Rotation
    ) -> None:
        """Calculate all passages.

        Args:
            store: of the tracks.
            parameters: size of gates.
            rotation: of the antenna.
        """
        self._store = store
        self._period = rotation.period
        self._rotation = rotation
        self._sigmas = parameters.gate_sigmas
        self._manoeuvre = noise_density(parameters.manoeuvre_acceleration)
        self._oldest_plot = np.inf
        self.soonest = np.inf
        self.calculate(store.live)

    def synchronise(self, now: float) -> None:
        """Date the last passages anew, after the rotation has been found again.

        Args:
            now: seconds, all plots before have been processed.
        """
        tracks = self._store.live
        moved = predict_state(tracks.state, now - tracks.time)[:, :2]
        tracks.crossing[:] = self._rotation.last_passage(np.arctan2(*moved.T), now)
        self._oldest_plot = self.soonest = np.inf
        self.calculate(tracks)

    def postpone(self, times: FloatArray) -> None:
        """Note that tracks with infinite schedules have been put into the store.

        Args:
            times: of their plots, seconds, shape (n,).
        """
        if len(times):
            self._oldest_plot = min(self._oldest_plot, float(times.min()))

    def catch_up(self, now: float) -> None:
        """Calculate the passages that were postponed, if it is time.

        Args:
            now: seconds.
        """
        if now > self._oldest_plot + _SOON_ENOUGH * self._period:
            live = self._store.live
            new = np.isinf(live.due).nonzero()[0]
            columns = live.take(new)
            self.calculate(columns)
            live.schedule[:, new] = columns.schedule
            self._oldest_plot = np.inf

    def calculate(self, tracks: Columns) -> None:
        """Calculate the next passages.

        Args:
            tracks: changed.
        """
        following, margin = passage(
            tracks.state,
            tracks.covariance,
            tracks.time,
            tracks.crossing,
            period=self._period,
            sense=self._rotation.sense,
            sigmas=self._sigmas,
            noise_density=self._manoeuvre,
        )
        tracks.expected[:] = following
        tracks.opens[:] = following - margin
        tracks.due[:] = due = following + margin
        self.soonest = min(self.soonest, float(due.min(initial=np.inf)))
