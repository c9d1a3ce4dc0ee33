# SPDX-License-Identifier: Apache-2.0
"""The executors, which run the callbacks of nodes."""

from __future__ import annotations

import os
import threading
import warnings
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

from rclpy._entity import call_or_await as await_or_execute
from rclpy._executor import Executor
from rclpy._work_finder import (
    ConditionReachedException,
    ExternalShutdownException,
    ShutdownException,
    TimeoutException,
)
from rclpy.context import Context
from rclpy.task import Future, Task

__all__ = [
    "ConditionReachedException",
    "Executor",
    "ExternalShutdownException",
    "MultiThreadedExecutor",
    "ShutdownException",
    "SingleThreadedExecutor",
    "TimeoutException",
    "await_or_execute",
]


class SingleThreadedExecutor(Executor):
    """Runs callbacks in the thread that spins."""

    def spin_once(self, timeout_sec: float | None = None) -> None:
        """Run one callback; see :meth:`Executor.spin_once`."""
        self._spin_once(timeout_sec, lambda: False)

    def spin_once_until_future_complete(
        self, future: Future[Any], timeout_sec: float | None = None
    ) -> None:
        """Run one callback, if a future is not done before."""
        self._spin_once(timeout_sec, future.done)

    def _spin_once(self, timeout_sec: float | None, condition: Callable[[], bool]) -> None:
        try:
            task, _, _ = self.wait_for_ready_callbacks(timeout_sec, None, condition)
        except (ShutdownException, TimeoutException, ConditionReachedException):
            return
        self._run(task)
        if (error := task.exception()) is not None:
            raise error


class MultiThreadedExecutor(Executor):
    """Runs callbacks in a pool of threads, in parallel as far as their groups allow."""

    def __init__(self, num_threads: int | None = None, *, context: Context | None = None) -> None:
        """Create an executor without nodes.

        Args:
            num_threads: Threads of the pool; None for one for each processor the program
                may use.
            context: Ends the spinning when it is shut down; None for the default one.

        Raises:
            NotInitializedException: The context is not initialised.
        """
        super().__init__(context=context)
        if num_threads is None:
            num_threads = len(os.sched_getaffinity(0)) or 2
        if num_threads == 1:
            warnings.warn(
                "MultiThreadedExecutor is used with a single thread.\n"
                "Use the SingleThreadedExecutor instead.",
                stacklevel=2,
            )
        self._running: list[Task[Any]] = []
        self._executor = ThreadPoolExecutor(num_threads)
        _start_all_threads(self._executor, num_threads)

    def spin_once(self, timeout_sec: float | None = None) -> None:
        """Start one callback, or continue one; see :meth:`Executor.spin_once`."""
        self._spin_once(timeout_sec, lambda: False)

    def spin_once_until_future_complete(
        self, future: Future[Any], timeout_sec: float | None = None
    ) -> None:
        """Start one callback, if a future is not done before."""
        self._spin_once(timeout_sec, future.done)

    def _spin_once(self, timeout_sec: float | None, condition: Callable[[], bool]) -> None:
        try:
            task, _, _ = self.wait_for_ready_callbacks(
                timeout_sec, None, lambda: condition() or self._has_failed_task()
            )
        except (
            ExternalShutdownException,
            ShutdownException,
            TimeoutException,
            ConditionReachedException,
        ):
            pass
        else:
            self._executor.submit(self._run, task)
            if task not in self._running:
                self._running.append(task)
        for finished in [task for task in self._running if task.done()]:
            self._running.remove(finished)
            finished.result()

    def _has_failed_task(self) -> bool:
        return any(task.done() and task.exception() is not None for task in self._running)


def _start_all_threads(pool: ThreadPoolExecutor, number: int) -> None:
    # A pool starts its threads when they are needed. If SIGINT interrupts that, a thread runs
    # that the pool does not know, and the program waits for it for ever at its end.
    together = threading.Barrier(number + 1)
    for _ in range(number):
        pool.submit(together.wait)
    together.wait()
