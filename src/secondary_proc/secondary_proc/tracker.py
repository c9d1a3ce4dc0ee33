# SPDX-License-Identifier: Apache-2.0
"""The tracker: plots in, tracks out, sector by sector."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from radar_common.health import Health
from radar_common.tables import PLOT, SITE_FRAME, TRACK, Table
from secondary_proc import score
from secondary_proc.association import SOFT
from secondary_proc.association.soft import Contest
from secondary_proc.choice import Pairs
from secondary_proc.clutter import FalsePlotDensity
from secondary_proc.gating import SelectionWatch
from secondary_proc.handover import Handover
from secondary_proc.initiation.strength import StrengthRatio
from secondary_proc.parameters import TrackerParameters
from secondary_proc.plot_queue import PlotQueue
from secondary_proc.plots import AZIMUTH, TIME, FloatArray, Plots
from secondary_proc.rotation import Rotation
from secondary_proc.starts import Annulus, Starts
from secondary_proc.tracks import Tracks
from secondary_proc.watching import watch

Rows = npt.NDArray[np.void]

_LONGEST_SLICE = 0.25
"""Turns of the antenna that are associated at once when a message brings more."""
_COMPETITORS = 1 / 32
_RESTART = 5.0
_CHANGE = 0.003
_GATHERED_MISSES = 1 / 16
"""Turns over which misses are gathered, to be told at once."""
_WATCHED = 0.25
"""Turns between two looks at what diagnostics show."""
_LOOKED_AT = 64
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
        self._watched = -np.inf
        self._begin()
        self._tracks = Tracks(parameters, self._rotation, self.health)

    def reconfigure(self, parameters: TrackerParameters) -> None:
        """Go on with other parameters and the same tracks.

        Args:
            parameters: how to track from now on.
        """
        self.parameters = parameters
        self._queue.reconfigure(parameters)
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
        if plots.rows.dtype is not PLOT and plots.rows.dtype != PLOT:
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
        self._tracks.detection.forget(elapsed / self._rotation.period)
        if self._strength is not None:
            self._strength.forget(elapsed / self._rotation.period)
        accepted = self._queue.put(plots, self._rotation.period)
        self.health.count("plots in", accepted.shape[1])
        locks = self._rotation.locks
        self._rotation.observe(accepted[TIME], accepted[AZIMUTH])
        if abs(self._rotation.period / self._tracks.period - 1.0) > _CHANGE:
            self._tracks.reconfigure(self.parameters, self._rotation)
        if self._rotation.locks > locks:
            self._tracks.synchronise(self._queue.begin)
        # Where messages are short, misses may wait for those of the next ones.
        self._drain(out, gather=elapsed < _GATHERED_MISSES * self._rotation.period)
        return self._table(out, plots.stamp)

    def resume(self, handover: Handover) -> None:
        """Go on with the tracks of another tracker, as if messages had been lost since its last.

        Args:
            handover: what it left.

        Raises:
            RuntimeError: messages have been processed already.
        """
        parameters, rows = self.parameters, handover.alive()
        origin = self._queue.start(handover.tracks.stamp)
        self._rotation = Rotation(parameters.scan_period or handover.period)
        self._tracks.reconfigure(parameters, self._rotation)
        place = (parameters.radar_x, parameters.radar_y)
        next_id = max(handover.next_id, int(handover.tracks.rows["id"].max(initial=0)) + 1)
        self._tracks.resume(rows, next_id, origin, place)
        self.health.count("tracks resumed", len(rows))

    def handover(self) -> Handover:
        """What another tracker needs to go on.

        Returns:
            Confirmed and coasting tracks, each at its last plot.
        """
        stamp = self._queue.last_stamp
        table = self._finished([self._tracks.present()], stamp)
        period = self._rotation.period if self._rotation.known else 0.0
        return Handover(table, self._tracks.next_id, period)

    def flush(self) -> Table:
        """Process what still waits for competitors, as no message will follow.

        Returns:
            The last tracks.
        """
        out: list[Rows] = []
        self._drain(out, everything=True)
        self._watched = -np.inf
        return self._table(out, self._queue.last_stamp)

    def _begin(self) -> None:
        self._queue = PlotQueue(self.parameters, self.health)
        self._rotation = Rotation(self.parameters.scan_period)
        self._clutter = FalsePlotDensity(
            self.parameters.maximum_range, mapped=self.parameters.false_plot_map
        )
        self._starts = Starts()
        self._strength: StrengthRatio | None = None
        self._slices = 0
        self._prepare()

    def _prepare(self) -> None:
        parameters = self.parameters
        self._clutter.mapped = parameters.false_plot_map
        if not parameters.amplitude_likelihood:
            self._strength = None
        elif self._strength is None:
            self._strength = StrengthRatio()
        self._selection = SelectionWatch(parameters.gate_sigmas, parameters.detection_probability)

    def _drain(self, out: list[Rows], *, everything: bool = False, gather: bool = False) -> None:
        period = self._tracks.period
        while (
            taken := self._queue.take(
                _LONGEST_SLICE * period, _COMPETITORS * period, everything=everything
            )
        ) is not None:
            values, ripe = taken
            self._miss(min(float(values[TIME, 0]), self._queue.now), out, gather=gather)
            self._work(Plots(values), ripe, out)
        self._miss(self._queue.now, out, gather=gather)

    def _miss(self, until: float, out: list[Rows], *, gather: bool) -> None:
        if self._rotation.tells_passages(self._queue.now):
            wait = _GATHERED_MISSES * self._rotation.period if gather else 0.0
            out.extend(self._tracks.miss(until, wait=wait))

    def _work(self, plots: Plots, ripe: int, out: list[Rows]) -> None:
        gated = self._tracks.gate(plots)
        strange = self._strength.ratio(plots.strength) if self._strength is not None else None
        unclaimed = np.ones(len(plots), bool)
        untracked = np.ones(len(plots), bool)
        if len(gated.track):
            density = self._clutter.per_area(plots.range, plots.azimuth)
            if strange is not None:
                density *= strange
            pairs = Pairs.judged(
                gated,
                density.take(gated.plot),
                self._detection(plots.range, gated.plot),
                self._tracks.is_confirmed(gated.track),
            )
            edges = pairs.ready(pairs.choose(self.parameters), ripe, len(self._tracks))
            if len(edges):
                out.append(self._give(plots, pairs, edges))
                plot = gated.plot[edges]
                unclaimed[plot] = False
                untracked[plot[pairs.confirmed[edges]]] = False
                self._queue.take_also(plot[plot >= ripe] - ripe)
        left = untracked[:ripe].nonzero()[0]
        self._clutter.observe(plots.range[left], plots.azimuth[left])
        if self._strength is not None:
            self._strength.observe(plots.strength[:ripe], ~untracked[:ripe])
        if np.count_nonzero(unclaimed[:ripe]):
            left = unclaimed[:ripe].nonzero()[0]
            self._open(plots[left], strange[left] if strange is not None else None, out)

    def _detection(self, ranges: FloatArray, plot: npt.NDArray[np.intp]) -> FloatArray | float:
        probability = self._tracks.detection.probability(ranges)
        return probability.take(plot) if isinstance(probability, np.ndarray) else probability

    def _give(self, plots: Plots, pairs: Pairs, edges: npt.NDArray[np.intp]) -> Rows:
        gated = pairs.gated
        self._slices += 1
        if self._slices % _LOOKED_AT == 0:
            own = edges[pairs.confirmed[edges]]
            self._selection.observe(
                gated.track, pairs.weight, pairs.density, gated.determinant, own
            )
        gain, by_hits = pairs.gain[edges], self._tracks.initiation.hit_gain
        if by_hits is not None:
            gain = by_hits(gated.determinant[edges], pairs.density[edges])
        contest = None
        if self.parameters.association in SOFT:
            contest = Contest(gated, pairs.weight, pairs.confirmed, edges, plots)
        taken = plots[gated.plot[edges]]
        return self._tracks.update(gated.track[edges], taken, gain, self._threshold(), contest)

    def _open(self, plots: Plots, strange: FloatArray | None, out: list[Rows]) -> None:
        parameters, gap = self.parameters, self._tracks.initiation.longest_gap
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
                density = self._clutter.per_area(second.range, second.azimuth)
                if strange is not None:
                    density *= strange[pairs.plot]
                scores = score.second_plot(
                    self._tracks.detection.probability(second.range),
                    pairs.area,
                    density,
                    pairs.gap - 1,
                )
                first = self._starts.plots[pairs.start]
                out.append(self._tracks.open(first, second, pairs.gap, scores, self._threshold()))
        lost = self._starts.add(plots, parameters.maximum_plots)
        self.health.drop("first plots over the limit", lost)

    def _threshold(self) -> float:
        per_hour = self._clutter.per_scan * _SECONDS_PER_HOUR / self._tracks.period
        return score.confirmation_threshold(per_hour, self.parameters.false_tracks_per_hour)

    def _table(self, out: list[Rows], stamp: int) -> Table:
        if self._queue.now > self._watched + _WATCHED * self._rotation.period:
            self._watched = self._queue.now
            watch(
                self.health,
                self.parameters,
                self._tracks.detection,
                self._clutter,
                self._selection,
                self._rotation,
            )
        return self._finished(out, stamp)

    def _finished(self, out: list[Rows], stamp: int) -> Table:
        # Of equal dtypes; naming it spares numpy a promotion that costs more than the copy.
        rows = np.concatenate([_NO_ROWS, *out], dtype=TRACK) if len(out) != 1 else out[0]
        if len(rows):
            rows["time_offset"] -= self._queue.seconds(stamp)
            for name in ("x", "y", "z"):
                if place := getattr(self.parameters, f"radar_{name}"):
                    rows[name] += place
        return Table(stamp, rows, SITE_FRAME)
