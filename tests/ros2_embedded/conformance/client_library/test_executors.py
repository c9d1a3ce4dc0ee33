# SPDX-License-Identifier: Apache-2.0
"""Executors: spinning, tasks, threads, shutdown."""

from __future__ import annotations

import threading

import pytest
import rclpy
from rclpy.executors import (
    ExternalShutdownException,
    MultiThreadedExecutor,
    SingleThreadedExecutor,
)
from rclpy.task import Future
from std_msgs.msg import Int64, String


@pytest.fixture(params=["single", "multi"])
def spinning(request, context):
    """An executor that another thread spins."""
    if request.param == "single":
        executor = SingleThreadedExecutor(context=context)
    else:
        executor = MultiThreadedExecutor(num_threads=3, context=context)
    thread = threading.Thread(target=executor.spin)
    thread.start()
    yield executor
    executor.shutdown()
    thread.join(timeout=20.0)
    assert not thread.is_alive()


def test_nodes_of_an_executor(make_node, executor):
    first, second = make_node("first"), make_node("second")
    assert executor.add_node(first)
    assert not executor.add_node(first)
    assert executor.add_node(second)
    assert set(executor.get_nodes()) == {first, second}
    assert first.executor is executor
    executor.remove_node(first)
    assert executor.get_nodes() == [second]


def test_node_moves_to_another_executor(node, context):
    first = SingleThreadedExecutor(context=context)
    second = SingleThreadedExecutor(context=context)
    first.add_node(node)
    node.executor = second
    assert first.get_nodes() == []
    assert second.get_nodes() == [node]
    node.executor = None
    assert second.get_nodes() == []
    assert node.executor is None
    first.shutdown()
    second.shutdown()


def test_spin_once_runs_one_callback(node, executor):
    calls = []
    executor.add_node(node)
    node.create_timer(0.0, lambda: calls.append("a"))
    node.create_timer(0.0, lambda: calls.append("b"))
    executor.spin_once(timeout_sec=1.0)
    assert len(calls) == 1
    executor.spin_once(timeout_sec=1.0)
    assert sorted(calls) == ["a", "b"]


def test_spin_once_waits_no_longer_than_asked(node, executor):
    executor.add_node(node)
    clock = node.get_clock()
    start = clock.now()
    executor.spin_once(timeout_sec=0.05)
    assert (clock.now() - start).nanoseconds >= 49_000_000
    start = clock.now()
    executor.spin_once(timeout_sec=0)
    assert (clock.now() - start).nanoseconds < 10**9


def test_no_callback_is_starved(node, executor):
    counts = {"timer": 0, "guard": 0}
    executor.add_node(node)

    def timer():
        counts["timer"] += 1

    def guarded():
        counts["guard"] += 1
        guard.trigger()

    node.create_timer(0.0, timer)
    guard = node.create_guard_condition(guarded)
    guard.trigger()
    for _ in range(100):
        executor.spin_once(timeout_sec=1.0)
    assert min(counts.values()) > 20


def test_callback_error_reaches_the_spinner(node, executor, spin_until):
    executor.add_node(node)

    def fail():
        raise ArithmeticError("in a callback")

    timer = node.create_timer(0.001, fail)
    with pytest.raises(ArithmeticError, match="in a callback"):
        spin_until(executor, lambda: False)
    timer.cancel()
    executor.spin_once(timeout_sec=0.0)


def test_spin_until_future_complete(node, executor):
    future = Future()
    executor.add_node(node)
    node.create_timer(0.001, lambda: future.done() or future.set_result("done"))
    executor.spin_until_future_complete(future, timeout_sec=20.0)
    assert future.result() == "done"


def test_spin_until_future_complete_gives_up(node, executor):
    future = Future()
    executor.add_node(node)
    executor.spin_until_future_complete(future, timeout_sec=0.05)
    assert not future.done()
    executor.spin_until_future_complete(future, timeout_sec=0)
    assert not future.done()


def test_future_done_in_another_thread_ends_the_spin(node, executor):
    future = Future()
    executor.add_node(node)
    threading.Timer(0.05, future.set_result, args=["done"]).start()
    executor.spin_until_future_complete(future)
    assert future.result() == "done"


def test_future_that_is_done_needs_no_spin(node, executor):
    future = Future()
    future.set_result(1)
    executor.add_node(node)
    executor.spin_until_future_complete(future)


def test_module_function_spins_a_future(node, executor):
    future = Future()
    node.create_timer(0.001, lambda: future.done() or future.set_result(1))
    rclpy.spin_until_future_complete(node, future, executor, timeout_sec=20.0)
    assert future.result() == 1
    assert executor.get_nodes() == []


def test_task(executor):
    task = executor.create_task(lambda a, b: a + b, 1, b=2)
    executor.spin_until_future_complete(task, timeout_sec=20.0)
    assert task.result() == 3


def test_task_error(executor):
    def fail():
        raise KeyError("task")

    task = executor.create_task(fail)
    with pytest.raises(KeyError, match="task"):
        executor.spin_until_future_complete(task, timeout_sec=20.0)


def test_coroutine_task(executor):
    gate = Future(executor=executor)

    async def wait(factor):
        return factor * await gate

    task = executor.create_task(wait, 3)
    executor.spin_once(timeout_sec=0.0)
    assert not task.done()
    gate.set_result(7)
    executor.spin_until_future_complete(task, timeout_sec=20.0)
    assert task.result() == 21


def test_done_callback_runs_in_the_executor(executor, spin_until):
    seen = []
    task = executor.create_task(lambda: "value")
    task.add_done_callback(lambda future: seen.append(future.result()))
    spin_until(executor, lambda: seen)
    assert seen == ["value"]


def test_entities_created_while_spinning(spinning, node):
    spinning.add_node(node)
    fired = threading.Event()
    node.create_timer(0.001, fired.set)
    assert fired.wait(timeout=20.0)


def test_node_added_while_spinning(spinning, make_node):
    fired = threading.Event()
    node = make_node("late")
    node.create_timer(0.001, fired.set)
    spinning.add_node(node)
    assert fired.wait(timeout=20.0)


def test_entities_destroyed_while_spinning(spinning, node):
    spinning.add_node(node)
    for _ in range(20):
        fired = threading.Event()
        timer = node.create_timer(0.001, fired.set)
        subscription = node.create_subscription(String, "gone", lambda message: None, 10)
        assert fired.wait(timeout=20.0)
        node.destroy_timer(timer)
        node.destroy_subscription(subscription)


def test_messages_between_threads(spinning, node, topic):
    received = []
    everything = threading.Event()

    def take(message):
        received.append(message.data)
        if len(received) == 100:
            everything.set()

    spinning.add_node(node)
    node.create_subscription(Int64, topic, take, 100)
    publisher = node.create_publisher(Int64, topic, 100)
    matched = threading.Event()
    timer = node.create_timer(
        0.001, lambda: publisher.get_subscription_count() == 1 and matched.set()
    )
    assert matched.wait(timeout=20.0)
    timer.cancel()
    for number in range(100):
        publisher.publish(Int64(data=number))
    assert everything.wait(timeout=20.0)
    assert received == list(range(100))


def test_task_from_another_thread(spinning):
    assert_in_time = threading.Event()
    spinning.create_task(assert_in_time.set)
    assert assert_in_time.wait(timeout=20.0)


def test_shutdown_ends_the_spin(node, context):
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    thread = threading.Thread(target=executor.spin)
    thread.start()
    assert executor.shutdown()
    thread.join(timeout=20.0)
    assert not thread.is_alive()


def test_context_shutdown_ends_the_spin(node, context):
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    outcome = []

    def spin():
        try:
            executor.spin()
            outcome.append("returned")
        except ExternalShutdownException:
            outcome.append("raised")

    started = threading.Event()
    node.create_timer(0.001, started.set)
    thread = threading.Thread(target=spin)
    thread.start()
    assert started.wait(timeout=20.0)
    context.shutdown()
    thread.join(timeout=20.0)
    assert outcome


def test_multi_threaded_executor_reports_errors(node, context):
    executor = MultiThreadedExecutor(num_threads=2, context=context)
    executor.add_node(node)

    def fail():
        raise ArithmeticError("in a thread")

    node.create_timer(0.001, fail)
    with pytest.raises(ArithmeticError, match="in a thread"):
        executor.spin()
    executor.shutdown()


def test_executor_in_with(node, context):
    calls = []
    node.create_timer(0.0, lambda: calls.append(1))
    with SingleThreadedExecutor(context=context) as executor:
        executor.add_node(node)
        executor.spin_once(timeout_sec=1.0)
    assert calls == [1]
