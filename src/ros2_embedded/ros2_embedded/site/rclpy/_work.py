# SPDX-License-Identifier: Apache-2.0
"""How many callbacks are running."""

from __future__ import annotations

import threading
from types import TracebackType


class WorkTracker:
    """Counts the callbacks under way, by thread; it is entered around each."""

    def __init__(self) -> None:
        self._threads: list[int] = []
        self._changed = threading.Condition()

    def __enter__(self) -> None:
        with self._changed:
            self._threads.append(threading.get_ident())

    def __exit__(
        self,
        exc_type: type[BaseException] | None,
        exc_val: BaseException | None,
        exc_tb: TracebackType | None,
    ) -> None:
        with self._changed:
            # A coroutine may end in another thread than it began in.
            ident = threading.get_ident()
            self._threads.remove(ident if ident in self._threads else self._threads[0])
            self._changed.notify_all()

    def wait(self, timeout_sec: float | None = None) -> bool:
        """Wait until nothing runs but what calls this.

        Args:
            timeout_sec: Longest wait in seconds; None or negative for any.

        Returns:
            False after the timeout.
        """
        if timeout_sec is not None and timeout_sec < 0:
            timeout_sec = None
        own = threading.get_ident()
        with self._changed:
            return self._changed.wait_for(
                lambda: all(ident == own for ident in self._threads), timeout_sec
            )
