# SPDX-License-Identifier: Apache-2.0
"""The tracker: plots in, tracks out, sector by sector."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from radar_common.health import Health
from radar_common.tables import PLOT, SITE_FRAME, TRACK, Table
from secondary_proc import score
from secondary_proc.association import ASSOCIATIONS, SOFT, GateGraph
from secondary_proc.association.soft import Contest
from secondary_proc.clutter import FalsePlotDensity
from secondary_proc.gates import Gated
from secondary_proc.gating import SelectionWatch
from secondary_proc.initiation.strength import StrengthRatio
from secondary_proc.parameters import TrackerParameters
from secondary_proc.plot_queue import PlotQueue
from secondary_proc.plots import AZIMUTH, STRENGTH, TIME, FloatArray, Plots
from secondary_proc.rotation import Rotation
from secondary_proc.starts import Annulus, Starts
from secondary_proc.tracks import Tracks

Rows = npt.NDArray[np.void]

_LONGEST_SLICE = 0.25
"""Turns of the antenna that are associated at once when a message brings more."""
_COMPETITORS = 1 / 32
_RESTART = 5.0
_CHANGE = 0.003
_WATCHED = 64
"""Of so many slices of time one is looked at to tell how surely plots are selected."""
_SECONDS_PER_HOUR = 3600.0
_NO_ROWS = np.zeros(0, TRACK)


class Tracker:
    """Turns plots into tracks."""

    def __init__(self, parameters: TrackerParameters, health: Health | None = None) -> None:
        """Start without tracks.

        Args:
            parameters: how to track.
            health: where events are counted; None for a new one.
        """
        self.parameters = parameters
        self.health = health if health is not None else Health()
        self._begin()
        self._tracks = Tracks(parameters, self._rotation, self.health)

    def reconfigure(self, parameters: TrackerParameters) -> None:
        """Go on with other parameters and the same tracks.

        Args:
            parameters: how to track from now on.
        """
        self.parameters = parameters
        self._tracks.reconfigure(parameters, self._rotation)
        self._prepare()

    @property
    def period(self) -> float:
        """Seconds a turn of the antenna, as estimated at present."""
        return self._tracks.period

    def process(self, plots: Table) -> Table:
        """Take in one message.

        Args:
            plots: dtype PLOT, possibly empty: its stamp alone tells that time has passed.

        Returns:
            Every track that got a plot, missed one, or ended; a track may stand in it more than once.

        Raises:
            TypeError: the table holds no plots.
        """
        if plots.rows.dtype != PLOT:
            raise TypeError(f"the tracker takes plots, not {plots.rows.dtype}")
        out: list[Rows] = []
        stamp = self._queue.seconds(plots.stamp)
        if stamp < self._queue.now - _RESTART * self._rotation.period:
            self.health.drop("time went back: all tracks ended")
            out.append(self._tracks.end_all())
            self._begin()
            self._tracks.reconfigure(self.parameters, self._rotation)
        elapsed = max(stamp - self._queue.now, 0.0) if np.isfinite(self._queue.now) else 0.0
        self._clutter.forget(elapsed / self._rotation.period)
        if self._strength is not None:
            self._strength.forget(elapsed / self._rotation.period)
        accepted = self._queue.put(plots, self.parameters, self._rotation.period)
        self.health.count("plots in", len(accepted))
        locks = self._rotation.locks
        if len(accepted):
            self._rotation.observe(accepted[:, TIME], accepted[:, AZIMUTH])
        if abs(self._rotation.period / self._tracks.period - 1.0) > _CHANGE:
            self._tracks.reconfigure(self.parameters, self._rotation)
        if self._rotation.locks > locks:
            self._tracks.synchronise(self._queue.begin)
        self._drain(out)
        return self._table(out, plots.stamp)

    def flush(self) -> Table:
        """Process what still waits for competitors, as no message will follow.

        Returns:
            The last tracks.
        """
        out: list[Rows] = []
        self._drain(out, everything=True)
        return self._table(out, self._queue.last_stamp)

    def _begin(self) -> None:
        self._queue = PlotQueue(self.health)
        self._rotation = Rotation(self.parameters.scan_period)
        self._clutter = FalsePlotDensity(self.parameters.maximum_range)
        self._starts = Starts()
        self._strength: StrengthRatio | None = None
        self._slices = 0
        self._prepare()

    def _prepare(self) -> None:
        parameters = self.parameters
        if not parameters.amplitude_likelihood:
            self._strength = None
        elif self._strength is None:
            self._strength = StrengthRatio()
        self._selection = SelectionWatch(parameters.gate_sigmas, parameters.detection_probability)

    def _drain(self, out: list[Rows], *, everything: bool = False) -> None:
        period = self._tracks.period
        while (
            taken := self._queue.take(
                _LONGEST_SLICE * period, _COMPETITORS * period, everything=everything
            )
        ) is not None:
            rows, ripe = taken
            self._miss(min(rows[0, TIME], self._queue.now), out)
            self._work(Plots.from_queue(rows), rows, ripe, out)
        self._miss(self._queue.now, out)

    def _miss(self, until: float, out: list[Rows]) -> None:
        if self._rotation.tells_passages(self._queue.now):
            out.extend(self._tracks.miss(until))

    def _work(self, plots: Plots, rows: FloatArray, ripe: int, out: list[Rows]) -> None:
        gated = self._tracks.gate(plots)
        strange = self._strength.ratio(rows[:, STRENGTH]) if self._strength is not None else None
        unclaimed = np.ones(ripe, bool)
        untracked = np.ones(ripe, bool)
        if len(gated.track):
            density = self._clutter.per_area(plots.range[gated.plot])
            if strange is not None:
                density *= strange[gated.plot]
            gain = self._gain(gated, density)
            confirmed = self._tracks.is_confirmed(gated.track)
            edges = self._choose(gated, gain, density, confirmed, ripe)
            plot = gated.plot[edges]
            now = plot < ripe
            unclaimed[plot[now]] = False
            untracked[plot[now & confirmed[edges]]] = False
            if len(edges):
                self._slices += 1
                if self._slices % _WATCHED == 0:
                    self._look(gated, gain, density, edges[confirmed[edges]])
                gains = self._score_gain(gated, gain, density, edges)
                contest = self._contest(gated, gain, confirmed, edges, plots)
                tracks, taken = gated.track[edges], plots[plot]
                out.append(self._tracks.update(tracks, taken, gains, self._threshold(), contest))
                self._queue.take_also(plot[~now] - ripe)
        self._clutter.observe(plots.range[:ripe][untracked])
        if self._strength is not None:
            self._strength.observe(rows[:ripe, STRENGTH], ~untracked)
        if unclaimed.any():
            few = strange[:ripe][unclaimed] if strange is not None else None
            self._open(plots[:ripe][unclaimed], few, out)

    def _gain(self, gated: Gated, density: FloatArray) -> FloatArray:
        return score.hit(
            self.parameters.detection_probability,
            gated.distance_squared,
            gated.determinant,
            density,
        )

    def _score_gain(
        self, gated: Gated, gain: FloatArray, density: FloatArray, edges: npt.NDArray[np.intp]
    ) -> FloatArray:
        by_hits = self._tracks.hit_gain
        if by_hits is None:
            return gain[edges]
        return by_hits(gated.determinant[edges], density[edges])

    def _contest(
        self,
        gated: Gated,
        gain: FloatArray,
        confirmed: npt.NDArray[np.bool_],
        edges: npt.NDArray[np.intp],
        plots: Plots,
    ) -> Contest | None:
        if self.parameters.association not in SOFT:
            return None
        weight = gain - score.miss(self.parameters.detection_probability)
        return Contest(gated, weight, confirmed, edges, plots)

    def _look(
        self, gated: Gated, gain: FloatArray, density: FloatArray, taken: npt.NDArray[np.intp]
    ) -> None:
        weight = gain - score.miss(self.parameters.detection_probability)
        self._selection.observe(gated.track, weight, density, gated.determinant, taken)

    def _choose(
        self,
        gated: Gated,
        gain: FloatArray,
        density: FloatArray,
        confirmed: npt.NDArray[np.bool_],
        ripe: int,
    ) -> npt.NDArray[np.intp]:
        weight = gain - score.miss(self.parameters.detection_probability)
        # In a gate so wide that a false plot is likelier than the target's, a miss is the better guess.
        # After misses a gate is kilometres wide; there a plot must be nearer than chance would bring a false one.
        strangers = score.false_plots_nearer(gated.distance_squared, gated.determinant, density)
        likely = np.flatnonzero((weight > 0.0) & (strangers < self.parameters.false_plots_nearer))
        edges = likely[
            ASSOCIATIONS[self.parameters.association](
                GateGraph(
                    gated.track[likely],
                    gated.plot[likely],
                    weight[likely],
                    gated.distance_squared[likely],
                    confirmed[likely],
                )
            )
        ]
        early = gated.plot[edges] >= ripe
        if not np.count_nonzero(early):
            return edges
        # A track that only plots still to come can interest waits for their competitors.
        urgent = np.zeros(len(self._tracks), bool)
        urgent[gated.track[gated.plot < ripe]] = True
        return edges[urgent[gated.track[edges]]]

    def _open(self, plots: Plots, strange: FloatArray | None, out: list[Rows]) -> None:
        parameters, gap = self.parameters, self._tracks.longest_gap
        period = self._tracks.period
        self._starts.forget(plots.time[0] - (gap + 0.5) * period)
        if self._rotation.known:
            annulus = Annulus(
                parameters.minimum_speed, parameters.maximum_speed, parameters.gate_sigmas, gap
            )
            pairs = self._starts.pair(plots, period, annulus)
            self.health.drop("first plots beyond the limit of neighbours", pairs.skipped)
            if len(pairs.start):
                second = plots[pairs.plot]
                density = self._clutter.per_area(second.range)
                if strange is not None:
                    density *= strange[pairs.plot]
                scores = score.second_plot(
                    parameters.detection_probability, pairs.area, density, pairs.gap - 1
                )
                first = self._starts.plots[pairs.start]
                out.append(self._tracks.open(first, second, pairs.gap, scores, self._threshold()))
        lost = self._starts.add(plots, parameters.maximum_plots)
        self.health.drop("first plots over the limit", lost)

    def _threshold(self) -> float:
        per_hour = self._clutter.per_scan * _SECONDS_PER_HOUR / self._tracks.period
        return score.confirmation_threshold(per_hour, self.parameters.false_tracks_per_hour)

    def _table(self, out: list[Rows], stamp: int) -> Table:
        # Of equal dtypes; naming it spares numpy a promotion that costs more than the copy.
        rows = np.concatenate([_NO_ROWS, *out], dtype=TRACK) if len(out) != 1 else out[0]
        if len(rows):
            rows["time_offset"] -= self._queue.seconds(stamp)
            rows["x"] += self.parameters.radar_x
            rows["y"] += self.parameters.radar_y
            rows["z"] += self.parameters.radar_z
            self._watch()
        return Table(stamp, rows, SITE_FRAME)

    def _watch(self) -> None:
        counts = self.health.counts
        found = counts["plots of confirmed tracks"]
        passed = found + counts["misses of confirmed tracks"]
        if passed:
            self.health.watch(
                "plots per passage of a confirmed track",
                self.parameters.detection_probability,
                found / passed,
            )
        if (shares := self._selection.shares) is not None:
            self.health.watch("plots of confirmed tracks that are their own", *shares)
        if self._rotation.known:
            hint = self.parameters.scan_period or self._rotation.period
            self.health.watch("scan period, s", hint, self._rotation.period)
