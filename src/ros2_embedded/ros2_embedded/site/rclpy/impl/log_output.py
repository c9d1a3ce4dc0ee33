# SPDX-License-Identifier: Apache-2.0
"""Where log messages go: the console, and ``/rosout`` for the loggers of nodes."""

from __future__ import annotations

import os
import re
import sys
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass

from rclpy.impl.logging_severity import LoggingSeverity

_DEFAULT_FORMAT = "[{severity}] [{time}] [{name}]: {message}"
_COLOURS = {
    LoggingSeverity.DEBUG: "\033[32m",
    LoggingSeverity.WARN: "\033[33m",
    LoggingSeverity.ERROR: "\033[31m",
    LoggingSeverity.FATAL: "\033[31m",
}


@dataclass(frozen=True, slots=True)
class LogRecord:
    """A log message and where it comes from.

    Attributes:
        name: Name of the logger.
        severity: How grave it is.
        message: The text.
        nanoseconds: Time since 1970.
        function: Function that logs.
        file: Its file.
        line: Its line.
    """

    name: str
    severity: LoggingSeverity
    message: str
    nanoseconds: int
    function: str
    file: str
    line: int


class LogOutput:
    """Levels of the loggers and the places their messages go to."""

    def __init__(self) -> None:
        """Start with the level ``INFO`` and the console only."""
        self._lock = threading.Lock()
        self._subscribers: dict[str, list[Callable[[LogRecord], None]]] = {}
        self.clear()

    def clear(self) -> None:
        """Forget all levels that were set."""
        self.levels: dict[str, LoggingSeverity] = {}
        self.default_level = LoggingSeverity.INFO
        self.to_console = True

    def effective_level(self, name: str) -> LoggingSeverity:
        """Find the level of a logger: its own, or that of the next ancestor that has one.

        Args:
            name: Name with dots between the generations.

        Returns:
            The level.
        """
        while name:
            if level := self.levels.get(name):
                return level
            name = name.rpartition(".")[0]
        return self.levels.get("") or self.default_level

    def subscribe(self, name: str, callback: Callable[[LogRecord], None]) -> None:
        """Send the messages of a logger and its children to a callback as well.

        Args:
            name: Name of the logger.
            callback: Gets the messages.
        """
        with self._lock:
            self._subscribers.setdefault(name, []).append(callback)

    def unsubscribe(self, name: str, callback: Callable[[LogRecord], None]) -> None:
        """Stop what :meth:`subscribe` began.

        Args:
            name: Name of the logger.
            callback: The callback.
        """
        with self._lock:
            self._subscribers[name].remove(callback)

    def emit(self, record: LogRecord) -> None:
        """Send a message to all its places.

        Args:
            record: The message.
        """
        if self.to_console:
            self._print(record)
        name = record.name
        while name:
            with self._lock:
                callbacks = list(self._subscribers.get(name, ()))
            for callback in callbacks:
                callback(record)
            if callbacks:
                return
            name = name.rpartition(".")[0]

    def _print(self, record: LogRecord) -> None:
        stream = sys.stderr
        if os.environ.get("RCUTILS_LOGGING_USE_STDOUT") == "1":
            stream = sys.stdout
        seconds, nanoseconds = divmod(record.nanoseconds, 10**9)
        fields = {
            "severity": record.severity.name,
            "time": f"{seconds}.{nanoseconds:09d}",
            "time_as_nanoseconds": str(record.nanoseconds),
            "name": record.name,
            "message": record.message,
            "function_name": record.function,
            "file_name": record.file,
            "line_number": str(record.line),
            "date_time_with_ms": time.strftime("%Y-%m-%d %H:%M:%S", time.localtime(seconds))
            + f".{nanoseconds // 10**6:03d}",
        }
        pattern = os.environ.get("RCUTILS_CONSOLE_OUTPUT_FORMAT", _DEFAULT_FORMAT)
        line = re.sub(r"\{(\w+)\}", lambda found: fields.get(found[1], found[0]), pattern)
        coloured = os.environ.get("RCUTILS_COLORIZED_OUTPUT")
        colour = _COLOURS.get(record.severity)
        if colour and (coloured == "1" or (coloured != "0" and stream.isatty())):
            line = f"{colour}{line}\033[0m"
        print(line, file=stream, flush=True)


#: Levels and places of all loggers of this process.
log_output = LogOutput()
