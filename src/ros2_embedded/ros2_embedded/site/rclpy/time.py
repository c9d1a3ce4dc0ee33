# SPDX-License-Identifier: Apache-2.0
"""Points in time."""

from __future__ import annotations

from collections.abc import Callable
from operator import eq, ge, gt, le, lt
from typing import Any, cast, overload

import builtin_interfaces.msg
from rclpy.clock_type import ClockType
from rclpy.constants import S_TO_NS
from rclpy.duration import Duration


class Time:
    """Nanoseconds since the epoch of a kind of clock.

    Times of different kinds of clocks can neither be compared nor subtracted.
    """

    def __init__(
        self,
        *,
        seconds: float = 0,
        nanoseconds: int = 0,
        clock_type: ClockType = ClockType.SYSTEM_TIME,
    ) -> None:
        """Add up seconds and nanoseconds.

        Args:
            seconds: Seconds since the epoch.
            nanoseconds: Nanoseconds since the epoch.
            clock_type: Kind of clock.

        Raises:
            TypeError: ``clock_type`` is none.
            ValueError: Seconds or nanoseconds are negative.
            OverflowError: The sum does not fit 63 bits.
        """
        if not isinstance(clock_type, ClockType):
            raise TypeError("Clock type must be a ClockType enum")
        if seconds < 0:
            raise ValueError("Seconds value must not be negative")
        if nanoseconds < 0:
            raise ValueError("Nanoseconds value must not be negative")
        total = int(seconds * S_TO_NS) + int(nanoseconds)
        if total >= 2**63:
            raise OverflowError("Total nanoseconds value is too large to store in C time point.")
        self._nanoseconds = total
        self._clock_type = clock_type

    @property
    def nanoseconds(self) -> int:
        """Nanoseconds since the epoch."""
        return self._nanoseconds

    @property
    def clock_type(self) -> ClockType:
        """Kind of clock that measured the time."""
        return self._clock_type

    def seconds_nanoseconds(self) -> tuple[int, int]:
        """Split the time.

        Returns:
            Whole seconds and the nanoseconds beyond them.
        """
        return divmod(self.nanoseconds, S_TO_NS)

    def __repr__(self) -> str:
        """Show it as an expression."""
        return f"Time(nanoseconds={self.nanoseconds}, clock_type={self.clock_type.name})"

    def __add__(self, other: Duration) -> Time:
        """Add a duration."""
        if not isinstance(other, Duration):
            return NotImplemented
        return Time(nanoseconds=self.nanoseconds + other.nanoseconds, clock_type=self.clock_type)

    __radd__ = __add__

    @overload
    def __sub__(self, other: Time) -> Duration: ...

    @overload
    def __sub__(self, other: Duration) -> Time: ...

    def __sub__(self, other: Time | Duration) -> Time | Duration:
        """Subtract a duration, or another time."""
        if isinstance(other, Time):
            if self.clock_type != other.clock_type:
                raise TypeError("Can't subtract times with different clock types")
            return Duration(nanoseconds=self.nanoseconds - other.nanoseconds)
        if isinstance(other, Duration):
            return Time(
                nanoseconds=self.nanoseconds - other.nanoseconds, clock_type=self.clock_type
            )
        return NotImplemented

    def __eq__(self, other: object) -> bool:
        """Compare the values."""
        return self._compare(other, eq)

    def __lt__(self, other: object) -> bool:
        """Tell whether it is less."""
        return self._compare(other, lt)

    def __le__(self, other: object) -> bool:
        """Tell whether it is less or equal."""
        return self._compare(other, le)

    def __gt__(self, other: object) -> bool:
        """Tell whether it is more."""
        return self._compare(other, gt)

    def __ge__(self, other: object) -> bool:
        """Tell whether it is more or equal."""
        return self._compare(other, ge)

    __hash__ = None  # type: ignore[assignment]

    def _compare(self, other: object, relation: Callable[[Any, Any], bool]) -> bool:
        if not isinstance(other, Time):
            return cast("bool", NotImplemented)
        if self.clock_type != other.clock_type:
            raise TypeError("Can't compare times with different clock types")
        return bool(relation(self.nanoseconds, other.nanoseconds))

    def to_msg(self) -> builtin_interfaces.msg.Time:
        """Make a message of the time.

        Returns:
            The message.
        """
        seconds, nanoseconds = self.seconds_nanoseconds()
        return builtin_interfaces.msg.Time(sec=seconds, nanosec=nanoseconds)

    @classmethod
    def from_msg(
        cls, msg: builtin_interfaces.msg.Time, clock_type: ClockType = ClockType.ROS_TIME
    ) -> Time:
        """Make a time of a message.

        Args:
            msg: The message.
            clock_type: Kind of clock that measured it.

        Returns:
            The time.

        Raises:
            TypeError: It is another message.
        """
        if not isinstance(msg, builtin_interfaces.msg.Time):
            raise TypeError("Must pass a builtin_interfaces.msg.Time object")
        return cls(seconds=msg.sec, nanoseconds=msg.nanosec, clock_type=clock_type)
