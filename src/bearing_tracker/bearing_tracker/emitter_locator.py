# SPDX-License-Identifier: Apache-2.0
"""The locator of emitters: passive bearings and the platform's odometry in, emitters out."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from bearing_tracker.bearing_association import Directions, Edges, assign, gate
from bearing_tracker.identities import Identities
from bearing_tracker.located_emitters import PLACED, LocatedEmitters
from bearing_tracker.locator_parameters import LocatorParameters
from bearing_tracker.looks import looks
from bearing_tracker.platform_path import PlatformPath
from bearing_tracker.sightings import Deviations, from_bearings
from bearing_tracker.timeline import Timeline
from radar_common.health import Health
from radar_common.odometry import PlatformState
from radar_common.tables import BEARING, EMITTER, Table

IndexArray = npt.NDArray[np.intp]
Rows = npt.NDArray[np.void]

_NO_ROWS = np.zeros(0, EMITTER)
_MOST_WATCHED = 20


class EmitterLocator:
    """Turns the bearings that a moving platform takes into places of emitters."""

    def __init__(self, parameters: LocatorParameters, health: Health | None = None) -> None:
        """Start without emitters.

        Args:
            parameters: how to locate.
            health: where events are counted; None for a new one.
        """
        self.parameters = parameters
        self.health = health if health is not None else Health()
        self._identities = Identities()
        self._begin()

    def reconfigure(self, parameters: LocatorParameters) -> None:
        """Go on with other parameters and the same emitters.

        Args:
            parameters: how to locate from now on; those of the filter stay as they were.
        """
        self.parameters = self._emitters.parameters = parameters
        self._timeline.window = parameters.buffer
        self._path.limits = parameters.path_limits

    def process(self, bearings: Table) -> Table:
        """Take in one message of bearings.

        Args:
            bearings: dtype BEARING, possibly empty: its stamp alone tells that time has passed.

        Returns:
            A row of dtype EMITTER for every emitter that a bearing was used for, at the time of its last bearing, and
            a last row for those that ended.

        Raises:
            TypeError: the table holds no bearings.
        """
        if bearings.rows.dtype != BEARING:
            raise TypeError(f"the locator takes bearings, not {bearings.rows.dtype}")
        seconds, out = self._arrive("bearings", bearings.stamp)
        parameters = self.parameters
        deviations = Deviations(parameters.default_azimuth_std, parameters.minimum_azimuth_std)
        sightings = from_bearings(
            bearings.rows, seconds, deviations, parameters.maximum_bearings, self.health
        )
        self.health.count("bearings in", len(sightings))
        self._timeline.put(sightings)
        return self._table(out, bearings.stamp)

    def process_platform(self, state: PlatformState) -> Table:
        """Take in where the platform is.

        Args:
            state: from its odometry.

        Returns:
            As `process`: bearings may have waited for it.
        """
        if state.frame_id not in ("", self.parameters.frame):
            self.health.drop(f"odometry in frame {state.frame_id}, not {self.parameters.frame}")
            return Table(state.stamp, _NO_ROWS, self.parameters.frame)
        seconds, out = self._arrive("odometry", state.stamp)
        self.health.count("fixes in")
        self._path.put(seconds, (state.x, state.y, state.z), state.position_variance)
        return self._table(out, state.stamp)

    def flush(self) -> Table:
        """Process what still waits, as no message will follow.

        Returns:
            The last emitters.
        """
        return self._table([], self._timeline.stamp, everything=True)

    def _begin(self) -> None:
        self._timeline = Timeline(self.parameters.buffer, self.health)
        self._path = PlatformPath(self.parameters.path_limits, self.health)
        self._emitters = LocatedEmitters(self.parameters)

    def _arrive(self, source: str, stamp: int) -> tuple[float, list[Rows]]:
        out = []
        if self._timeline.went_back(source, stamp):
            self.health.drop("time went back: all emitters ended")
            out = [self._bury(np.ones(len(self._emitters), bool))]
            # Their times belong to the clock that has gone.
            out[0]["time_offset"] = 0.0
            self._begin()
            self._timeline.advance(source, stamp)
            for rows in out:
                rows["time_offset"] += self._timeline.seconds(stamp)
        self._identities.start(stamp)
        return self._timeline.advance(source, stamp), out

    def _table(self, out: list[Rows], stamp: int, *, everything: bool = False) -> Table:
        parameters = self.parameters
        placed = self._place(self._take(everything=everything))
        heard = np.zeros(0, np.int64)
        for look in looks(placed, parameters.look, parameters.maximum_look, self.health):
            out.append(self._end(float(look["time"][0])))
            heard = np.union1d(heard, self._work(look))
        out.append(self._end(self._timeline.settled))
        shown = np.flatnonzero(np.isin(self._emitters.columns["id"], heard))
        out.append(self._emitters.rows(shown))
        rows = np.concatenate([_NO_ROWS, *out], dtype=EMITTER)
        rows["time_offset"] -= self._timeline.seconds(stamp)
        self._watch(out[-1])
        return Table(stamp, rows, parameters.frame)

    def _take(self, *, everything: bool) -> Rows:
        if everything:
            return self._timeline.take_all()
        # Bearings wait until a fix follows them, but not for ever.
        now, parameters = self._timeline.now, self.parameters
        until = max(min(now - parameters.buffer, self._path.end), now - parameters.odometry_wait)
        return self._timeline.take(until, parameters.look)

    def _place(self, sightings: Rows) -> Rows:
        placed = np.zeros(len(sightings), PLACED)
        for name in sightings.dtype.names or ():
            placed[name] = sightings[name]
        places = self._path.at(sightings["time"])
        placed["position"], placed["variance"] = places.position, places.variance
        self.health.drop("bearings without odometry", int(np.count_nonzero(~places.known)))
        return placed[places.known]

    def _work(self, look: Rows) -> npt.NDArray[np.int64]:
        emitters = self._emitters
        which = self._pair(look)
        old, new = np.flatnonzero(which >= 0), np.flatnonzero(which < 0)
        if len(old):
            rejected, anew = emitters.update(which[old], look[old])
            self.health.drop("bearings that fit no place of their emitter", rejected)
            self.health.count("emitters located anew", anew)
            self.health.count("bearings used", len(old) - rejected)
        room = max(self.parameters.maximum_emitters - len(emitters), 0)
        self.health.drop("bearings over the limit of emitters", max(len(new) - room, 0))
        new = new[:room]
        if len(new):
            which[new] = emitters.open(look[new], self._identities.take(look["id"][new]))
            self.health.count("emitters opened", len(new))
        return emitters.columns["id"][which[which >= 0]]

    def _pair(self, look: Rows) -> IndexArray:
        """Find the emitter of each bearing: by identity, else by gate and assignment; -1 where there is none."""
        emitters = self._emitters
        which = emitters.of_identities(look["id"])
        nameless = np.flatnonzero(look["id"] == 0)
        free = np.setdiff1d(np.flatnonzero(emitters.columns["source"] == 0), which)
        if not len(nameless) or not len(free):
            return which
        bearings = look[nameless]
        observer = bearings["position"][:, :2].mean(axis=0)
        expected = emitters.expected(free, float(bearings["time"].mean()), observer)
        reported = Directions(bearings["azimuth"], bearings["azimuth_std"])
        edges: Edges = gate(expected, reported, self.parameters.gate_sigmas)
        confirmed = emitters.columns["confirmed"][free].astype(int)
        chosen = assign(edges, confirmed[edges.target])
        which[nameless[edges.bearing[chosen]]] = free[edges.target[chosen]]
        return which

    def _end(self, time: float) -> Rows:
        columns, parameters = self._emitters.columns, self.parameters
        patience = np.where(
            columns["confirmed"], parameters.end_after, parameters.tentative_end_after
        )
        return self._bury(time - columns["seen"] > patience)

    def _bury(self, gone: npt.NDArray[np.bool_]) -> Rows:
        if not gone.any():
            return _NO_ROWS
        self.health.count("emitters ended", int(np.count_nonzero(gone)))
        last = self._emitters.rows(np.flatnonzero(gone), ended=True)
        for number in last["id"].tolist():
            self.health.watches.pop(_watch_name(number), None)
        self._emitters.remove(gone)
        return last

    def _watch(self, rows: Rows) -> None:
        # What the bearings allow at best beside what the filter believes to have made of them.
        for row in rows[rows["range_known"] != 0]:
            name = _watch_name(int(row["id"]))
            if name in self.health.watches or len(self.health.watches) < _MOST_WATCHED:
                covariance = row["covariance"].reshape(4, 4)
                believed = np.sqrt(float(covariance[0, 0] + covariance[1, 1]))
                self.health.watch(name, float(row["bound_std"]), believed)


def _watch_name(number: int) -> str:
    return f"emitter {number}: Cramer-Rao bound and error of its place, m"
