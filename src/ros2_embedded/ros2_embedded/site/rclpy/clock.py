# SPDX-License-Identifier: Apache-2.0
"""Clocks, simulated time and jumps of time."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from typing import cast

from rclpy._time_jumps import ClockChange, JumpHandle, JumpThreshold, TimeJump
from rclpy.clock_type import ClockType
from rclpy.constants import S_TO_NS
from rclpy.context import Context
from rclpy.duration import Duration
from rclpy.exceptions import NotInitializedException
from rclpy.time import Time
from rclpy.utilities import get_default_context

__all__ = ["Clock", "ClockChange", "JumpHandle", "JumpThreshold", "ROSClock", "TimeJump"]


class Clock:
    """A clock; one for ROS time is a :class:`ROSClock`."""

    _clock_type: ClockType
    _jump_handles: list[JumpHandle]

    def __new__(cls, *, clock_type: ClockType = ClockType.SYSTEM_TIME) -> Clock:
        """Create a clock.

        Args:
            clock_type: What it follows.

        Raises:
            TypeError: ``clock_type`` is none.
        """
        if not isinstance(clock_type, ClockType):
            raise TypeError("Clock type must be a ClockType enum")
        self = super().__new__(ROSClock if clock_type is ClockType.ROS_TIME else cls)
        self._clock_type = clock_type
        self._jump_handles = []
        return self

    @property
    def clock_type(self) -> ClockType:
        """What the clock follows."""
        return self._clock_type

    def __repr__(self) -> str:
        """Show it as an expression."""
        return f"Clock(clock_type={self.clock_type.name})"

    def now(self) -> Time:
        """Get the time.

        Returns:
            The time.
        """
        return Time(nanoseconds=self._nanoseconds(), clock_type=self.clock_type)

    def create_jump_callback(
        self,
        threshold: JumpThreshold,
        *,
        pre_callback: Callable[[], None] | None = None,
        post_callback: Callable[[TimeJump], None] | None = None,
    ) -> JumpHandle:
        """Have something called when time jumps.

        Args:
            threshold: Which jumps matter.
            pre_callback: Called before the time changes.
            post_callback: Called after it.

        Returns:
            What keeps the callbacks registered.

        Raises:
            ValueError: There is no callback, or one cannot be called.
        """
        if post_callback is not None and not callable(post_callback):
            post_callback = None
        return JumpHandle(
            clock=self,
            threshold=threshold,
            pre_callback=pre_callback,
            post_callback=post_callback,
        )

    def sleep_until(self, until: Time, context: Context | None = None) -> bool:
        """Sleep until a time of this clock.

        Args:
            until: The time.
            context: Ends the sleep when it is shut down; None for the default one.

        Returns:
            True if the time has come; False after a shutdown or if simulated time was
            switched on or off meanwhile.

        Raises:
            NotInitializedException: The context is not initialised.
            ValueError: The time is of another kind of clock.
        """
        context = context or get_default_context()
        if not context.ok():
            raise NotInitializedException()
        if until.clock_type != self.clock_type:
            raise ValueError("until's clock type does not match this clock's type")
        event = threading.Event()
        source_changed = False

        def on_jump(jump: TimeJump) -> None:
            nonlocal source_changed
            source_changed |= jump.clock_change in (
                ClockChange.ROS_TIME_ACTIVATED,
                ClockChange.ROS_TIME_DEACTIVATED,
            )
            if source_changed or self.now() >= until:
                event.set()

        context.on_shutdown(event.set)
        threshold = JumpThreshold(min_forward=Duration(nanoseconds=1), min_backward=None)
        with self.create_jump_callback(threshold, post_callback=on_jump):
            while not event.is_set() and context.ok() and self.now() < until:
                event.wait(self._seconds_until(until.nanoseconds))
        return context.ok() and not source_changed and self.now() >= until

    def sleep_for(self, rel_time: Duration, context: Context | None = None) -> bool:
        """Sleep for a duration of this clock; see :meth:`sleep_until`.

        Args:
            rel_time: The duration.
            context: Ends the sleep when it is shut down; None for the default one.

        Returns:
            True if the time has come.

        Raises:
            NotInitializedException: The context is not initialised.
        """
        return self.sleep_until(self.now() + rel_time, context)

    def _nanoseconds(self) -> int:
        if self._clock_type is ClockType.STEADY_TIME:
            return time.monotonic_ns()
        return time.time_ns()

    def _seconds_until(self, nanoseconds: int) -> float | None:
        """Wall time until a time, None if only a jump can tell."""
        return max(nanoseconds - self._nanoseconds(), 0) / S_TO_NS


class ROSClock(Clock):
    """Simulated time while that is active, else system time."""

    _active: bool = False
    _override: int = 0

    def __new__(cls) -> ROSClock:
        """Create a clock that follows system time at first."""
        return cast("ROSClock", super().__new__(cls, clock_type=ClockType.ROS_TIME))

    @property
    def ros_time_is_active(self) -> bool:
        """Whether the clock follows simulated time."""
        return self._active

    def set_ros_time_override(self, time: Time) -> None:
        """Set the simulated time.

        Args:
            time: The time.

        Raises:
            TypeError: It is no time.
        """
        if not isinstance(time, Time):
            raise TypeError(
                f"Time must be specified as rclpy.time.Time. Received type: {type(time)}"
            )
        if self._active:
            change = ClockChange.ROS_TIME_NO_CHANGE
            self._jump(change, time.nanoseconds - self._override, override=time.nanoseconds)
        else:
            self._override = time.nanoseconds

    def _set_ros_time_is_active(self, enabled: bool) -> None:
        if self._active != enabled:
            if enabled:
                change, delta = ClockChange.ROS_TIME_ACTIVATED, self._override - time.time_ns()
            else:
                change, delta = ClockChange.ROS_TIME_DEACTIVATED, time.time_ns() - self._override
            self._jump(change, delta, active=enabled)

    def _jump(
        self,
        change: ClockChange,
        delta: int,
        *,
        override: int | None = None,
        active: bool | None = None,
    ) -> None:
        jump = TimeJump(change, Duration(nanoseconds=delta))
        handles = [handle for handle in self._jump_handles if handle.concerns(jump)]
        for handle in handles:
            if handle.pre_callback is not None:
                handle.pre_callback()
        self._override = self._override if override is None else override
        self._active = self._active if active is None else active
        for handle in handles:
            if handle.post_callback is not None:
                handle.post_callback(jump)

    def _nanoseconds(self) -> int:
        return self._override if self._active else time.time_ns()

    def _seconds_until(self, nanoseconds: int) -> float | None:
        return None if self._active else super()._seconds_until(nanoseconds)
