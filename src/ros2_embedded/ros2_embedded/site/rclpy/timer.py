# SPDX-License-Identifier: Apache-2.0
"""Timers, and rates made of them."""

from __future__ import annotations

import threading
from collections.abc import Awaitable, Callable
from typing import TYPE_CHECKING, Any

from rclpy._entity import Entity, call_or_await
from rclpy._rclpy_pybind11 import RCLError
from rclpy.callback_groups import CallbackGroup
from rclpy.clock import Clock, ClockChange, JumpThreshold, TimeJump
from rclpy.context import Context
from rclpy.duration import Duration
from rclpy.exceptions import InvalidHandle, ROSInterruptException

if TYPE_CHECKING:
    from rclpy._work_finder import WorkFinder


class Timer(Entity):
    """Runs a callback at a fixed period of a clock."""

    def __init__(
        self,
        callback: Callable[[], Any] | None,
        callback_group: CallbackGroup | None,
        timer_period_ns: int,
        clock: Clock,
        *,
        context: Context | None = None,
        autostart: bool = True,
    ) -> None:
        """Create a timer; :meth:`.Node.create_timer` does so.

        Args:
            callback: The callback.
            callback_group: Its group.
            timer_period_ns: Nanoseconds between calls.
            clock: Clock that measures them.
            context: Context it belongs to.
            autostart: False to wait for :meth:`reset`.

        Raises:
            RCLError: The period is negative.
        """
        super().__init__(callback_group)
        if timer_period_ns < 0:
            raise RCLError("failed to create timer: timer period must be non-negative")
        self.callback = callback
        self._clock = clock
        self._period = int(timer_period_ns)
        self._canceled = not autostart
        self._credit = 0
        #: Called when the timer may have become ready earlier than it was foreseen.
        self.on_change: Callable[[], object] = lambda: None
        self._last_call = self._now()
        self._next_call = self._last_call + self._period
        self._jump_handle = clock.create_jump_callback(
            JumpThreshold(
                min_forward=Duration(nanoseconds=1), min_backward=Duration(nanoseconds=-1)
            ),
            pre_callback=self._before_jump,
            post_callback=self._after_jump,
        )

    @property
    def handle(self) -> Timer | None:
        """The timer itself, None after its destruction."""
        return None if self._closed else self

    @property
    def clock(self) -> Clock:
        """The clock that measures the period."""
        return self._clock

    @property
    def timer_period_ns(self) -> int:
        """Nanoseconds between calls."""
        return self._period

    @timer_period_ns.setter
    def timer_period_ns(self, value: int) -> None:
        self._check_handle()
        self._period = int(value)
        self.on_change()

    def is_ready(self) -> bool:
        """Tell whether a call is due.

        Returns:
            Whether it is.
        """
        self._check_handle()
        return not self._canceled and self._now() >= self._next_call

    def is_canceled(self) -> bool:
        """Tell whether the timer stands still.

        Returns:
            Whether it does.
        """
        self._check_handle()
        return self._canceled

    def cancel(self) -> None:
        """Stop until :meth:`reset`."""
        self._check_handle()
        self._canceled = True

    def reset(self) -> None:
        """Start the period anew."""
        self._check_handle()
        self._next_call = self._now() + self._period
        self._canceled = False
        self.on_change()

    def time_since_last_call(self) -> int:
        """Get the time since the last call.

        Returns:
            Nanoseconds.
        """
        self._check_handle()
        return self._now() - self._last_call

    def time_until_next_call(self) -> int | None:
        """Get the time until the next call.

        Returns:
            Nanoseconds, negative if it is overdue; None if the timer stands still.
        """
        self._check_handle()
        return None if self._canceled else self._next_call - self._now()

    def wall_time_until_ready(self) -> float | None:
        """Get how long an executor may wait."""
        if self._closed or self._canceled:
            return None
        return 0.0 if self.is_ready() else self._clock._seconds_until(self._next_call)

    def take(self, executor: WorkFinder | None = None) -> Callable[[], Awaitable[Any]] | None:
        """Take the call that is due and set the time of the next."""
        if self._closed or not self.is_ready():
            return None
        now = self._now()
        self._last_call = now
        self._next_call += self._period
        if self._next_call < now:
            # Calls that were missed are left out; the rhythm stays.
            missed = -(-(now - self._next_call) // self._period) if self._period else 0
            self._next_call = self._next_call + missed * self._period if self._period else now
        callback = self.callback
        return None if callback is None else lambda: call_or_await(callback)

    def destroy(self) -> None:
        """Delete the timer."""
        if self._close_handle():
            self._jump_handle.unregister()

    def _now(self) -> int:
        return self._clock._nanoseconds()

    def _before_jump(self) -> None:
        # Time run of the period, to be kept when the source of time changes.
        self._credit = self._now() - self._last_call

    def _after_jump(self, jump: TimeJump) -> None:
        now = self._now()
        if jump.clock_change in (
            ClockChange.ROS_TIME_ACTIVATED,
            ClockChange.ROS_TIME_DEACTIVATED,
        ):
            if now:
                self._last_call = now - self._credit
                self._next_call = self._last_call + self._period
        elif now < self._last_call:
            self._last_call = now
            self._next_call = now + self._period
        self.on_change()


class Rate:
    """Lets a thread sleep until the next call of a timer."""

    def __init__(self, timer: Timer, *, context: Context) -> None:
        """Create a rate; :meth:`.Node.create_rate` does so.

        Args:
            timer: The timer.
            context: Ends the sleep when it is shut down.
        """
        self._timer = timer
        self._is_shutdown = False
        self._is_destroyed = False
        self._event = threading.Event()
        self._lock = threading.Lock()
        self._sleepers = 0
        timer.callback = self._event.set
        context.on_shutdown(self._on_shutdown)

    def _on_shutdown(self) -> None:
        self._is_shutdown = True
        self.destroy()

    def destroy(self) -> None:
        """End all sleep."""
        self._is_destroyed = True
        self._event.set()

    def sleep(self) -> None:
        """Sleep until the timer fires; another thread must spin the node.

        Raises:
            ROSInterruptException: The context was shut down.
            RuntimeError: The rate was destroyed.
            InvalidHandle: The timer was destroyed.
        """
        if self._is_shutdown:
            raise ROSInterruptException()
        if self._is_destroyed:
            raise RuntimeError("Rate cannot sleep because it has been destroyed")
        if not self._timer.handle:
            self.destroy()
            raise InvalidHandle("Rate cannot sleep because the timer has been destroyed")
        with self._lock:
            self._sleepers += 1
        try:
            self._event.wait()
        finally:
            with self._lock:
                self._sleepers -= 1
                if self._sleepers == 0:
                    self._event.clear()
        if self._is_shutdown:
            self.destroy()
            raise ROSInterruptException()
