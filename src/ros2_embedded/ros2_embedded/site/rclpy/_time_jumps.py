# SPDX-License-Identifier: Apache-2.0
"""Jumps of time, and callbacks for them."""

from __future__ import annotations

from collections.abc import Callable
from enum import IntEnum
from types import TracebackType
from typing import TYPE_CHECKING

from rclpy.duration import Duration

if TYPE_CHECKING:
    from rclpy.clock import Clock


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
        """Keep the callbacks until the end of the block."""
        return self

    def __exit__(
        self,
        exc_type: type[BaseException] | None,
        exc_val: BaseException | None,
        exc_tb: TracebackType | None,
    ) -> None:
        """Stop calling."""
        self.unregister()
