# SPDX-License-Identifier: Apache-2.0
"""Contexts: the time between initialisation and shutdown."""

from __future__ import annotations

import os
import sys
import threading
import weakref
from collections.abc import Callable
from inspect import ismethod
from types import TracebackType
from typing import TYPE_CHECKING, Any

from rclpy._arguments import RosArguments, parse_arguments
from rclpy._rclpy_pybind11 import RCLError
from rclpy.exceptions import NotInitializedException
from rclpy.impl.log_output import log_output
from rclpy.impl.logging_severity import LoggingSeverity

if TYPE_CHECKING:
    from ros2_embedded.dds.graph import Graph
    from ros2_embedded.dds.participant import Participant
    from ros2_embedded.dds.waitset import Guard

_MAX_DOMAIN_ID = 232

#: Contexts to shut down when a signal says so.
initialized_contexts: weakref.WeakSet[Context] = weakref.WeakSet()


class Context:
    """One participation in ROS; nodes belong to one. It is not used again after shutdown."""

    def __init__(self) -> None:
        self._lock = threading.RLock()
        self._callbacks: list[Callable[[], Callable[[], object] | None]] = []
        self._valid = False
        self._participant: Participant | None = None
        self._graph: Graph | None = None
        self._guards: weakref.WeakSet[Guard] = weakref.WeakSet()
        self.arguments = RosArguments()

    def init(
        self,
        args: list[str] | None = None,
        *,
        initialize_logging: bool = True,
        domain_id: int | None = None,
    ) -> None:
        """Join a ROS domain.

        Args:
            args: Command line with ROS arguments; None for that of the program.
            initialize_logging: Whether to obey its log levels.
            domain_id: The domain; None to take it from ``ROS_DOMAIN_ID``.

        Raises:
            RuntimeError: The context was initialised before, the domain does not exist or
                cannot be joined, or a ROS argument is wrong.
        """
        with self._lock:
            if domain_id is not None and domain_id < 0:
                raise RuntimeError(f"Domain id ({domain_id}) should not be lower than zero.")
            if self._participant is not None:
                raise RuntimeError("Context.init() must only be called once")
            self.arguments = parse_arguments(sys.argv if args is None else args)
            self._join(_default_domain() if domain_id is None else domain_id)
            if initialize_logging:
                self._configure_logging()
            self._valid = True
            initialized_contexts.add(self)

    @property
    def participant(self) -> Participant:
        """The DDS participant.

        Raises:
            NotInitializedException: The context is not initialised.
        """
        if self._participant is None:
            raise NotInitializedException()
        return self._participant

    @property
    def graph(self) -> Graph:
        """The nodes and endpoints of the domain.

        Raises:
            NotInitializedException: The context is not initialised.
        """
        if self._graph is None:
            raise NotInitializedException()
        return self._graph

    @property
    def handle(self) -> Any:
        """The inner state, None before initialisation."""
        return self._participant

    def ok(self) -> bool:
        """Tell whether the context is initialised and not shut down.

        Returns:
            Whether it is.
        """
        return self._valid

    def destroy(self) -> None:
        """Free what the context holds."""
        self.try_shutdown()

    def shutdown(self) -> None:
        """Leave the domain.

        Raises:
            RuntimeError: The context is not initialised, or was shut down before.
        """
        with self._lock:
            if self._participant is None:
                raise RuntimeError("Context must be initialized before it can be shutdown")
            was_valid = self._valid
            self.try_shutdown()
        if not was_valid:
            raise RCLError("failed to shutdown: rcl_shutdown already called on the given context")

    def try_shutdown(self) -> None:
        """Leave the domain, if that has not been done."""
        with self._lock:
            if self._participant is None:
                return
            self.invalidate()
            callbacks, self._callbacks = self._callbacks, []
            for get_callback in callbacks:
                callback = get_callback()
                if callback is not None:
                    callback()
            self._participant.close()

    def invalidate(self) -> None:
        """End all waiting, as a signal does; the domain is left by a shutdown later."""
        self._valid = False
        initialized_contexts.discard(self)
        for guard in list(self._guards):
            guard.trigger()

    def wake_on_shutdown(self, guard: Guard) -> None:
        """Have a guard condition triggered when the context becomes invalid.

        Args:
            guard: The guard condition.
        """
        self._guards.add(guard)

    def on_shutdown(self, callback: Callable[[], object]) -> None:
        """Have something called at shutdown, or now if that has been.

        Args:
            callback: A callable; methods are held weakly.

        Raises:
            TypeError: It cannot be called.
        """
        if not callable(callback):
            raise TypeError("callback should be a callable, got {}", type(callback))
        with self._lock:
            if self._participant is None or self._valid:
                weak = weakref.WeakMethod(callback) if ismethod(callback) else None
                self._callbacks.append(weak or (lambda: callback))
                return
        callback()

    def get_domain_id(self) -> int:
        """Get the domain.

        Returns:
            Its number.

        Raises:
            RuntimeError: The context is not initialised.
        """
        if self._participant is None:
            raise RuntimeError("Context must be initialized before it can have a domain id")
        return self._participant.domain_id

    def __enter__(self) -> Context:
        """Initialise with the command line of the program."""
        self.init()
        return self

    def __exit__(
        self,
        exc_type: type[BaseException] | None,
        exc_val: BaseException | None,
        exc_tb: TracebackType | None,
    ) -> None:
        """Shut down."""
        self.try_shutdown()

    def _join(self, domain_id: int) -> None:
        # Imported late: programs import rclpy also where they never initialise it.
        from cyclonedds.core import DDSException

        from ros2_embedded.dds.graph import Graph
        from ros2_embedded.dds.participant import Participant

        if domain_id > _MAX_DOMAIN_ID:
            raise RCLError(f"failed to initialize rcl: there is no domain {domain_id}")
        try:
            self._participant = Participant(domain_id)
        except (DDSException, ValueError) as error:
            raise RCLError(f"failed to initialize rcl: {error}") from error
        self._graph = Graph(self._participant)

    def _configure_logging(self) -> None:
        for name, level in self.arguments.log_levels.items():
            if name:
                log_output.levels[name] = LoggingSeverity(level)
            else:
                log_output.default_level = LoggingSeverity(level)
        log_output.to_console = self.arguments.switches.get("stdout", True)


def _default_domain() -> int:
    text = os.environ.get("ROS_DOMAIN_ID", "")
    try:
        return int(text) if text else 0
    except ValueError:
        raise RCLError(f"ROS_DOMAIN_ID is not a number: {text!r}") from None
