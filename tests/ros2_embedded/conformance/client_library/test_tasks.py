# SPDX-License-Identifier: Apache-2.0
"""Futures."""

from __future__ import annotations

import pytest
from rclpy.task import Future


def test_result():
    future = Future()
    assert not future.done()
    assert future.result() is None
    future.set_result("value")
    assert future.done()
    assert not future.cancelled()
    assert future.result() == "value"
    assert future.exception() is None


def test_exception():
    future = Future()
    error = ArithmeticError("failed")
    future.set_exception(error)
    assert future.done()
    assert future.exception() is error
    with pytest.raises(ArithmeticError, match="failed"):
        future.result()


def test_cancel():
    future = Future()
    future.cancel()
    assert future.cancelled()
    assert not future.done()


def test_done_callbacks_are_called_once():
    future = Future()
    seen = []
    future.add_done_callback(seen.append)
    assert seen == []
    future.set_result(1)
    assert seen == [future]
    future.add_done_callback(seen.append)
    assert seen == [future, future]


def test_error_in_a_callback_does_not_stop_others():
    future = Future()
    seen = []

    def fail(_):
        raise ArithmeticError("callback")

    future.add_done_callback(fail)
    future.add_done_callback(seen.append)
    with pytest.warns(UserWarning, match="callback"):
        future.set_result(1)
    assert seen == [future]


def test_future_can_be_awaited():
    future = Future()

    async def double():
        return 2 * await future

    coroutine = double()
    coroutine.send(None)
    future.set_result(4)
    with pytest.raises(StopIteration) as stopped:
        coroutine.send(None)
    assert stopped.value.value == 8


def test_lost_exception_is_reported(capsys):
    future = Future()
    future.set_exception(ArithmeticError("nobody asked"))
    del future
    assert "nobody asked" in capsys.readouterr().err
