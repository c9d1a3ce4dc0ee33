# SPDX-License-Identifier: Apache-2.0
"""What SIGINT and SIGTERM do: they end all spinning.

A handler written in Python runs only when the main thread is back in Python, and that may
be waiting inside DDS. Python can write the number of a signal to a pipe at once; a thread
reads it and invalidates the contexts, which wakes all waiting. Then the handler runs; after
SIGINT, it has Python raise KeyboardInterrupt in the main thread.
"""

from __future__ import annotations

import os
import signal
import threading
from enum import IntEnum
from types import FrameType
from typing import Any

from rclpy.context import initialized_contexts


class SignalHandlerOptions(IntEnum):
    """Which signals are handled."""

    NO = 0
    SIGINT = 1
    SIGTERM = 2
    ALL = 3


class _SignalPipe:
    """The thread that reacts to signals, and how things were before it."""

    def __init__(self) -> None:
        self.options = SignalHandlerOptions.NO
        self._previous: dict[int, Any] = {}
        self._previous_descriptor = -1
        self._write_descriptor = -1

    def install(self, options: SignalHandlerOptions) -> None:
        if threading.current_thread() is not threading.main_thread():
            return  # Python lets only the main thread set handlers.
        if options and self._write_descriptor < 0:
            self._start()
        for number, option in (
            (signal.SIGINT, SignalHandlerOptions.SIGINT),
            (signal.SIGTERM, SignalHandlerOptions.SIGTERM),
        ):
            if options & option and number not in self._previous:
                handler = signal.getsignal(number)
                self._previous[number] = handler
                signal.signal(number, self._handle)
        self.options = SignalHandlerOptions(self.options | options)

    def uninstall(self) -> None:
        if threading.current_thread() is not threading.main_thread():
            return
        for number, handler in self._previous.items():
            if signal.getsignal(number) == self._handle:
                signal.signal(number, handler)
        self._previous.clear()
        self.options = SignalHandlerOptions.NO
        if self._write_descriptor >= 0:
            signal.set_wakeup_fd(self._previous_descriptor)
            os.close(self._write_descriptor)
            self._write_descriptor = -1

    def _start(self) -> None:
        reading, writing = os.pipe()
        os.set_blocking(writing, False)
        self._write_descriptor = writing
        self._previous_descriptor = signal.set_wakeup_fd(writing, warn_on_full_buffer=False)
        threading.Thread(
            target=self._react, args=(reading,), name="rclpy_signals", daemon=True
        ).start()

    def _react(self, descriptor: int) -> None:
        while numbers := os.read(descriptor, 16):
            # A program may have put a handler of its own in our place meanwhile.
            if any(signal.getsignal(number) == self._handle for number in numbers):
                _invalidate_contexts()
        os.close(descriptor)

    def _handle(self, number: int, frame: FrameType | None) -> None:
        _invalidate_contexts()
        previous = self._previous.get(number)
        if callable(previous):
            previous(number, frame)


_pipe = _SignalPipe()


def install_signal_handlers(options: SignalHandlerOptions = SignalHandlerOptions.ALL) -> None:
    """Let signals invalidate the contexts. Has an effect in the main thread only.

    Args:
        options: Which signals.
    """
    _pipe.install(options)


def get_current_signal_handlers_options() -> SignalHandlerOptions:
    """Get which signals are handled.

    Returns:
        The signals.
    """
    return _pipe.options


def uninstall_signal_handlers() -> None:
    """Let signals do what they did before."""
    _pipe.uninstall()


def _invalidate_contexts() -> None:
    for context in list(initialized_contexts):
        context.invalidate()
