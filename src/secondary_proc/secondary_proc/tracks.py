# SPDX-License-Identifier: Apache-2.0
"""The life of tracks: opened by two plots, smoothed, confirmed, coasting, ended."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from radar_common.health import Health
from radar_common.tables import TRACK, EndReason
from secondary_proc import track_table
from secondary_proc.association.soft import Contest
from secondary_proc.detection import DetectionByRange
from secondary_proc.gates import Gated, gate, narrow_gates, usual_gates
from secondary_proc.gating import SharpTurns
from secondary_proc.initiation import INITIATIONS
from secondary_proc.motion import FloatArray, noise_density
from secondary_proc.opening import opened_tracks
from secondary_proc.passages import ENDED, TENTATIVE, judge, take_misses, take_plots
from secondary_proc.plots import Plots
from secondary_proc.rotation import Rotation
from secondary_proc.smoothing import SMOOTHERS
from secondary_proc.timetable import Timetable
from secondary_proc.track_store import PREDICTED_ROWS, Columns, TrackStore

if TYPE_CHECKING:
    from secondary_proc.parameters import TrackerParameters

IndexArray = npt.NDArray[np.intp]
Rows = npt.NDArray[np.void]

END_REASONS = tuple(reason.name.lower().replace("_", " ") for reason in EndReason)
FASTEST_REVISIT = 0.5
"""Turns of the antenna between two plots of one target at least."""


class Tracks:
    """All tracks and what can happen to them; every method returns the rows to publish.

    Attributes:
        detection: probability of a plot, as confirmed tracks have shown it.
        initiation: the rule that judges tentative tracks.
        next_id: first id that was never given out.
        period: of the antenna, as the tracks were scheduled by it, seconds.
    """

    def __init__(self, parameters: TrackerParameters, rotation: Rotation, health: Health) -> None:
        """Start without tracks.

        Args:
            parameters: how to track.
            rotation: of the antenna, read at every step.
            health: where events are counted.
        """
        self._health = health
        self.next_id = 1
        self._missed_until = -np.inf
        self.detection = DetectionByRange(parameters)
        self._store = TrackStore(np.dtype(float))
        self.reconfigure(parameters, rotation)

    def reconfigure(self, parameters: TrackerParameters, rotation: Rotation) -> None:
        """Go on with the same tracks after a change of parameters or of the antenna's period.

        Args:
            parameters: how to track from now on.
            rotation: of the antenna.
        """
        self._parameters = parameters
        self.detection.reconfigure(parameters)
        self._rotation = rotation
        self.period = rotation.period
        self._quiet = noise_density(parameters.acceleration)
        self._manoeuvre = noise_density(parameters.manoeuvre_acceleration)
        self._sharp = SharpTurns(parameters.sharp_turn_rate, self._manoeuvre, self.period)
        self.initiation = INITIATIONS[parameters.initiation](parameters)
        self._smoother = SMOOTHERS[parameters.smoother](parameters)
        self._store.set_memory(self._smoother.memory)
        self._timetable = Timetable(self._store, parameters, rotation)

    def synchronise(self, now: float) -> None:
        """Date the last passages anew, after the rotation has been found again.

        Args:
            now: seconds, all plots before have been processed.
        """
        self._timetable.synchronise(now)

    def resume(self, rows: Rows, next_id: int, origin: float, place: tuple[float, float]) -> None:
        """Go on with the tracks of another tracker.

        Args:
            rows: dtype TRACK, in the map, one of each track.
            next_id: first id that was never given out.
            origin: tracker's time of the rows' stamp, seconds.
            place: of the radar in the map, metres east and north.
        """
        new = track_table.columns(
            rows, origin=origin, place=place, period=self.period, memory=self._smoother.memory
        )
        self._store.append(new)
        self.next_id = max(next_id, int(new.id.max(initial=0)) + 1)
        self._timetable.postpone(new.time)

    def present(self) -> Rows:
        """Rows of the confirmed and coasting tracks, each at its last plot, in the radar's frame."""
        tracks = self._store.live
        return track_table.rows(tracks.take((tracks.status != TENTATIVE).nonzero()[0]))

    def __len__(self) -> int:
        """Number of tracks, tentative ones included."""
        return len(self._store)

    def is_confirmed(self, tracks: IndexArray) -> npt.NDArray[np.bool_]:
        """Tell which tracks have been confirmed, coasting or not.

        Args:
            tracks: indices, shape (n,).

        Returns:
            Shape (n,).
        """
        return self._store.live.status.take(tracks) != TENTATIVE

    def gate(self, plots: Plots) -> Gated:
        """Find the plots in the gates of the tracks that the beam may find now.

        Args:
            plots: of one slice of time, not empty, in order of time.

        Returns:
            Pairs of track and plot.
        """
        begin, last = float(plots.time[0]), float(plots.time[-1])
        self._timetable.catch_up(last)
        tracks = self._store.live
        shortest = FASTEST_REVISIT * self.period
        # Where rotation and misses stand still, as after a long silence, the age alone must end a track's claims.
        longest = (self._parameters.confirmed_misses + 1) * self.period
        expected = tracks.time <= last - shortest
        expected &= tracks.due >= max(begin - longest, self._missed_until)
        if self._rotation.locked:
            expected &= tracks.opens <= last
        chosen = expected.nonzero()[0]
        predicted = tracks.numbers[:PREDICTED_ROWS].take(chosen, axis=1)
        sigmas = self._parameters.gate_sigmas
        confirmed, misses = tracks.status[chosen] != TENTATIVE, tracks.misses[chosen]
        density = self._sharp.densities(predicted, confirmed, misses)
        gated = gate(predicted, plots, sigmas=sigmas, noise_density=density, shortest=shortest)
        gated = usual_gates(gated, predicted, density, plots, sigmas, self._manoeuvre)
        if self._parameters.gate_shape == "three_sizes":
            straight = confirmed & (misses == 0)
            gated = narrow_gates(gated, predicted, straight, plots, sigmas, self._quiet)
        gated.track = chosen.take(gated.track)
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
        settled = (columns.status != TENTATIVE).nonzero()[0]
        self.detection.observe(plots.range[settled], columns.misses[settled])
        if contest is not None:
            plots = contest.soften(columns, plots, self._quiet)
        take_plots(columns, plots, gain, self._smoother)
        if contest is not None:
            contest.widen(columns)
        self._health.count("plots in tracks", len(tracks))
        rows, ended = self._judged(columns, threshold)
        self._timetable.postpone(plots.time)
        self._store.put(tracks, columns)
        if ended:
            self._bury()
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
        columns = opened_tracks(first, second, self._quiet, self._smoother.memory)
        columns.id[:] = self.next_id + np.arange(count)
        columns.rule[:] = self.initiation.opened(gap)
        columns.score[:] = columns.best[:] = scores
        self.next_id += count
        self._health.count("tracks opened", count)
        opened = track_table.first_rows(track_table.rows(columns), first)
        judged, ended = self._judged(columns, threshold)
        self._timetable.postpone(second.time)
        self._store.append(columns)
        if ended:
            self._bury()
        return np.concatenate([opened, judged], dtype=TRACK)

    def miss(self, until: float, *, wait: float = 0.0) -> list[Rows]:
        """Count a miss for every track that the beam has passed without a plot.

        Args:
            until: seconds, all plots before have been processed.
            wait: how long the first of them may wait for others, to be told at once, seconds.

        Returns:
            Rows of these tracks, predicted to the passage.
        """
        self._missed_until = max(self._missed_until, until)
        self._timetable.catch_up(until)
        out: list[Rows] = []
        if self._timetable.soonest + wait >= until:
            return out
        while len(late := (self._store.live.due < until).nonzero()[0]):
            columns = self._store.take(late)
            tentative = take_misses(columns, self._parameters, self.detection)
            unsure = int(np.count_nonzero(tentative))
            self._health.count("misses of confirmed tracks", len(late) - unsure)
            if unsure:
                self._judge(columns, tentative, found=False, threshold=np.inf)
            self._timetable.calculate(columns)
            out.append(track_table.rows(columns, at=columns.crossing, noise_density=self._quiet))
            self._store.put(late, columns)
            self._bury()
        self._timetable.soonest = float(self._store.live.due.min(initial=np.inf))
        return out

    def end_all(self) -> Rows:
        """End every track where it was seen last, because time went back.

        Returns:
            Their rows.
        """
        tracks = self._store.live
        tracks.status[:], tracks.reason[:] = ENDED, EndReason.TIME_WENT_BACK
        rows = track_table.rows(tracks, at=tracks.time.copy(), noise_density=self._quiet)
        self._bury()
        self._missed_until = -np.inf
        return rows

    def _judged(self, columns: Columns, threshold: float) -> tuple[Rows, int]:
        tentative = columns.status == TENTATIVE
        unsure = int(np.count_nonzero(tentative))
        self._health.count("plots of confirmed tracks", len(columns) - unsure)
        ended = 0
        if unsure:
            self._judge(columns, tentative, found=True, threshold=threshold)
            ended = int(np.count_nonzero(columns.status == ENDED))
        return track_table.rows(columns), ended

    def _judge(
        self,
        columns: Columns,
        tentative: npt.NDArray[np.bool_],
        *,
        found: bool,
        threshold: float,
    ) -> None:
        confirmed = judge(columns, tentative, self.initiation, found=found, threshold=threshold)
        self._health.count("tracks confirmed", confirmed)

    def _bury(self) -> None:
        tracks = self._store.live
        ended = tracks.status == ENDED
        if np.count_nonzero(ended):
            for reason, number in enumerate(np.bincount(tracks.reason[ended]).tolist()):
                if number:
                    self._health.count(f"tracks ended: {END_REASONS[reason]}", number)
            self._store.remove(ended)
