# SPDX-License-Identifier: Apache-2.0
"""The fusion of angle channels: radar tracks or plots and passive bearings in, fused bearings out."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from bearing_tracker.fused_targets import FusedTargets
from bearing_tracker.fusion_parameters import FusionParameters
from bearing_tracker.identities import Identities
from bearing_tracker.looks import looks
from bearing_tracker.pairing import pair
from bearing_tracker.sightings import Deviations, from_bearings, from_plots, from_tracks
from bearing_tracker.timeline import Timeline
from bearing_tracker.twins import join_twins
from radar_common.health import Health
from radar_common.tables import BEARING, PLOT, SITE_FRAME, TRACK, BearingChannel, Table

Rows = npt.NDArray[np.void]

_NO_ROWS = np.zeros(0, BEARING)
_INPUT = {"tracks": TRACK, "track_plots": TRACK, "plots": PLOT}


class BearingFusion:
    """Turns the angles of an active and of a passive channel into fused bearings."""

    def __init__(self, parameters: FusionParameters, health: Health | None = None) -> None:
        """Start without targets.

        Args:
            parameters: how to fuse.
            health: where events are counted; None for a new one.
        """
        self.parameters = parameters
        self.health = health if health is not None else Health()
        self._identities = Identities()
        self._begin()

    def reconfigure(self, parameters: FusionParameters) -> None:
        """Go on with other parameters and the same targets.

        Args:
            parameters: how to fuse from now on.
        """
        self.parameters = parameters
        self._timeline.window = parameters.buffer
        self._targets.reconfigure(parameters)

    def process(self, table: Table) -> Table:
        """Take in one message of either channel.

        Args:
            table: dtype BEARING of the passive channel, or that of the active input (TRACK or PLOT); possibly empty:
                its stamp alone tells that time has passed.

        Returns:
            A row of dtype BEARING for every bearing that a published target got, at the time of that bearing.

        Raises:
            TypeError: the table holds neither.
        """
        if table.rows.dtype not in (BEARING, _INPUT[self.parameters.active_input]):
            raise TypeError(f"the fusion takes bearings or {self.parameters.active_input}")
        source = "passive" if table.rows.dtype == BEARING else "active"
        if self._timeline.went_back(source, table.stamp):
            self.health.drop("time went back: all targets ended")
            self._begin()
        self._identities.start(table.stamp)
        seconds = self._timeline.advance(source, table.stamp)
        sightings = self._sightings(table, seconds)
        self.health.count(f"{source} bearings in", int(np.count_nonzero(~sightings["ended"])))
        self._timeline.put(sightings)
        until = self._timeline.now - self.parameters.buffer
        return self._table(self._timeline.take(until, self.parameters.look), table.stamp)

    def flush(self) -> Table:
        """Process what still waits for earlier bearings, as no message will follow.

        Returns:
            The last fused bearings.
        """
        return self._table(self._timeline.take_all(), self._timeline.stamp)

    def _begin(self) -> None:
        self._timeline = Timeline(self.parameters.buffer, self.health)
        self._targets = FusedTargets(self.parameters)

    def _sightings(self, table: Table, seconds: float) -> Rows:
        parameters, health, most = self.parameters, self.health, self.parameters.maximum_bearings
        if table.rows.dtype == BEARING:
            passive = Deviations(parameters.default_passive_std, parameters.minimum_std)
            return from_bearings(table.rows, seconds, passive, most, health)
        active = Deviations(parameters.default_active_std, parameters.minimum_std)
        if table.rows.dtype == PLOT:
            return from_plots(table.rows, seconds, active, most, health)
        as_plots = parameters.active_input == "track_plots"
        place = (parameters.radar_x, parameters.radar_y)
        rows = from_tracks(
            table.rows, seconds, active, most, health, place=place, as_plots=as_plots
        )
        if not as_plots:
            rows["azimuth_std"] *= parameters.track_inflation
        return rows

    def _table(self, sightings: Rows, stamp: int) -> Table:
        out, parameters = [_NO_ROWS], self.parameters
        for look in looks(sightings, parameters.look, parameters.maximum_look, self.health):
            ended = look["ended"]
            self._let_go(look["id"][ended])
            if not ended.all():
                out.append(self._work(look[~ended]))
        self._end(self._timeline.settled)
        rows = np.concatenate(out, dtype=BEARING)
        rows["time_offset"] -= self._timeline.seconds(stamp)
        self.health.count("fused bearings out", len(rows))
        self._watch()
        return Table(stamp, rows, SITE_FRAME)

    def _work(self, look: Rows) -> Rows:
        targets, parameters, channel = self._targets, self.parameters, int(look["channel"][0])
        self._end(float(look["time"][0]))
        target = pair(targets, look, parameters, self.health)
        old, new = np.flatnonzero(target >= 0), np.flatnonzero(target < 0)
        if len(old):
            targets.update(target[old], look[old])
        room = max(parameters.maximum_targets - len(targets), 0)
        self.health.drop("bearings over the limit of targets", max(len(new) - room, 0))
        new = new[:room]
        if len(new):
            # What a track begins bears its number, so that a user finds it in both tables.
            wanted = look["id"][new] * (channel == BearingChannel.ACTIVE)
            target[new] = targets.open(look[new], self._identities.take(wanted))
            self.health.count("targets opened", len(new))
        heard = target[target >= 0]
        rows = targets.rows(heard[targets.columns["confirmed"][heard]])
        self.health.count("targets joined", join_twins(targets, heard, channel, parameters))
        return rows

    def _let_go(self, ids: npt.NDArray[np.int64]) -> None:
        # A target whose track has ended goes on with what the passive channel hears of it.
        which = self._targets.of_identities(ids, BearingChannel.ACTIVE)
        self._targets.columns["partner"][which[which >= 0], BearingChannel.ACTIVE] = 0

    def _end(self, time: float) -> None:
        columns, parameters = self._targets.columns, self.parameters
        lost = time - columns["heard"] > parameters.end_after
        columns["partner"][lost] = 0
        patience = np.where(
            columns["confirmed"], parameters.end_after, parameters.tentative_end_after
        )
        gone = time - columns["time"] > patience
        if gone.any():
            self.health.count("targets ended", int(np.count_nonzero(gone)))
            self._targets.remove(gone)

    def _watch(self) -> None:
        usual = self._targets.model.usual_disturbance
        for channel, name in (
            (BearingChannel.ACTIVE, "probability that the active channel is jammed"),
            (BearingChannel.PASSIVE, "probability that the passive channel is silent"),
        ):
            observed = self._targets.disturbed(channel)
            if np.isfinite(observed):
                self.health.watch(name, usual[channel], observed)
