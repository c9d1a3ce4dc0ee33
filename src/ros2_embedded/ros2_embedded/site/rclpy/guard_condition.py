# SPDX-License-Identifier: Apache-2.0
"""Callbacks that a program triggers itself."""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from typing import TYPE_CHECKING, Any

from rclpy._entity import Entity, call_or_await
from rclpy.callback_groups import CallbackGroup
from rclpy.context import Context
from rclpy.utilities import get_default_context

from ros2_embedded.dds.waitset import Guard

if TYPE_CHECKING:
    from rclpy._work_finder import WorkFinder


class GuardCondition(Entity):
    """Runs its callback in the executor after :meth:`trigger`."""

    def __init__(
        self,
        callback: Callable[[], Any] | None,
        callback_group: CallbackGroup | None,
        context: Context | None = None,
    ) -> None:
        """Create a guard condition; :meth:`.Node.create_guard_condition` does so.

        Args:
            callback: The callback.
            callback_group: Its group.
            context: Context it belongs to; None for the default one.

        Raises:
            NotInitializedException: The context is not initialised.
        """
        super().__init__(callback_group)
        self._guard = Guard((context or get_default_context()).participant)
        self.callback = callback

    @property
    def handle(self) -> Guard:
        """The DDS condition."""
        return self._guard

    @property
    def wait_handle(self) -> int:
        """The DDS condition to wait for."""
        return self._guard.condition

    def trigger(self) -> None:
        """Have the callback run."""
        self._check_handle()
        self._guard.trigger()

    def take(self, executor: WorkFinder | None = None) -> Callable[[], Awaitable[Any]] | None:
        """Take the trigger."""
        if not self._guard.take() or self.callback is None:
            return None
        callback = self.callback
        return lambda: call_or_await(callback)

    def destroy(self) -> None:
        """Delete the guard condition."""
        if self._close_handle():
            self._guard.close()
