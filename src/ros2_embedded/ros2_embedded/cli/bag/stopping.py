# SPDX-License-Identifier: Apache-2.0
"""An orderly end on SIGINT and SIGTERM."""

from __future__ import annotations

import signal
import time
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

_SLICE_NANOSECONDS = 50_000_000


class StopRequest:
    """Becomes true when the user asks for the end; a loop looks at it between two messages.

    An exception out of a signal handler could tear a record in two.
    """

    def __init__(self) -> None:
        self._requested = False

    def __bool__(self) -> bool:
        """Tell whether the end was asked for."""
        return self._requested

    def request(self, _signal: int = 0, _frame: FrameType | None = None) -> None:
        """Ask for the end; serves as a signal handler.

        Args:
            _signal: The number of the signal.
            _frame: Where it came.
        """
        self._requested = True

    def sleep_until(self, deadline: int) -> None:
        """Sleep until a point of monotonic time, or until the end is asked for.

        Args:
            deadline: The point (ns).
        """
        while not self._requested and (remaining := deadline - time.monotonic_ns()) > 0:
            time.sleep(min(remaining, _SLICE_NANOSECONDS) * 1e-9)


@contextmanager
def stop_on_signals() -> Iterator[StopRequest]:
    """Turn SIGINT and SIGTERM into a request to stop for the length of a block.

    Yields:
        The request.
    """
    stop = StopRequest()
    kinds = (signal.SIGINT, signal.SIGTERM)
    previous = [signal.signal(kind, stop.request) for kind in kinds]
    try:
        yield stop
    finally:
        for kind, handler in zip(kinds, previous, strict=True):
            signal.signal(kind, handler)
