# SPDX-License-Identifier: Apache-2.0
"""Simulated time from ``/clock``."""

from __future__ import annotations

import threading

import builtin_interfaces.msg
import pytest
from rclpy.clock import ClockChange, JumpThreshold
from rclpy.duration import Duration
from rclpy.executors import MultiThreadedExecutor
from rclpy.parameter import Parameter
from rosgraph_msgs.msg import Clock as ClockMessage

SIMULATED = [Parameter("use_sim_time", value=True)]


@pytest.fixture
def simulation(make_node, executor, spin_until, topic):
    """A node that follows simulated time, and what sets it.

    The topic of the clock is remapped, so that sessions in one domain do not disturb each other.
    """
    remap = ["--ros-args", "-r", f"/clock:={topic}"]
    node = make_node("simulated", parameter_overrides=SIMULATED, cli_args=remap)
    publisher = make_node("simulator").create_publisher(ClockMessage, topic, 10)
    executor.add_node(node)

    def set_time(seconds):
        time = builtin_interfaces.msg.Time(
            sec=int(seconds), nanosec=round((seconds - int(seconds)) * 1e9)
        )

        def arrived():
            publisher.publish(ClockMessage(clock=time))
            executor.spin_once(timeout_sec=0.01)
            return node.get_clock().now().to_msg() == time

        spin_until(executor, arrived)

    node.set_time = set_time
    spin_until(executor, lambda: publisher.get_subscription_count() == 1)
    return node


def test_time_is_zero_before_the_first_message(make_node):
    node = make_node("simulated", parameter_overrides=SIMULATED)
    assert node.get_clock().ros_time_is_active
    assert node.get_clock().now().nanoseconds == 0


def test_clock_follows_the_topic(simulation):
    for seconds in (10.5, 11.0, 3.0):
        simulation.set_time(seconds)
        assert simulation.get_clock().now().nanoseconds == int(seconds * 1e9)


def test_timer_fires_when_simulated_time_passes(simulation, executor, spin_until):
    calls = []
    simulation.set_time(100.0)
    simulation.create_timer(1.0, lambda: calls.append(simulation.get_clock().now().nanoseconds))
    for _ in range(5):
        executor.spin_once(timeout_sec=0.02)
    assert calls == []
    simulation.set_time(100.5)
    executor.spin_once(timeout_sec=0.02)
    assert calls == []
    simulation.set_time(101.0)
    spin_until(executor, lambda: calls)
    assert calls == [101_000_000_000]


def test_timer_leaves_out_what_a_jump_skips(simulation, executor, spin_until):
    calls = []
    simulation.set_time(100.0)
    timer = simulation.create_timer(1.0, lambda: calls.append(1))
    simulation.set_time(105.5)
    spin_until(executor, lambda: calls)
    for _ in range(3):
        executor.spin_once(timeout_sec=0.02)
    assert len(calls) == 1
    assert timer.time_until_next_call() == 500_000_000


def test_timer_starts_anew_after_time_went_back(simulation, executor, spin_until):
    calls = []
    simulation.set_time(100.0)
    timer = simulation.create_timer(1.0, lambda: calls.append(1))
    simulation.set_time(50.0)
    assert timer.time_until_next_call() <= 1_000_000_000
    simulation.set_time(51.5)
    spin_until(executor, lambda: calls)


def test_switching_at_run_time(simulation):
    clock = simulation.get_clock()
    simulation.set_time(100.0)
    changes = []
    threshold = JumpThreshold(min_forward=None, min_backward=None, on_clock_change=True)
    with clock.create_jump_callback(threshold, post_callback=changes.append):
        assert simulation.set_parameters([Parameter("use_sim_time", value=False)])[0].successful
        assert not clock.ros_time_is_active
        assert clock.now().nanoseconds > 10**18
        simulation.set_parameters([Parameter("use_sim_time", value=True)])
        assert clock.ros_time_is_active
    assert [jump.clock_change for jump in changes] == [
        ClockChange.ROS_TIME_DEACTIVATED,
        ClockChange.ROS_TIME_ACTIVATED,
    ]


def test_use_sim_time_must_be_bool(simulation):
    result = simulation.set_parameters([Parameter("use_sim_time", value="yes")])[0]
    assert not result.successful


def test_jump_callbacks(simulation):
    simulation.set_time(10.0)
    jumps = []
    before = []
    threshold = JumpThreshold(
        min_forward=Duration(seconds=5), min_backward=Duration(seconds=-1), on_clock_change=False
    )
    with simulation.get_clock().create_jump_callback(
        threshold, pre_callback=lambda: before.append(1), post_callback=jumps.append
    ):
        for seconds in (12.0, 20.0, 19.5, 10.0):
            simulation.set_time(seconds)
    simulation.set_time(100.0)
    assert [jump.delta.nanoseconds for jump in jumps] == [8_000_000_000, -9_500_000_000]
    assert len(before) == 2


def test_sleep_lasts_simulated_time(simulation, context):
    simulation.set_time(10.0)
    clock = simulation.get_clock()
    results = []
    until = clock.now() + Duration(seconds=2)
    sleeper = threading.Thread(
        target=lambda: results.append(clock.sleep_until(until, context=context))
    )
    sleeper.start()
    simulation.set_time(11.0)
    assert results == []
    simulation.set_time(12.0)
    sleeper.join(timeout=20.0)
    assert results == [True]


def test_sleep_ends_when_simulated_time_is_switched_off(simulation, context):
    simulation.set_time(10.0)
    clock = simulation.get_clock()
    results = []
    started = threading.Event()

    def sleep():
        started.set()
        results.append(clock.sleep_for(Duration(seconds=1000), context=context))

    sleeper = threading.Thread(target=sleep)
    sleeper.start()
    started.wait()
    while sleeper.is_alive():
        simulation.set_parameters([Parameter("use_sim_time", value=False)])
        simulation.set_parameters([Parameter("use_sim_time", value=True)])
        sleeper.join(timeout=0.01)
    assert results == [False]


def test_clock_wakes_a_timer_in_another_executor(simulation, make_node, context, topic):
    fired = threading.Event()
    remap = ["--ros-args", "-r", f"/clock:={topic}"]
    other = make_node("other", parameter_overrides=SIMULATED, cli_args=remap)
    other.create_timer(1.0, fired.set)
    executor = MultiThreadedExecutor(num_threads=2, context=context)
    executor.add_node(other)
    thread = threading.Thread(target=executor.spin)
    thread.start()
    for seconds in range(10, 2000):
        simulation.set_time(float(seconds))
        if fired.wait(timeout=0.01):
            break
    assert fired.is_set()
    executor.shutdown()
    thread.join(timeout=20.0)
    assert not thread.is_alive()
