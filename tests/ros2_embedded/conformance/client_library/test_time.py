# SPDX-License-Identifier: Apache-2.0
"""Times, durations and clocks."""

from __future__ import annotations

import builtin_interfaces.msg
import pytest
from rclpy.clock import Clock, ClockChange, JumpThreshold, ROSClock
from rclpy.clock_type import ClockType
from rclpy.duration import Duration, Infinite
from rclpy.exceptions import NotInitializedException
from rclpy.time import Time


def test_time_adds_up():
    time = Time(seconds=1.5, nanoseconds=2)
    assert time.nanoseconds == 1_500_000_002
    assert time.seconds_nanoseconds() == (1, 500_000_002)
    assert time.clock_type == ClockType.SYSTEM_TIME


@pytest.mark.parametrize("keywords", [{"seconds": -1}, {"nanoseconds": -1}])
def test_negative_time_is_refused(keywords):
    with pytest.raises(ValueError, match="negative"):
        Time(**keywords)


def test_limits():
    assert Time(nanoseconds=2**63 - 1).nanoseconds == 2**63 - 1
    with pytest.raises(OverflowError):
        Time(nanoseconds=2**63)
    assert Duration(nanoseconds=-(2**63)).nanoseconds == -(2**63)
    with pytest.raises(OverflowError):
        Duration(nanoseconds=2**63)


def test_clock_type_must_be_one():
    with pytest.raises(TypeError):
        Time(clock_type="ROS_TIME")
    with pytest.raises(TypeError):
        Clock(clock_type=None)


def test_arithmetic():
    time = Time(seconds=5, clock_type=ClockType.ROS_TIME)
    later = time + Duration(seconds=2)
    assert later.nanoseconds == 7_000_000_000
    assert later.clock_type == ClockType.ROS_TIME
    assert later - time == Duration(seconds=2)
    assert (time - later).nanoseconds == -2_000_000_000
    assert later - Duration(seconds=2) == time
    with pytest.raises(ValueError, match="negative"):
        time - Duration(seconds=6)
    with pytest.raises(OverflowError):
        time + Infinite


def test_arithmetic_of_other_types():
    with pytest.raises(TypeError):
        Time() + Time()
    with pytest.raises(TypeError):
        Time() - 1
    with pytest.raises(TypeError):
        Time() < 1  # noqa: B015


def test_comparison():
    early, late = Time(seconds=1), Time(seconds=2)
    assert early < late
    assert early <= late
    assert late > early
    assert late >= early
    assert early != late
    assert early == Time(nanoseconds=10**9)
    assert Duration(seconds=1) < Duration(seconds=2)
    assert Duration(seconds=1) == Duration(nanoseconds=10**9)


def test_clock_types_are_not_mixed():
    system, ros = Time(), Time(clock_type=ClockType.ROS_TIME)
    with pytest.raises(TypeError):
        system < ros  # noqa: B015
    with pytest.raises(TypeError):
        system == ros  # noqa: B015
    with pytest.raises(TypeError):
        system - ros


def test_messages():
    time = Time(seconds=3, nanoseconds=4)
    message = time.to_msg()
    assert message == builtin_interfaces.msg.Time(sec=3, nanosec=4)
    assert Time.from_msg(message).clock_type == ClockType.ROS_TIME
    assert Time.from_msg(message, clock_type=ClockType.SYSTEM_TIME) == time
    duration = Duration(seconds=-1, nanoseconds=-1)
    assert duration.to_msg() == builtin_interfaces.msg.Duration(sec=-2, nanosec=999_999_999)
    assert Duration.from_msg(duration.to_msg()) == duration
    with pytest.raises(TypeError):
        Time.from_msg(duration.to_msg())
    with pytest.raises(TypeError):
        Duration.from_msg(message)


def test_texts():
    assert repr(Time(nanoseconds=1)) == "Time(nanoseconds=1, clock_type=SYSTEM_TIME)"
    assert repr(Duration(nanoseconds=1)) == "Duration(nanoseconds=1)"
    assert str(Infinite) == "Infinite"
    assert repr(Clock()) == "Clock(clock_type=SYSTEM_TIME)"


@pytest.mark.parametrize("kind", [ClockType.SYSTEM_TIME, ClockType.STEADY_TIME, ClockType.ROS_TIME])
def test_clocks_go_forward(kind):
    clock = Clock(clock_type=kind)
    assert clock.clock_type == kind
    first = clock.now()
    assert first.clock_type == kind
    assert clock.now() >= first


def test_ros_clock_is_made_for_ros_time():
    assert isinstance(Clock(clock_type=ClockType.ROS_TIME), ROSClock)
    assert not ROSClock().ros_time_is_active


def test_override_counts_only_while_active():
    clock = ROSClock()
    clock.set_ros_time_override(Time(seconds=5, clock_type=ClockType.ROS_TIME))
    assert clock.now().nanoseconds > 10**18
    with pytest.raises(TypeError):
        clock.set_ros_time_override(5)


@pytest.mark.parametrize("kind", [ClockType.SYSTEM_TIME, ClockType.STEADY_TIME, ClockType.ROS_TIME])
def test_sleep(kind, context):
    clock = Clock(clock_type=kind)
    start = clock.now()
    assert clock.sleep_for(Duration(nanoseconds=20_000_000), context=context)
    assert clock.now() - start >= Duration(nanoseconds=20_000_000)
    assert clock.sleep_until(start, context=context)


def test_sleep_needs_the_same_clock_type(context):
    with pytest.raises(ValueError, match="clock type"):
        Clock().sleep_until(Time(clock_type=ClockType.STEADY_TIME), context=context)


def test_sleep_needs_a_context():
    with pytest.raises(NotInitializedException):
        Clock().sleep_for(Duration(seconds=1))


def test_jump_thresholds_are_checked():
    with pytest.raises(ValueError, match="min_forward"):
        JumpThreshold(min_forward=Duration(), min_backward=None)
    with pytest.raises(ValueError, match="min_backward"):
        JumpThreshold(min_forward=None, min_backward=Duration(seconds=1))
    with pytest.raises(ValueError, match="threshold"):
        JumpThreshold(min_forward=None, min_backward=None, on_clock_change=False)


def test_jump_callback_needs_a_callback():
    threshold = JumpThreshold(min_forward=Duration(seconds=1), min_backward=None)
    with pytest.raises(ValueError, match="callback"):
        Clock().create_jump_callback(threshold)


def test_clock_changes_have_names():
    assert ClockChange.ROS_TIME_ACTIVATED != ClockChange.ROS_TIME_DEACTIVATED
