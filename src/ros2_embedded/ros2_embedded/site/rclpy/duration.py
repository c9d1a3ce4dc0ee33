# SPDX-License-Identifier: Apache-2.0
"""Durations in nanoseconds."""

from __future__ import annotations

from functools import total_ordering

import builtin_interfaces.msg
from rclpy.constants import S_TO_NS

_LIMIT = 2**63


@total_ordering
class Duration:
    """A length of time with nanosecond precision; it may be negative."""

    def __init__(self, *, seconds: float = 0, nanoseconds: int = 0) -> None:
        """Add up seconds and nanoseconds.

        Args:
            seconds: Seconds.
            nanoseconds: Nanoseconds.

        Raises:
            OverflowError: The sum does not fit 64 bits.
        """
        total = int(seconds * S_TO_NS) + int(nanoseconds)
        if not -_LIMIT <= total < _LIMIT:
            raise OverflowError("Total nanoseconds value is too large to store in C duration.")
        self._nanoseconds = total

    @property
    def nanoseconds(self) -> int:
        """The duration in nanoseconds."""
        return self._nanoseconds

    def __repr__(self) -> str:
        """Show it as an expression."""
        return f"Duration(nanoseconds={self.nanoseconds})"

    def __str__(self) -> str:
        """Show it as text."""
        return "Infinite" if self == Infinite else f"{self.nanoseconds} nanoseconds"

    def __eq__(self, other: object) -> bool:
        """Compare the values."""
        if isinstance(other, Duration):
            return self.nanoseconds == other.nanoseconds
        return NotImplemented

    def __lt__(self, other: object) -> bool:
        """Tell whether it is less."""
        if isinstance(other, Duration):
            return self.nanoseconds < other.nanoseconds
        return NotImplemented

    __hash__ = None  # type: ignore[assignment]

    def to_msg(self) -> builtin_interfaces.msg.Duration:
        """Make a message of the duration.

        Returns:
            The message.
        """
        seconds, nanoseconds = divmod(self.nanoseconds, S_TO_NS)
        return builtin_interfaces.msg.Duration(sec=seconds, nanosec=nanoseconds)

    @classmethod
    def from_msg(cls, msg: builtin_interfaces.msg.Duration) -> Duration:
        """Make a duration of a message.

        Args:
            msg: The message.

        Returns:
            The duration.

        Raises:
            TypeError: It is another message.
        """
        if not isinstance(msg, builtin_interfaces.msg.Duration):
            raise TypeError("Must pass a builtin_interfaces.msg.Duration object")
        return cls(seconds=msg.sec, nanoseconds=msg.nanosec)


#: For ever, as the middleware counts it.
Infinite = Duration(nanoseconds=_LIMIT - 1)
