# SPDX-License-Identifier: Apache-2.0
"""Loggers, and the filters that let a call log only sometimes."""

from __future__ import annotations

import sys
import time
from types import FrameType
from typing import Any, ClassVar

from rclpy.clock import Clock
from rclpy.impl.log_output import LogRecord, log_output
from rclpy.impl.logging_severity import LoggingSeverity

#: What identifies a call: function, file, line and position in the bytecode.
CallSite = tuple[str, str, int, int]


class _Filter:
    """Decides for one call site whether to log."""

    #: Options of the filter and their defaults; None where one must be given.
    options: ClassVar[dict[str, Any]] = {}

    def __init__(self, values: dict[str, Any]) -> None:
        self.values = values

    def should_log(self) -> bool:
        raise NotImplementedError


class _Throttle(_Filter):
    options: ClassVar[dict[str, Any]] = {
        "throttle_duration_sec": None,
        "throttle_time_source_type": Clock(),
    }

    def __init__(self, values: dict[str, Any]) -> None:
        super().__init__(values)
        if not isinstance(values["throttle_time_source_type"], Clock):
            raise ValueError(
                "Received throttle_time_source_type of "
                f'"{values["throttle_time_source_type"]}" is not a clock instance'
            )
        self._last = 0.0

    def should_log(self) -> bool:
        now = self.values["throttle_time_source_type"].now().nanoseconds
        if now < self._last + self.values["throttle_duration_sec"] * 1e9:
            return False
        self._last = now
        return True


class _SkipFirst(_Filter):
    options: ClassVar[dict[str, Any]] = {"skip_first": None}
    _skipped = False

    def should_log(self) -> bool:
        skipped, self._skipped = self._skipped, True
        return skipped


class _Once(_Filter):
    options: ClassVar[dict[str, Any]] = {"once": None}
    _logged = False

    def should_log(self) -> bool:
        logged, self._logged = self._logged, True
        return not logged


_FILTERS: tuple[type[_Filter], ...] = (_Throttle, _SkipFirst, _Once)


class _CallState:
    """What a call site asked for the first time, which must not change."""

    def __init__(self, name: str, severity: LoggingSeverity, options: dict[str, Any]) -> None:
        self.name = name
        self.severity = severity
        self.kinds, values = _detect_filters(options)
        self.filters = [kind(values) for kind in self.kinds]

    def check(self, name: str, severity: LoggingSeverity, options: dict[str, Any]) -> None:
        if severity != self.severity:
            raise ValueError("Logger severity cannot be changed between calls.")
        if name != self.name:
            raise ValueError("Logger name cannot be changed between calls.")
        kinds, values = _detect_filters(options)
        if kinds != self.kinds:
            raise ValueError("Requested logging filters cannot be changed between calls.")
        for kind, state in zip(kinds, self.filters, strict=True):
            if any(state.values[option] != values[option] for option in kind.options):
                raise ValueError("Logging filter parameters cannot be changed between calls.")


def _detect_filters(options: dict[str, Any]) -> tuple[list[type[_Filter]], dict[str, Any]]:
    known = {option for kind in _FILTERS for option in kind.options}
    if unknown := options.keys() - known:
        raise TypeError(
            f'parameter "{sorted(unknown)[0]}" is not one of the recognized logging options '
            f'"{sorted(known)}"'
        )
    kinds = [kind for kind in _FILTERS if any(options.get(o) for o in kind.options)]
    values = dict(options)
    for kind in kinds:
        for option, default in kind.options.items():
            if values.setdefault(option, default) is None:
                raise TypeError(
                    f'required parameter "{option}" not specified but is required for the '
                    f'logging filter "{kind.__name__.strip("_")}"'
                )
    return kinds, values


class RcutilsLogger:
    """A logger; those of one name share their level."""

    def __init__(self, name: str = "") -> None:
        """Create a logger.

        Args:
            name: Name with dots between the generations, empty for the root.
        """
        self.name = name
        self.contexts: dict[CallSite, _CallState] = {}

    def get_child(self, name: str) -> RcutilsLogger:
        """Get a logger below this one.

        Args:
            name: Name below this logger.

        Returns:
            The child.

        Raises:
            ValueError: The name is empty.
        """
        if not name:
            raise ValueError("Child logger name must not be empty.")
        return RcutilsLogger(f"{self.name}.{name}" if self.name else name)

    def set_level(self, level: LoggingSeverity | int) -> None:
        """Set the lowest severity that is logged.

        Args:
            level: The severity, ``UNSET`` to follow the parent.
        """
        log_output.levels[self.name] = LoggingSeverity(level)

    def get_effective_level(self) -> LoggingSeverity:
        """Get the lowest severity that is logged.

        Returns:
            The severity.
        """
        return log_output.effective_level(self.name)

    def is_enabled_for(self, severity: LoggingSeverity | int) -> bool:
        """Tell whether messages of a severity are logged.

        Args:
            severity: The severity.

        Returns:
            Whether they are.
        """
        return LoggingSeverity(severity) >= self.get_effective_level()

    def log(self, message: object, severity: LoggingSeverity | int, **kwargs: Any) -> bool:
        """Log a message.

        Args:
            message: The text.
            severity: Its severity.
            **kwargs: ``throttle_duration_sec`` (and ``throttle_time_source_type``, a
                clock) to log at most so often, ``skip_first`` to log from the second time
                on, ``once`` to log the first time only, ``name`` for another logger name.

        Returns:
            Whether it was logged.

        Raises:
            TypeError: There is no such option.
            ValueError: The options differ from those of the last call from this place.
        """
        severity = LoggingSeverity(severity)
        if not self.is_enabled_for(severity):
            return False
        name = kwargs.pop("name", self.name)
        frame = _caller()
        site = (
            frame.f_code.co_name,
            frame.f_code.co_filename,
            frame.f_lineno,
            frame.f_lasti,
        )
        if state := self.contexts.get(site):
            state.check(name, severity, kwargs)
        else:
            state = self.contexts[site] = _CallState(name, severity, kwargs)
        # Not all(): each filter counts calls only if those before it let them pass.
        for log_filter in state.filters:
            if not log_filter.should_log():
                return False
        log_output.emit(LogRecord(name, severity, str(message), time.time_ns(), *site[:3]))
        return True

    def debug(self, message: object, **kwargs: Any) -> bool:
        """Log with the severity ``DEBUG``; see :meth:`log`."""
        return self.log(message, LoggingSeverity.DEBUG, **kwargs)

    def info(self, message: object, **kwargs: Any) -> bool:
        """Log with the severity ``INFO``; see :meth:`log`."""
        return self.log(message, LoggingSeverity.INFO, **kwargs)

    def warning(self, message: object, **kwargs: Any) -> bool:
        """Log with the severity ``WARN``; see :meth:`log`."""
        return self.log(message, LoggingSeverity.WARN, **kwargs)

    def warn(self, message: object, **kwargs: Any) -> bool:
        """Log with the severity ``WARN``; see :meth:`log`."""
        return self.warning(message, **kwargs)

    def error(self, message: object, **kwargs: Any) -> bool:
        """Log with the severity ``ERROR``; see :meth:`log`."""
        return self.log(message, LoggingSeverity.ERROR, **kwargs)

    def fatal(self, message: object, **kwargs: Any) -> bool:
        """Log with the severity ``FATAL``; see :meth:`log`."""
        return self.log(message, LoggingSeverity.FATAL, **kwargs)


def _caller() -> FrameType:
    frame = sys._getframe(1)
    while frame.f_code.co_filename == __file__ and frame.f_back is not None:
        frame = frame.f_back
    return frame
