# SPDX-License-Identifier: Apache-2.0
"""Keeps a tracker's tracks in a file, so that the next process goes on with them even after a kill."""

from __future__ import annotations

from radar_common.health import Health
from radar_common.tables import NANOSECONDS
from secondary_proc.handover import Handover, HandoverError
from secondary_proc.tracker import Tracker


class StateFile:
    """The file of one tracker."""

    def __init__(self, path: str, interval: float, health: Health) -> None:
        """Name the file.

        Args:
            path: of the file; empty for none.
            interval: between two writings, by the stamps of the messages, seconds.
            health: where failures are counted.
        """
        self._path = path
        self._interval = round(interval * NANOSECONDS)
        self._health = health
        self._written: int | None = None

    def restore(self, tracker: Tracker) -> None:
        """Let a new tracker go on with what the file holds, if it holds anything.

        Args:
            tracker: that has not processed any message.
        """
        if not self._path:
            return
        try:
            tracker.resume(Handover.load(self._path))
        except FileNotFoundError:
            self._health.count("starts without a state file")
        except HandoverError as error:
            self._health.drop(str(error))

    def keep(self, tracker: Tracker, stamp: int) -> None:
        """Write the file if it is time.

        Args:
            tracker: to take the tracks from.
            stamp: of the last message, nanoseconds.
        """
        due = self._written is None or abs(stamp - self._written) >= self._interval
        if not self._path or not due:
            return
        self._written = stamp
        try:
            tracker.handover().save(self._path)
        except OSError as error:
            self._health.drop(f"state file cannot be written: {error.strerror}")
