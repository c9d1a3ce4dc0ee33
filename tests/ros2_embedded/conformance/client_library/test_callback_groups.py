# SPDX-License-Identifier: Apache-2.0
"""Which callbacks run at the same time."""

from __future__ import annotations

import threading

import pytest
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.task import Future

WAIT = 20.0


@pytest.fixture
def spin(context):
    """Spin nodes in several threads."""
    executor = MultiThreadedExecutor(num_threads=4, context=context)
    threads = []

    def start(node):
        executor.add_node(node)
        thread = threading.Thread(target=executor.spin)
        thread.start()
        threads.append(thread)
        return executor

    yield start
    executor.shutdown()
    for thread in threads:
        thread.join(timeout=WAIT)
        assert not thread.is_alive()


class Meeting:
    """Callbacks that wait for each other; they meet only if they run at the same time."""

    def __init__(self, parties):
        self._barrier = threading.Barrier(parties)
        self.met = threading.Event()

    def attend(self):
        """Wait for the others."""
        try:
            self._barrier.wait(timeout=WAIT)
            self.met.set()
        except threading.BrokenBarrierError:
            pass

    def has_taken_place(self):
        """Tell whether they met, and let go who still waits."""
        met = self.met.wait(timeout=WAIT)
        self._barrier.abort()
        return met


class Alone:
    """A callback that notices whether it runs twice at the same time."""

    def __init__(self, times):
        self._lock = threading.Lock()
        self._left = times
        self.overlapped = False
        self.done = threading.Event()

    def __call__(self):
        """Run and look."""
        if not self._lock.acquire(blocking=False):
            self.overlapped = True
            return
        try:
            self._left -= 1
            if self._left == 0:
                self.done.set()
        finally:
            self._lock.release()


def test_reentrant_callbacks_run_together(node, spin):
    meeting = Meeting(2)
    group = ReentrantCallbackGroup()
    node.create_timer(0.001, meeting.attend, callback_group=group)
    spin(node)
    assert meeting.has_taken_place()


def test_exclusive_groups_run_together(node, spin):
    meeting = Meeting(2)
    for _ in range(2):
        node.create_timer(0.001, meeting.attend, callback_group=MutuallyExclusiveCallbackGroup())
    spin(node)
    assert meeting.has_taken_place()


def test_exclusive_callbacks_run_one_by_one(node, spin):
    alone = Alone(200)
    group = MutuallyExclusiveCallbackGroup()
    for _ in range(4):
        node.create_timer(0.0005, alone, callback_group=group)
    spin(node)
    assert alone.done.wait(timeout=WAIT)
    assert not alone.overlapped


def test_default_group_is_exclusive(node, spin):
    assert isinstance(node.default_callback_group, MutuallyExclusiveCallbackGroup)
    alone = Alone(100)
    for _ in range(3):
        node.create_timer(0.0005, alone)
    spin(node)
    assert alone.done.wait(timeout=WAIT)
    assert not alone.overlapped


def test_busy_group_does_not_stop_others(node, spin):
    release, fired = threading.Event(), threading.Event()
    node.create_timer(
        0.001, lambda: release.wait(timeout=WAIT), callback_group=MutuallyExclusiveCallbackGroup()
    )
    node.create_timer(0.001, fired.set, callback_group=MutuallyExclusiveCallbackGroup())
    spin(node)
    assert fired.wait(timeout=WAIT)
    release.set()


def test_group_is_free_after_an_error(node, context):
    executor = MultiThreadedExecutor(num_threads=2, context=context)
    executor.add_node(node)
    fired = threading.Event()

    def fail():
        failing.cancel()
        raise ArithmeticError

    failing = node.create_timer(0.001, fail)
    # The executor looks for errors when it finds other work.
    other = node.create_timer(0.01, lambda: None, callback_group=ReentrantCallbackGroup())
    with pytest.raises(ArithmeticError):
        executor.spin()
    node.destroy_timer(other)
    node.create_timer(0.001, fired.set)
    while not fired.is_set():
        executor.spin_once(timeout_sec=0.01)
    executor.shutdown()


def test_exclusive_group_waits_for_a_coroutine_to_finish(node, executor, spin_until):
    group = MutuallyExclusiveCallbackGroup()
    gate = Future(executor=executor)
    order = []

    async def slow():
        slow_timer.cancel()
        order.append("begin")
        await gate
        order.append("end")

    executor.add_node(node)
    slow_timer = node.create_timer(0.0, slow, callback_group=group)
    spin_until(executor, lambda: order)
    node.create_timer(0.0, lambda: order.append("other"), callback_group=group)
    for _ in range(3):
        executor.spin_once(timeout_sec=0.01)
    assert order == ["begin"]
    gate.set_result(None)
    spin_until(executor, lambda: "other" in order)
    assert order[:2] == ["begin", "end"]


def test_reentrant_group_runs_others_during_a_coroutine(node, executor, spin_until):
    gate = Future(executor=executor)
    order = []

    async def slow():
        slow_timer.cancel()
        await gate
        order.append("end")

    executor.add_node(node)
    group = ReentrantCallbackGroup()
    slow_timer = node.create_timer(0.0, slow, callback_group=group)
    executor.spin_once(timeout_sec=1.0)
    node.create_timer(0.001, lambda: order.append("other"), callback_group=group)
    spin_until(executor, lambda: order)
    assert order[0] == "other"
    gate.set_result(None)
    spin_until(executor, lambda: "end" in order)


def test_groups_know_their_entities(node):
    group = ReentrantCallbackGroup()
    timer = node.create_timer(1.0, lambda: None, callback_group=group)
    other = node.create_timer(1.0, lambda: None)
    assert group.has_entity(timer)
    assert not group.has_entity(other)
    assert node.default_callback_group.has_entity(other)
