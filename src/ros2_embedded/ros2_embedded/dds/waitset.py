# SPDX-License-Identifier: Apache-2.0
"""Waiting for several things at once, and waking the one who waits."""

from __future__ import annotations

import ctypes as ct
from collections.abc import Iterable

from ros2_embedded.dds import library
from ros2_embedded.dds.library import check
from ros2_embedded.dds.participant import Participant


class Guard:
    """A condition that a program sets; it can be waited for."""

    def __init__(self, participant: Participant) -> None:
        """Create a condition that does not hold.

        Args:
            participant: Participant that owns it.

        Raises:
            DdsError: The participant is gone.
        """
        created = library.create_guard(participant.handle)
        self.condition = check(created, "create a guard condition")

    def trigger(self) -> None:
        """Make the condition hold. Does nothing once the guard is gone."""
        library.set_guard(self.condition, True)

    def take(self) -> bool:
        """Make the condition not hold.

        Returns:
            Whether it held.
        """
        was_set = ct.c_bool()
        library.take_guard(self.condition, ct.byref(was_set))
        return was_set.value

    def close(self) -> None:
        """Delete the condition."""
        library.delete_handle(self.condition)


class WaitSet:
    """Waits until one of a set of conditions holds."""

    def __init__(self, participant: Participant) -> None:
        """Create an empty set.

        Args:
            participant: Participant that owns it.

        Raises:
            DdsError: The participant is gone.
        """
        self._handle = check(library.create_waitset(participant.handle), "create a waitset")
        self._attached: set[int] = set()

    def wait(self, conditions: Iterable[int], timeout: int | None) -> set[int]:
        """Wait until a condition holds.

        Attaching a condition costs more than a wait, so only changes since the last
        call are made.

        Args:
            conditions: Handles of the conditions to wait for.
            timeout: Nanoseconds to wait at most, None for ever.

        Returns:
            Handles of the conditions that hold; empty after the timeout, or if the
            participant has gone.
        """
        wanted = set(conditions)
        # Those whose entity was deleted meanwhile are detached already.
        for condition in self._attached - wanted:
            library.waitset_detach(self._handle, condition)
        self._attached = {
            condition
            for condition in wanted
            if condition in self._attached
            or library.waitset_attach(self._handle, condition, condition) >= 0
        }
        size = max(len(self._attached), 1)
        ready = (ct.c_ssize_t * size)()
        limit = library.INFINITE if timeout is None else timeout
        count = library.waitset_wait(self._handle, ready, size, limit)
        return set(ready[: min(max(count, 0), size)])

    def close(self) -> None:
        """Delete the set."""
        library.delete_handle(self._handle)
