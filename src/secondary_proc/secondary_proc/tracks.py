# SPDX-License-Identifier: Apache-2.0
"""The life of tracks: opened by two plots, smoothed, confirmed, coasting, ended."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from radar_common.health import Health
from radar_common.tables import TRACK, TrackStatus
from secondary_proc import score, track_table
from secondary_proc.gates import Gated, gate
from secondary_proc.initiation import INITIATIONS, Evidence
from secondary_proc.motion import FloatArray, noise_density, predict_state
from secondary_proc.opening import first_state
from secondary_proc.plots import Plots
from secondary_proc.rotation import Rotation
from secondary_proc.schedule import passage
from secondary_proc.smoothing import SMOOTHERS, Measured
from secondary_proc.track_store import TrackStore

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
        self._initiation = INITIATIONS[parameters.initiation](
            parameters.confirm_hits, parameters.confirm_window, parameters.tentative_misses
        )
        self._smoother = SMOOTHERS[parameters.smoother](
            parameters.acceleration, parameters.manoeuvre_acceleration
        )
        self._store.set_memory(self._smoother.memory)
        self._schedule(np.arange(len(self)))

    def synchronise(self, now: float) -> None:
        """Date the last passages anew, after the rotation has been found again.

        Args:
            now: seconds, all plots before have been processed.
        """
        store = self._store
        moved = predict_state(store["state"], now - store["time"])[:, :2]
        store["crossing"][:] = self._rotation.last_passage(np.arctan2(*moved.T), now)
        self._schedule(np.arange(len(store)))

    def __len__(self) -> int:
        """Number of tracks, tentative ones included."""
        return len(self._store)

    @property
    def longest_gap(self) -> int:
        """Turns of the antenna that may lie between the first two plots of a track."""
        return self._initiation.longest_gap

    def is_confirmed(self, tracks: IndexArray) -> npt.NDArray[np.bool_]:
        """Tell which tracks have been confirmed, coasting or not.

        Args:
            tracks: indices, shape (n,).

        Returns:
            Shape (n,).
        """
        return self._store["status"][tracks] != TrackStatus.TENTATIVE

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
            np.flatnonzero(expected),
            plots,
            sigmas=self._parameters.gate_sigmas,
            noise_density=self._manoeuvre,
            shortest=shortest,
        )
        self._health.drop("tracks beyond the limit of neighbours", gated.skipped)
        return gated

    def update(self, tracks: IndexArray, plots: Plots, gain: FloatArray, threshold: float) -> Rows:
        """Give tracks their plots.

        Args:
            tracks: indices, each once, shape (n,).
            plots: their plots, n of them.
            gain: of the score, shape (n,).
            threshold: score of confirmation.

        Returns:
            Rows of these tracks.
        """
        store = self._store
        hits = store["hits"][tracks] + 1
        smoothed = self._smoother.update(
            Measured(
                state=store["state"][tracks],
                covariance=store["covariance"][tracks],
                memory=store["memory"][tracks],
                hits=hits,
                seconds=plots.time - store["time"][tracks],
                position=plots.position,
                position_covariance=plots.covariance,
                azimuth=plots.azimuth,
            )
        )
        status = store["status"][tracks]
        status[status == TrackStatus.COASTING] = TrackStatus.CONFIRMED
        for name, values in (
            ("state", smoothed.state),
            ("covariance", smoothed.covariance),
            ("memory", smoothed.memory),
            ("hits", hits),
            ("misses", 0),
            ("time", plots.time),
            ("crossing", plots.time),
            ("plot_range", plots.range),
            ("plot_azimuth", plots.azimuth),
            ("score", store["score"][tracks] + gain),
            ("status", status),
        ):
            store[name][tracks] = values
        store["best"][tracks] = np.maximum(store["best"][tracks], store["score"][tracks])
        self._health.count("plots in tracks", len(tracks))
        return self._after_plot(tracks, threshold)

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
        opened = track_table.first_rows(self._rows(tracks), first)
        return np.concatenate([opened, self._after_plot(tracks, threshold)], dtype=TRACK)

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
        while len(late := np.flatnonzero(store["due"] < until)):
            status = store["status"][late]
            tentative = status == TrackStatus.TENTATIVE
            store["misses"][late] += 1
            store["score"][late] += score.miss(detection)
            store["crossing"][late] = store["expected"][late]
            spent = score.is_spent(store["best"][late], store["score"][late], allowed, detection)
            worn = spent | (store["misses"][late] >= allowed)
            status[~tentative] = np.where(worn, TrackStatus.ENDED, TrackStatus.COASTING)[~tentative]
            store["status"][late] = status
            self._health.count("misses of confirmed tracks", int(np.count_nonzero(~tentative)))
            self._judge(late[tentative], found=False, threshold=np.inf)
            self._schedule(late)
            out.append(self._rows(late, at=store["crossing"][late]))
            self._bury()
        return out

    def end_all(self) -> Rows:
        """End every track where it was seen last.

        Returns:
            Their rows.
        """
        self._store["status"][:] = TrackStatus.ENDED
        rows = self._rows(np.arange(len(self)), at=self._store["time"].copy())
        self._bury()
        return rows

    def _after_plot(self, tracks: IndexArray, threshold: float) -> Rows:
        self._schedule(tracks)
        tentative = ~self.is_confirmed(tracks)
        self._health.count("plots of confirmed tracks", int(np.count_nonzero(~tentative)))
        if tentative.any():
            self._judge(tracks[tentative], found=True, threshold=threshold)
        rows = self._rows(tracks)
        self._bury()
        return rows

    def _judge(self, tracks: IndexArray, *, found: bool, threshold: float) -> None:
        store = self._store
        verdict = self._initiation.judge(
            Evidence(
                rule=store["rule"][tracks],
                found=np.full(len(tracks), found),
                hits=store["hits"][tracks],
                misses=store["misses"][tracks],
                score=store["score"][tracks],
                threshold=threshold,
            )
        )
        store["rule"][tracks] = verdict.rule
        store["status"][tracks[verdict.confirmed]] = TrackStatus.CONFIRMED
        store["status"][tracks[verdict.dropped]] = TrackStatus.ENDED
        self._health.count("tracks confirmed", int(np.count_nonzero(verdict.confirmed)))

    def _schedule(self, tracks: IndexArray) -> None:
        store = self._store
        following, margin = passage(
            store["state"][tracks],
            store["covariance"][tracks],
            store["time"][tracks],
            store["crossing"][tracks],
            period=self.period,
            sense=self._rotation.sense,
            sigmas=self._parameters.gate_sigmas,
            noise_density=self._manoeuvre,
        )
        store["expected"][tracks] = following
        store["opens"][tracks] = following - margin
        store["due"][tracks] = following + margin

    def _rows(self, tracks: IndexArray, at: FloatArray | None = None) -> Rows:
        return track_table.rows(self._store, tracks, at=at, noise_density=self._quiet)

    def _bury(self) -> None:
        ended = self._store["status"] == TrackStatus.ENDED
        if ended.any():
            self._health.count("tracks ended", int(np.count_nonzero(ended)))
            self._store.remove(ended)
