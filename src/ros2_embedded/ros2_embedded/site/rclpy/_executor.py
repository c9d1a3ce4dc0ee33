# SPDX-License-Identifier: Apache-2.0
"""What all executors share."""

from __future__ import annotations

import time
import weakref
from types import TracebackType
from typing import TYPE_CHECKING, Any

from rclpy._work_finder import WorkFinder
from rclpy.context import Context
from rclpy.task import Future, Task
from rclpy.utilities import get_default_context

if TYPE_CHECKING:
    from rclpy.node import Node


class Executor(WorkFinder):
    """Base of the executors."""

    def __init__(self, *, context: Context | None = None) -> None:
        """Create an executor without nodes.

        Args:
            context: Ends the spinning when it is shut down; None for the default one.

        Raises:
            NotInitializedException: The context is not initialised.
        """
        super().__init__(context or get_default_context())

    @property
    def context(self) -> Context:
        """The context."""
        return self._context

    def add_node(self, node: Node) -> bool:
        """Take care of the callbacks of a node.

        Args:
            node: The node.

        Returns:
            False if that is so already.
        """
        with self._nodes_lock:
            if node in self._nodes:
                return False
            self._nodes.add(node)
            node.executor = self
        self.wake()
        return True

    def remove_node(self, node: Node) -> None:
        """Leave the callbacks of a node alone.

        Args:
            node: The node.
        """
        with self._nodes_lock:
            self._nodes.discard(node)
        self.wake()

    def shutdown(self, timeout_sec: float | None = None) -> bool:
        """Stop, and wait until the callbacks have finished.

        Args:
            timeout_sec: Longest wait in seconds; None or negative for any.

        Returns:
            False if callbacks still run after the timeout.
        """
        self._is_shutdown = True
        self._guard.trigger()
        if not self._work.wait(timeout_sec):
            return False
        with self._nodes_lock:
            self._nodes = set()
        return True

    def spin(self) -> None:
        """Run callbacks until the executor or the context is shut down."""
        while self._context.ok() and not self._is_shutdown:
            self.spin_once()

    def spin_until_future_complete(
        self, future: Future[Any], timeout_sec: float | None = None
    ) -> None:
        """Run callbacks until a future is done.

        Args:
            future: The future.
            timeout_sec: Longest wait in seconds; None or negative for any.
        """
        self._wake_when_done(future)
        end = None
        if timeout_sec is not None and timeout_sec >= 0:
            end = time.monotonic() + timeout_sec
        while self._context.ok() and not future.done() and not self._is_shutdown:
            left = None if end is None else max(end - time.monotonic(), 0.0)
            self.spin_once_until_future_complete(future, left)
            if end is not None and time.monotonic() >= end:
                return

    def spin_once(self, timeout_sec: float | None = None) -> None:
        """Run one callback.

        Args:
            timeout_sec: Longest wait in seconds; None or negative for any.

        Raises:
            ExternalShutdownException: The context was shut down.
        """
        raise NotImplementedError

    def spin_once_until_future_complete(
        self, future: Future[Any], timeout_sec: float | None = None
    ) -> None:
        """Run one callback, if a future is not done before.

        Args:
            future: The future.
            timeout_sec: Longest wait in seconds; None or negative for any.

        Raises:
            ExternalShutdownException: The context was shut down.
        """
        raise NotImplementedError

    def __enter__(self) -> Executor:
        return self

    def __exit__(
        self,
        exc_type: type[BaseException] | None,
        exc_val: BaseException | None,
        exc_tb: TracebackType | None,
    ) -> None:
        self.shutdown()

    def _run(self, task: Task[Any]) -> None:
        task()
        if not task.done():
            with self._tasks_lock:
                self._suspended_tasks.append(task)

    def _wake_when_done(self, future: Future[Any]) -> None:
        executor = weakref.ref(self)

        def wake(_: Future[Any]) -> None:
            if (alive := executor()) is not None:
                alive.wake()

        future.add_done_callback(wake)
