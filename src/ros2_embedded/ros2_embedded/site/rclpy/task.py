# SPDX-License-Identifier: Apache-2.0
"""Results to come, and the tasks that bring them."""

from __future__ import annotations

import inspect
import sys
import threading
import warnings
import weakref
from collections.abc import Callable, Coroutine, Generator
from typing import TYPE_CHECKING, Any, ClassVar, Generic, TypeVar

if TYPE_CHECKING:
    from rclpy._work_finder import WorkFinder

T = TypeVar("T")


class Future(Generic[T]):
    """A result that is there later."""

    #: Changes whenever some future is done; then awaiting coroutines may go on.
    completions: ClassVar[int] = 0

    def __init__(self, *, executor: WorkFinder | None = None) -> None:
        """Create a future without result.

        Args:
            executor: Runs the callbacks; without one they are called at once.
        """
        self._done = False
        self._cancelled = False
        self._result: T | None = None
        self._exception: BaseException | None = None
        self._exception_fetched = False
        self._callbacks: list[Callable[[Future[T]], object]] = []
        self._lock = threading.Lock()
        self._executor: weakref.ref[WorkFinder] | None = None
        self._set_executor(executor)

    def __del__(self) -> None:
        """Report an exception that nobody asked for."""
        if self._exception is not None and not self._exception_fetched:
            print(
                f"The following exception was never retrieved: {self._exception}",
                file=sys.stderr,
            )

    def __await__(self) -> Generator[None, None, T | None]:
        """Wait for the result."""
        while not self._done:
            yield
        return self.result()

    def cancel(self) -> None:
        """Ask to give up, if it is not done."""
        with self._lock:
            if not self._done:
                self._cancelled = True
        self._run_callbacks()

    def cancelled(self) -> bool:
        """Tell whether it was cancelled.

        Returns:
            Whether it was.
        """
        return self._cancelled

    def done(self) -> bool:
        """Tell whether there is a result or an exception.

        Returns:
            Whether there is.
        """
        return self._done

    def result(self) -> T | None:
        """Get the result.

        Returns:
            The result, None if there is none yet.

        Raises:
            BaseException: The exception that was set.
        """
        if self._exception is not None:
            self._exception_fetched = True
            raise self._exception
        return self._result

    def exception(self) -> BaseException | None:
        """Get the exception.

        Returns:
            The exception, or None.
        """
        self._exception_fetched = True
        return self._exception

    def set_result(self, result: T) -> None:
        """Finish with a result.

        Args:
            result: The result.
        """
        with self._lock:
            self._result = result
            self._done = True
            self._cancelled = False
        self._run_callbacks()

    def set_exception(self, exception: BaseException) -> None:
        """Finish with an exception.

        Args:
            exception: The exception.
        """
        with self._lock:
            self._exception = exception
            self._exception_fetched = False
            self._done = True
            self._cancelled = False
        self._run_callbacks()

    def add_done_callback(self, callback: Callable[[Future[T]], object]) -> None:
        """Have something called when the future is done, or now if it is.

        Args:
            callback: Gets the future.
        """
        with self._lock:
            if not self._done:
                self._callbacks.append(callback)
                return
            executor = self._executor() if self._executor else None
        if executor is not None:
            executor.create_task(callback, self)
        else:
            callback(self)

    def _set_executor(self, executor: WorkFinder | None) -> None:
        with self._lock:
            self._executor = None if executor is None else weakref.ref(executor)

    def _run_callbacks(self) -> None:
        with self._lock:
            executor = self._executor() if self._executor else None
            callbacks, self._callbacks = self._callbacks, []
        Future.completions += 1
        if executor is not None:
            executor.wake()
        for callback in callbacks:
            if executor is not None:
                executor.create_task(callback, self)
                continue
            try:
                callback(self)
            except Exception as error:
                # The others must still be called.
                warnings.warn(f"Unhandled exception in done callback: {error}", stacklevel=2)


class Task(Future[T]):
    """A function or coroutine that an executor runs, and its result."""

    def __init__(
        self,
        handler: Callable[..., Any],
        args: tuple[Any, ...] | list[Any] | None = None,
        kwargs: dict[str, Any] | None = None,
        executor: WorkFinder | None = None,
    ) -> None:
        """Prepare a task; only executors do so.

        Args:
            handler: Function or coroutine function.
            args: Its positional arguments.
            kwargs: Its keyword arguments.
            executor: Executor that runs it.
        """
        super().__init__(executor=executor)
        self._handler: Callable[..., Any] | None = None
        self._coroutine: Coroutine[Any, Any, Any] | None = None
        self._args = tuple(args or ())
        self._kwargs = kwargs or {}
        if inspect.iscoroutinefunction(handler):
            self._coroutine = handler(*self._args, **self._kwargs)
        else:
            self._handler = handler
        self._executing = False
        # Keeps the task from running in two threads.
        self._task_lock = threading.Lock()

    def __call__(self) -> None:
        """Run the function, or the coroutine up to its next ``await`` of something to come."""
        if self._done or self._executing or not self._task_lock.acquire(blocking=False):
            return
        try:
            if self._done:
                return
            self._executing = True
            try:
                self._step()
            except Exception as error:
                self.set_exception(error)
            if self._done:
                self._handler = self._coroutine = None
                self._args, self._kwargs = (), {}
            self._executing = False
        finally:
            self._task_lock.release()

    def _step(self) -> None:
        if self._coroutine is not None:
            try:
                self._coroutine.send(None)
            except StopIteration as finished:
                self._coroutine.close()
                self.set_result(finished.value)
        elif self._handler is not None:
            self.set_result(self._handler(*self._args, **self._kwargs))

    def executing(self) -> bool:
        """Tell whether it is running at the moment.

        Returns:
            Whether it is.
        """
        return self._executing
