# SPDX-License-Identifier: Apache-2.0
"""The default context and other things of the whole program."""

from __future__ import annotations

import sys
import threading
from collections.abc import Sequence

from rclpy._arguments import split_arguments
from rclpy.constants import S_TO_NS
from rclpy.context import Context

g_default_context: Context | None = None
g_context_lock = threading.Lock()

_RMW = "rmw_cyclonedds_cpp"


def get_default_context(*, shutting_down: bool = False) -> Context:
    """Get the default context.

    Args:
        shutting_down: Forget it, so that the next call makes a new one.

    Returns:
        The context.
    """
    global g_default_context
    with g_context_lock:
        context = g_default_context or Context()
        g_default_context = None if shutting_down else context
        return context


def remove_ros_args(args: Sequence[str] | None = None) -> list[str]:
    """Drop the ROS arguments of a command line.

    Args:
        args: The command line; None for that of the program.

    Returns:
        The other arguments.
    """
    return split_arguments(sys.argv if args is None else args)[0]


def ok(*, context: Context | None = None) -> bool:
    """Tell whether a context is initialised and not shut down.

    Args:
        context: The context; None for the default one.

    Returns:
        Whether it is.
    """
    return (context or get_default_context()).ok()


def shutdown(*, context: Context | None = None) -> None:
    """Shut a context down.

    Args:
        context: The context; None for the default one.

    Raises:
        RuntimeError: It is not initialised, or was shut down before.
    """
    (context or get_default_context(shutting_down=True)).shutdown()


def try_shutdown(*, context: Context | None = None) -> None:
    """Shut a context down, if that has not been done.

    Args:
        context: The context; None for the default one.
    """
    (context or get_default_context(shutting_down=True)).try_shutdown()


def get_rmw_implementation_identifier() -> str:
    """Get the name of the middleware that this one is compatible with.

    Returns:
        ``rmw_cyclonedds_cpp``.
    """
    return _RMW


def get_available_rmw_implementations() -> set[str]:
    """Get the names of the middlewares.

    Returns:
        The only one.
    """
    return {_RMW}


def timeout_sec_to_nsec(timeout_sec: float | None) -> int:
    """Convert a timeout.

    Args:
        timeout_sec: Seconds; None or negative for none.

    Returns:
        Nanoseconds, -1 for none.
    """
    if timeout_sec is None or timeout_sec < 0:
        return -1
    return int(float(timeout_sec) * S_TO_NS)
