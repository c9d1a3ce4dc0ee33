# SPDX-License-Identifier: Apache-2.0
"""What an executor waits for and runs."""

from __future__ import annotations

import inspect
from collections.abc import Awaitable, Callable
from typing import TYPE_CHECKING, Any

from rclpy.callback_groups import CallbackGroup
from rclpy.exceptions import InvalidHandle

if TYPE_CHECKING:
    from rclpy._work_finder import WorkFinder


class Entity:
    """Base of timers, subscriptions, services, clients, guard conditions and events."""

    def __init__(self, callback_group: CallbackGroup | None) -> None:
        """Put the entity into its group.

        Args:
            callback_group: The group, or None for an entity without callback.
        """
        self.callback_group = callback_group
        if callback_group is not None:
            callback_group.add_entity(self)
        # True between the moment an executor sees it ready and that it takes the work.
        self._executor_event = False
        self._closed = False

    @property
    def wait_handle(self) -> int | None:
        """The DDS condition to wait for, None if there is none."""
        return None

    def take(self, executor: WorkFinder | None = None) -> Callable[[], Awaitable[Any]] | None:
        """Take one piece of work.

        Args:
            executor: Runs what follows from it.

        Returns:
            Runs the callback; None if there is nothing to do.
        """
        raise NotImplementedError

    def wall_time_until_ready(self) -> float | None:
        """Get how long an executor may wait for the entity.

        Returns:
            Seconds; None if time does not make it ready.
        """
        return None

    def can_execute(self) -> bool:
        """Tell whether the callback may run now.

        Returns:
            Whether it may.
        """
        group = self.callback_group
        return not self._executor_event and group is not None and group.can_execute(self)

    def _check_handle(self) -> None:
        if self._closed:
            raise InvalidHandle("cannot use Destroyable because destruction was requested")

    def _close_handle(self) -> bool:
        """Mark the entity destroyed; tells whether it was not before."""
        was_open, self._closed = not self._closed, True
        return was_open


async def call_or_await(callback: Callable[..., Any], *args: Any) -> Any:
    """Call a function, or a coroutine function and await it.

    Args:
        callback: The function.
        *args: Its arguments.

    Returns:
        Its result.
    """
    if inspect.iscoroutinefunction(callback):
        return await callback(*args)
    return callback(*args)
