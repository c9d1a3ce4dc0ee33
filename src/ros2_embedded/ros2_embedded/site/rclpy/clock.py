# SPDX-License-Identifier: Apache-2.0
"""Clocks, simulated time and jumps of time."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from enum import IntEnum
from types import TracebackType
from typing import cast

from rclpy.clock_type import ClockType
from rclpy.constants import S_TO_NS
from rclpy.context import Context
from rclpy.duration import Duration
from rclpy.exceptions import NotInitializedException
from rclpy.time import Time
from rclpy.utilities import get_default_context


class ClockChange(IntEnum):
    """How the source of time changed."""

    ROS_TIME_NO_CHANGE = 1
    ROS_TIME_ACTIVATED = 2
    ROS_TIME_DEACTIVATED = 3
    SYSTEM_TIME_NO_CHANGE = 4


class JumpThreshold:
    """Which jumps of time matter."""

    def __init__(
        self,
        *,
        min_forward: Duration | None,
        min_backward: Duration | None,
        on_clock_change: bool = True,
    ) -> None:
        """Set thresholds.

        Args:
            min_forward: Smallest jump ahead, or None.
            min_backward: Smallest jump back, a negative duration, or None.
            on_clock_change: Whether a change of the source of time counts.

        Raises:
            ValueError: A threshold has the wrong sign, or there is none.
        """
        if min_forward is not None and min_forward.nanoseconds <= 0:
            raise ValueError("min_forward must be a positive non-zero duration")
        if min_backward is not None and min_backward.nanoseconds >= 0:
            raise ValueError("min_backward must be a negative non-zero duration")
        if min_forward is None and min_backward is None and not on_clock_change:
            raise ValueError("At least one jump threshold must be enabled")
        self.min_forward = min_forward
        self.min_backward = min_backward
        self.on_clock_change = on_clock_change


class TimeJump:
    """A jump of time."""

    def __init__(self, clock_change: ClockChange, delta: Duration) -> None:
        """Describe a jump.

        Args:
            clock_change: Change of the source.
            delta: Change of the time.

        Raises:
            TypeError: ``clock_change`` is none.
        """
        if not isinstance(clock_change, ClockChange):
            raise TypeError("clock_change must be an instance of rclpy.clock.ClockChange")
        self.clock_change = clock_change
        self.delta = delta


class JumpHandle:
    """Keeps callbacks for jumps registered; use it in ``with`` or unregister it."""

    def __init__(
        self,
        *,
        clock: Clock,
        threshold: JumpThreshold,
        pre_callback: Callable[[], None] | None,
        post_callback: Callable[[TimeJump], None] | None,
    ) -> None:
        """Register callbacks.

        Args:
            clock: The clock.
            threshold: Which jumps matter.
            pre_callback: Called before the time changes.
            post_callback: Called after it.

        Raises:
            ValueError: There is no callback, or one cannot be called.
        """
        if pre_callback is None and post_callback is None:
            raise ValueError("One of pre_callback or post_callback must be callable")
        for callback in (pre_callback, post_callback):
            if callback is not None and not callable(callback):
                raise ValueError("pre_callback and post_callback must be callable if given")
        self._clock: Clock | None = clock
        self.threshold = threshold
        self.pre_callback = pre_callback
        self.post_callback = post_callback
        clock._jump_handles.append(self)

    def unregister(self) -> None:
        """Stop calling."""
        if self._clock is not None:
            self._clock._jump_handles.remove(self)
            self._clock = None

    def concerns(self, jump: TimeJump) -> bool:
        """Tell whether a jump exceeds the threshold.

        Args:
            jump: The jump.

        Returns:
            Whether it does.
        """
        threshold, delta = self.threshold, jump.delta
        if jump.clock_change in (
            ClockChange.ROS_TIME_ACTIVATED,
            ClockChange.ROS_TIME_DEACTIVATED,
        ):
            return threshold.on_clock_change
        forward, backward = threshold.min_forward, threshold.min_backward
        return (forward is not None and delta >= forward) or (
            backward is not None and delta <= backward
        )

    def __enter__(self) -> JumpHandle:
        return self

    def __exit__(
        self,
        exc_type: type[BaseException] | None,
        exc_val: BaseException | None,
        exc_tb: TracebackType | None,
    ) -> None:
        self.unregister()


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
