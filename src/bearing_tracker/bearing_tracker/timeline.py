# SPDX-License-Identifier: Apache-2.0
"""Brings the sightings of channels with different rates and delays into one order of time.

A sighting waits until the latest message is `window` younger than it; whatever arrives within that time is put in
order, so the result does not depend on the order of arrival. What arrives later than that has lost its place.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from bearing_tracker.looks import whole_looks
from bearing_tracker.sightings import SIGHTING
from radar_common.health import Health
from radar_common.tables import NANOSECONDS

Rows = npt.NDArray[np.void]

_RESTART = 5.0
"""Seconds that the clock of one source must go back until it is a new beginning and no late message."""
_MOST_WAITING = 200_000


class Timeline:
    """Sorted memory of sightings that wait."""

    def __init__(self, window: float, health: Health) -> None:
        """Start empty.

        Args:
            window: seconds that a sighting waits for earlier ones.
            health: where refused sightings are counted.
        """
        self.window = window
        self.now = -np.inf
        """Latest time that any message told, seconds."""
        self.done = -np.inf
        """A sighting up to this time is late."""
        self.settled = -np.inf
        """No sighting up to this time will be handed out any more."""
        self._health = health
        self._latest: dict[str, float] = {}
        self._epoch: int | None = None
        self._waiting = np.zeros(0, SIGHTING)

    @property
    def stamp(self) -> int:
        """Stamp of `now` in nanoseconds, 0 before the first message."""
        return (self._epoch or 0) + round(self.now * NANOSECONDS) if np.isfinite(self.now) else 0

    def __len__(self) -> int:
        """Number of sightings that wait."""
        return len(self._waiting)

    def seconds(self, stamp: int) -> float:
        """Time of a stamp on this timeline, on which floats are exact to less than a microsecond.

        Args:
            stamp: nanoseconds.

        Returns:
            Seconds since the first message.
        """
        if self._epoch is None:
            self._epoch = stamp
        return (stamp - self._epoch) / NANOSECONDS

    def went_back(self, source: str, stamp: int) -> bool:
        """Say whether the clock of a source has begun anew, as when a recording is played again.

        Args:
            source: name of the topic.
            stamp: of its message, nanoseconds.

        Returns:
            Whether nothing that is known holds any more.
        """
        return self.seconds(stamp) < self._latest.get(source, -np.inf) - _RESTART - self.window

    def advance(self, source: str, stamp: int) -> float:
        """Tell the time of a message.

        Args:
            source: name of the topic.
            stamp: nanoseconds.

        Returns:
            Seconds since the first message.
        """
        seconds = self.seconds(stamp)
        self._latest[source] = max(seconds, self._latest.get(source, -np.inf))
        self.now = max(self.now, seconds)
        return seconds

    def put(self, rows: Rows) -> None:
        """Take in sightings.

        Args:
            rows: dtype SIGHTING, in any order.
        """
        late = rows["time"] <= self.done
        self._health.drop("sightings too late to be put in order", int(np.count_nonzero(late)))
        if not len(rows):
            return
        rows = np.concatenate([self._waiting, rows[~late]], dtype=SIGHTING)
        order = np.lexsort((rows["azimuth"], rows["id"], rows["channel"], rows["time"]))
        rows = rows[order]
        same = np.zeros(len(rows), bool)
        same[1:] = True
        for name in ("time", "channel", "id", "azimuth"):
            same[1:] &= rows[name][1:] == rows[name][:-1]
        self._health.drop("duplicate sightings", int(np.count_nonzero(same)))
        rows = rows[~same]
        surplus = max(len(rows) - _MOST_WAITING, 0)
        self._health.drop("sightings over the limit of those waiting", surplus)
        self._waiting = rows[surplus:]
        if len(rows):
            self.now = max(self.now, float(rows["time"][-1]))

    def take(self, until: float, span: float = 0.0) -> Rows:
        """Hand out what no longer has to wait.

        A look is never cut in two, wherever the window ends: else the result would depend on when messages arrive.

        Args:
            until: seconds, no later than `now`.
            span: that a look lasts at most, seconds; one that may still grow stays.

        Returns:
            dtype SIGHTING, in order of time.
        """
        count = whole_looks(self._waiting["time"], span, until)
        taken, self._waiting = self._waiting[:count], self._waiting[count:]
        self.done = self.settled = max(self.done, until)
        if len(self._waiting):
            self.settled = min(self.done, float(self._waiting["time"][0]))
        return taken

    def take_all(self) -> Rows:
        """Hand out everything, as nothing will follow.

        Returns:
            dtype SIGHTING, in order of time.
        """
        taken, self._waiting = self._waiting, self._waiting[:0]
        self.done = self.settled = max(self.done, self.now)
        return taken
