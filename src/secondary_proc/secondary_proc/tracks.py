# SPDX-License-Identifier: Apache-2.0
"""The life of tracks: opened by two plots, smoothed, confirmed, coasting, ended."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from radar_common.health import Health
from radar_common.tables import TRACK
from secondary_proc import track_table
from secondary_proc.association.soft import Contest
from secondary_proc.gates import Gated, gate
from secondary_proc.initiation import INITIATIONS
from secondary_proc.initiation.interface import HitGain
from secondary_proc.motion import FloatArray, noise_density, predict_state
from secondary_proc.opening import first_state
from secondary_proc.passages import ENDED, TENTATIVE, judge, take_misses, take_plots
from secondary_proc.plots import Plots
from secondary_proc.rotation import Rotation
from secondary_proc.schedule import passage
from secondary_proc.smoothing import SMOOTHERS
from secondary_proc.track_store import Columns, TrackStore

if TYPE_CHECKING:
    from secondary_proc.parameters import TrackerParameters

IndexArray = npt.NDArray[np.intp]
Rows = npt.NDArray[np.void]

FASTEST_REVISIT = 0.5
"""Turns of the antenna between two plots of one target at least."""


class Tracks:
    """All tracks and what can happen to them; every method returns the rows to publish."""

    def __init__(self, parameters: TrackerParameters, rotation: Rotation, health: Health) -> None:
        """Start without tracks.

        Args:
            parameters: how to track.
            rotation: of the antenna, read at every step.
            health: where events are counted.
        """
        self._health = health
        self._next_id = 1
        self._soonest = np.inf
        self._store = TrackStore(np.dtype(float))
        self.reconfigure(parameters, rotation)

    def reconfigure(self, parameters: TrackerParameters, rotation: Rotation) -> None:
        """Go on with the same tracks after a change of parameters or of the antenna's period.

        Args:
            parameters: how to track from now on.
            rotation: of the antenna.
        """
        self._parameters = parameters
        self._rotation = rotation
        self.period = rotation.period
        self._quiet = noise_density(parameters.acceleration)
        self._manoeuvre = noise_density(parameters.manoeuvre_acceleration)
        self._initiation = INITIATIONS[parameters.initiation](parameters)
        self._smoother = SMOOTHERS[parameters.smoother](parameters)
        self._store.set_memory(self._smoother.memory)
        self._schedule_all()

    def synchronise(self, now: float) -> None:
        """Date the last passages anew, after the rotation has been found again.

        Args:
            now: seconds, all plots before have been processed.
        """
        store = self._store
        moved = predict_state(store["state"], now - store["time"])[:, :2]
        store["crossing"][:] = self._rotation.last_passage(np.arctan2(*moved.T), now)
        self._schedule_all()

    def __len__(self) -> int:
        """Number of tracks, tentative ones included."""
        return len(self._store)

    @property
    def longest_gap(self) -> int:
        """Turns of the antenna that may lie between the first two plots of a track."""
        return self._initiation.longest_gap

    @property
    def hit_gain(self) -> HitGain | None:
        """What any plot in a gate adds to the score, None where its place in the gate counts."""
        return self._initiation.hit_gain

    def is_confirmed(self, tracks: IndexArray) -> npt.NDArray[np.bool_]:
        """Tell which tracks have been confirmed, coasting or not.

        Args:
            tracks: indices, shape (n,).

        Returns:
            Shape (n,).
        """
        return self._store["status"][tracks] != TENTATIVE

    def gate(self, plots: Plots) -> Gated:
        """Find the plots in the gates of the tracks that the beam may find now.

        Args:
            plots: of one slice of time, not empty, in order of time.

        Returns:
            Pairs of track and plot.
        """
        store, last = self._store, plots.time[-1]
        shortest = FASTEST_REVISIT * self.period
        # Where rotation and misses stand still, as after a long silence, the age alone must end a track's claims.
        longest = (self._parameters.confirmed_misses + 1) * self.period
        expected = (store["time"] <= last - shortest) & (store["due"] >= plots.time[0] - longest)
        if self._rotation.locked:
            expected &= store["opens"] <= last
        gated = gate(
            store,
            expected.nonzero()[0],
            plots,
            sigmas=self._parameters.gate_sigmas,
            noise_density=self._manoeuvre,
            shortest=shortest,
            narrow=self._quiet if self._parameters.gate_shape == "three_sizes" else None,
        )
        self._health.drop("tracks beyond the limit of neighbours", gated.skipped)
        return gated

    def update(
        self,
        tracks: IndexArray,
        plots: Plots,
        gain: FloatArray,
        threshold: float,
        contest: Contest | None = None,
    ) -> Rows:
        """Give tracks their plots.

        Args:
            tracks: indices, each once, shape (n,).
            plots: their plots, n of them.
            gain: of the score, shape (n,).
            threshold: score of confirmation.
            contest: other plots that may be theirs, None where each takes its one plot for sure.

        Returns:
            Rows of these tracks.
        """
        columns = self._store.take(tracks)
        if contest is not None:
            plots = contest.soften(columns, plots, self._quiet)
        take_plots(columns, plots, gain, self._smoother)
        if contest is not None:
            contest.widen(columns)
        self._health.count("plots in tracks", len(tracks))
        rows = self._after_plot(columns, threshold)
        self._store.put(tracks, columns)
        self._bury(columns)
        return rows

    def open(
        self, first: Plots, second: Plots, gap: IndexArray, scores: FloatArray, threshold: float
    ) -> Rows:
        """Open tracks, each with two plots.

        Args:
            first: earlier plots, n of them.
            second: later plots, n of them.
            gap: turns of the antenna between them, shape (n,).
            scores: of the pairs, shape (n,).
            threshold: score of confirmation.

        Returns:
            Two rows of each new track, one for each of its plots.
        """
        room = max(self._parameters.maximum_tracks - len(self._store), 0)
        self._health.drop("candidates over the limit of tracks", max(len(first) - room, 0))
        best = np.sort(np.argsort(-scores, kind="stable")[:room])
        first, second, gap, scores = first[best], second[best], gap[best], scores[best]
        count = len(first)
        columns = first_state(first, second, self._quiet) | {
            "id": self._next_id + np.arange(count),
            "memory": np.zeros(count, self._smoother.memory),
            "rule": self._initiation.opened(gap),
            "score": scores,
            "best": scores,
        }
        tracks = self._store.append(columns, count)
        self._next_id += count
        self._health.count("tracks opened", count)
        new = self._store.take(tracks)
        opened = track_table.first_rows(track_table.rows(new), first)
        judged = self._after_plot(new, threshold)
        self._store.put(tracks, new)
        self._bury(new)
        return np.concatenate([opened, judged], dtype=TRACK)

    def miss(self, until: float) -> list[Rows]:
        """Count a miss for every track that the beam has passed without a plot.

        Args:
            until: seconds, all plots before have been processed.

        Returns:
            Rows of these tracks, predicted to the passage.
        """
        store, out = self._store, []
        detection, allowed = (
            self._parameters.detection_probability,
            self._parameters.confirmed_misses,
        )
        while self._soonest < until and len(late := (store["due"] < until).nonzero()[0]):
            columns = store.take(late)
            tentative = take_misses(columns, allowed, detection)
            unsure = int(np.count_nonzero(tentative))
            self._health.count("misses of confirmed tracks", len(late) - unsure)
            if unsure:
                self._judge(columns, tentative, found=False, threshold=np.inf)
            self._schedule(columns)
            out.append(track_table.rows(columns, at=columns.crossing, noise_density=self._quiet))
            store.put(late, columns)
            self._bury(columns)
        self._soonest = store["due"].min(initial=np.inf)
        return out

    def end_all(self) -> Rows:
        """End every track where it was seen last.

        Returns:
            Their rows.
        """
        columns = self._store.take(np.arange(len(self)))
        columns.status[:] = ENDED
        rows = track_table.rows(columns, at=columns.time.copy(), noise_density=self._quiet)
        self._store.put(np.arange(len(self)), columns)
        self._bury(columns)
        return rows

    def _after_plot(self, columns: Columns, threshold: float) -> Rows:
        self._schedule(columns)
        tentative = columns.status == TENTATIVE
        unsure = int(np.count_nonzero(tentative))
        self._health.count("plots of confirmed tracks", len(columns) - unsure)
        if unsure:
            self._judge(columns, tentative, found=True, threshold=threshold)
        return track_table.rows(columns)

    def _judge(
        self,
        columns: Columns,
        tentative: npt.NDArray[np.bool_],
        *,
        found: bool,
        threshold: float,
    ) -> None:
        confirmed = judge(columns, tentative, self._initiation, found=found, threshold=threshold)
        self._health.count("tracks confirmed", confirmed)

    def _schedule(self, columns: Columns) -> None:
        following, margin = passage(
            columns.state,
            columns.covariance,
            columns.time,
            columns.crossing,
            period=self.period,
            sense=self._rotation.sense,
            sigmas=self._parameters.gate_sigmas,
            noise_density=self._manoeuvre,
        )
        columns.expected[:] = following
        columns.opens[:] = following - margin
        columns.due[:] = due = following + margin
        self._soonest = min(self._soonest, due.min(initial=np.inf))

    def _schedule_all(self) -> None:
        everything = np.arange(len(self))
        columns = self._store.take(everything)
        self._soonest = np.inf
        self._schedule(columns)
        self._store.put(everything, columns)

    def _bury(self, changed: Columns) -> None:
        if np.count_nonzero(changed["status"] == ENDED):
            ended = self._store["status"] == ENDED
            self._health.count("tracks ended", int(np.count_nonzero(ended)))
            self._store.remove(ended)
