# SPDX-License-Identifier: Apache-2.0
"""Timers, rates and guard conditions."""

from __future__ import annotations

import threading

import pytest
from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from rclpy.exceptions import InvalidHandle, ROSInterruptException


def test_timer_repeats(node, executor, spin_until):
    calls = []
    clock = Clock(clock_type=ClockType.STEADY_TIME)
    executor.add_node(node)
    start = clock.now()
    node.create_timer(0.02, lambda: calls.append(clock.now()), clock=clock)
    spin_until(executor, lambda: len(calls) == 5)
    assert (calls[-1] - start).nanoseconds >= 5 * 20_000_000
    for number, call in enumerate(calls, start=1):
        assert (call - start).nanoseconds >= number * 20_000_000


@pytest.mark.parametrize("kind", [ClockType.ROS_TIME, ClockType.SYSTEM_TIME, ClockType.STEADY_TIME])
def test_clocks_of_timers(kind, node, executor, spin_until):
    calls = []
    executor.add_node(node)
    clock = Clock(clock_type=kind)
    timer = node.create_timer(0.001, lambda: calls.append(1), clock=clock)
    assert timer.clock is clock
    spin_until(executor, lambda: calls)


def test_cancel_and_reset(node, executor, spin_until):
    calls = []
    executor.add_node(node)
    timer = node.create_timer(0.005, lambda: calls.append(1))
    spin_until(executor, lambda: calls)
    timer.cancel()
    assert timer.is_canceled()
    assert not timer.is_ready()
    assert timer.time_until_next_call() is None
    count = len(calls)
    for _ in range(3):
        executor.spin_once(timeout_sec=0.02)
    assert len(calls) == count
    timer.reset()
    assert not timer.is_canceled()
    spin_until(executor, lambda: len(calls) > count)


def test_timer_can_be_created_stopped(node, executor, spin_until):
    calls = []
    executor.add_node(node)
    timer = node.create_timer(0.001, lambda: calls.append(1), autostart=False)
    assert timer.is_canceled()
    executor.spin_once(timeout_sec=0.02)
    assert calls == []
    timer.reset()
    spin_until(executor, lambda: calls)


def test_timer_cancels_itself(node, executor, spin_until):
    calls = []
    executor.add_node(node)

    def once():
        calls.append(1)
        timer.cancel()

    timer = node.create_timer(0.001, once)
    spin_until(executor, lambda: calls)
    for _ in range(3):
        executor.spin_once(timeout_sec=0.01)
    assert calls == [1]


def test_period_and_times(node):
    timer = node.create_timer(10.0, lambda: None)
    assert timer.timer_period_ns == 10_000_000_000
    assert 0 < timer.time_until_next_call() <= 10_000_000_000
    assert timer.time_since_last_call() >= 0
    assert not timer.is_ready()
    timer.timer_period_ns = 5_000_000
    assert timer.timer_period_ns == 5_000_000


def test_zero_period_is_always_ready(node, executor):
    calls = []
    executor.add_node(node)
    node.create_timer(0.0, lambda: calls.append(1))
    for _ in range(5):
        executor.spin_once(timeout_sec=1.0)
    assert len(calls) >= 4


def test_negative_period_is_refused(node):
    with pytest.raises(RuntimeError):
        node.create_timer(-1.0, lambda: None)


def test_destroyed_timer(node, executor):
    calls = []
    executor.add_node(node)
    timer = node.create_timer(0.0, lambda: calls.append(1))
    assert node.destroy_timer(timer)
    assert not node.destroy_timer(timer)
    executor.spin_once(timeout_sec=0.02)
    assert calls == []
    assert list(node.timers) == []
    with pytest.raises(InvalidHandle):
        timer.cancel()


def test_guard_condition(node, executor, spin_until):
    calls = []
    executor.add_node(node)
    guard = node.create_guard_condition(lambda: calls.append(1))
    executor.spin_once(timeout_sec=0.02)
    assert calls == []
    guard.trigger()
    spin_until(executor, lambda: calls)
    executor.spin_once(timeout_sec=0.02)
    assert calls == [1]
    assert node.destroy_guard_condition(guard)
    with pytest.raises(InvalidHandle):
        guard.trigger()


def test_guard_condition_wakes_another_thread(node, executor):
    called = threading.Event()
    executor.add_node(node)
    guard = node.create_guard_condition(called.set)
    thread = threading.Thread(target=executor.spin)
    thread.start()
    guard.trigger()
    assert called.wait(timeout=20.0)
    executor.shutdown()
    thread.join(timeout=20.0)
    assert not thread.is_alive()


def test_rate(node, executor):
    executor.add_node(node)
    thread = threading.Thread(target=executor.spin)
    thread.start()
    rate = node.create_rate(200.0)
    start = node.get_clock().now()
    for _ in range(5):
        rate.sleep()
    assert (node.get_clock().now() - start).nanoseconds >= 4 * 5_000_000
    node.destroy_rate(rate)
    with pytest.raises(RuntimeError):
        rate.sleep()
    executor.shutdown()
    thread.join(timeout=20.0)


def test_rate_needs_a_positive_frequency(node):
    with pytest.raises(ValueError, match="frequency"):
        node.create_rate(0.0)


def test_shutdown_ends_the_sleep_of_a_rate(node, context):
    rate = node.create_rate(0.001)
    raised = []

    def sleep():
        try:
            rate.sleep()
        except ROSInterruptException as error:
            raised.append(error)

    thread = threading.Thread(target=sleep)
    thread.start()
    context.shutdown()
    thread.join(timeout=20.0)
    assert len(raised) == 1
