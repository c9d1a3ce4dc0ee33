# SPDX-License-Identifier: Apache-2.0
"""Logging by name."""

from __future__ import annotations

import os
from pathlib import Path

from rclpy.impl.log_output import log_output
from rclpy.impl.logging_severity import LoggingSeverity
from rclpy.impl.rcutils_logger import RcutilsLogger

_root_logger = RcutilsLogger()


def get_logger(name: str) -> RcutilsLogger:
    """Get a logger.

    Args:
        name: Its name.

    Returns:
        The logger.

    Raises:
        ValueError: The name is empty.
    """
    if not name:
        raise ValueError("Logger name must not be empty.")
    return _root_logger.get_child(name)


def initialize() -> None:
    """Set up logging, which is so already."""


def shutdown() -> None:
    """Forget all levels."""
    log_output.clear()


def clear_config() -> None:
    """Forget all levels."""
    log_output.clear()


def set_logger_level(name: str, level: int | LoggingSeverity, detailed_error: bool = False) -> None:
    """Set the lowest severity that a logger logs.

    Args:
        name: Name of the logger, empty for the root.
        level: The severity.
        detailed_error: Not used.
    """
    log_output.levels[name] = LoggingSeverity(level)


def get_logger_effective_level(name: str) -> LoggingSeverity:
    """Get the lowest severity that a logger logs.

    Args:
        name: Name of the logger.

    Returns:
        The severity.
    """
    return log_output.effective_level(name)


def get_logger_level(name: str) -> LoggingSeverity:
    """Get the level that was set for a logger.

    Args:
        name: Name of the logger.

    Returns:
        The level, ``UNSET`` if none was.
    """
    return log_output.levels.get(name, LoggingSeverity.UNSET)


def get_logging_severity_from_string(log_severity: str) -> LoggingSeverity:
    """Get a severity by name.

    Args:
        log_severity: Name in any case.

    Returns:
        The severity.

    Raises:
        RuntimeError: There is no such severity.
    """
    try:
        return LoggingSeverity[log_severity.upper()]
    except KeyError:
        raise RuntimeError(f"there is no severity {log_severity!r}") from None


def get_logging_directory() -> Path:
    """Get the directory for log files; none are written here.

    Returns:
        The directory that ROS would use.
    """
    if directory := os.environ.get("ROS_LOG_DIR"):
        return Path(directory).expanduser()
    home = os.environ.get("ROS_HOME") or "~/.ros"
    return Path(home).expanduser() / "log"
