# SPDX-License-Identifier: Apache-2.0
"""Logging: levels, filters, children, ``/rosout``."""

from __future__ import annotations

import pytest
import rclpy.logging
from rcl_interfaces.msg import Log
from rclpy.clock import ROSClock
from rclpy.logging import LoggingSeverity, get_logger
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.time import Time


@pytest.fixture
def logger(topic):
    """A logger that no other test uses."""
    return get_logger(topic.strip("/"))


def test_default_level(logger):
    assert logger.get_effective_level() == LoggingSeverity.INFO
    assert not logger.debug("not shown")
    assert logger.info("shown")


def test_set_level(logger):
    logger.set_level(LoggingSeverity.WARN)
    assert logger.get_effective_level() == LoggingSeverity.WARN
    assert not logger.is_enabled_for(LoggingSeverity.INFO)
    assert logger.is_enabled_for(LoggingSeverity.ERROR)
    outcomes = [logger.debug("m"), logger.info("m"), logger.warning("m"), logger.error("m")]
    assert outcomes == [False, False, True, True]
    assert logger.fatal("m")


def test_levels_by_name(logger):
    rclpy.logging.set_logger_level(logger.name, LoggingSeverity.DEBUG)
    assert rclpy.logging.get_logger_level(logger.name) == LoggingSeverity.DEBUG
    assert rclpy.logging.get_logger_effective_level(logger.name) == LoggingSeverity.DEBUG
    assert logger.debug("shown")


def test_children_follow_their_parent(logger):
    child = logger.get_child("child")
    assert child.name == f"{logger.name}.child"
    logger.set_level(LoggingSeverity.ERROR)
    assert child.get_effective_level() == LoggingSeverity.ERROR
    child.set_level(LoggingSeverity.DEBUG)
    assert child.get_effective_level() == LoggingSeverity.DEBUG
    assert logger.get_effective_level() == LoggingSeverity.ERROR
    child.set_level(LoggingSeverity.UNSET)
    assert child.get_effective_level() == LoggingSeverity.ERROR


@pytest.mark.parametrize("get", [get_logger, lambda name: get_logger("parent").get_child(name)])
def test_empty_name_is_refused(get):
    with pytest.raises(ValueError, match="empty"):
        get("")


def test_severity_by_name():
    severity = rclpy.logging.get_logging_severity_from_string("WARN")
    assert severity == LoggingSeverity.WARN
    with pytest.raises(RuntimeError):
        rclpy.logging.get_logging_severity_from_string("LOUD")


def test_severity_must_exist(logger):
    with pytest.raises(ValueError, match="99"):
        logger.set_level(99)


def test_once(logger):
    assert [logger.info("m", once=True) for _ in range(3)] == [True, False, False]


def test_skip_first(logger):
    assert [logger.info("m", skip_first=True) for _ in range(3)] == [False, True, True]


def test_throttle_by_a_clock(logger):
    clock = ROSClock()
    clock._set_ros_time_is_active(True)
    logged = []
    for seconds in (100, 101, 104, 105, 106, 111):
        clock.set_ros_time_override(Time(seconds=seconds, clock_type=clock.clock_type))
        logged.append(logger.info("m", throttle_duration_sec=5.0, throttle_time_source_type=clock))
    assert logged == [True, False, False, True, False, True]


def test_throttle_by_the_system_clock(logger):
    outcomes = [logger.info("m", throttle_duration_sec=1000.0) for _ in range(5)]
    assert outcomes == [True, False, False, False, False]


def test_filters_count_per_place(logger):
    assert logger.info("m", once=True)
    assert logger.info("m", once=True)


def test_filters_can_be_combined(logger):
    outcomes = [logger.info("m", once=True, skip_first=True) for _ in range(4)]
    assert outcomes == [False, True, False, False]


def test_unknown_option_is_refused(logger):
    with pytest.raises(TypeError):
        logger.info("m", sometimes=True)


def test_throttle_clock_needs_a_duration(logger):
    with pytest.raises(TypeError):
        logger.info("m", throttle_time_source_type=ROSClock())


def test_throttle_clock_must_be_one(logger):
    with pytest.raises(ValueError, match="clock"):
        logger.info("m", throttle_duration_sec=1.0, throttle_time_source_type="SYSTEM_TIME")


def test_options_of_a_place_must_not_change(logger):
    def log(severity, **options):
        logger.log("m", severity, **options)

    log(LoggingSeverity.INFO, once=True)
    with pytest.raises(ValueError, match="severity"):
        log(LoggingSeverity.WARN, once=True)
    with pytest.raises(ValueError, match="filters"):
        log(LoggingSeverity.INFO, skip_first=True)


def test_logger_of_a_node(make_node):
    assert make_node("plain").get_logger().name == "plain"
    assert make_node("deep", namespace="/site/a").get_logger().name == "site.a.deep"


@pytest.fixture
def rosout(make_node, executor, spin_until):
    """What is published on ``/rosout``."""
    records = []
    watcher = make_node("watcher", enable_rosout=False)
    profile = QoSProfile(depth=1000, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    watcher.create_subscription(Log, "/rosout", records.append, profile)
    executor.add_node(watcher)
    return records


def test_log_of_a_node_is_published(rosout, make_node, executor, spin_until):
    node = make_node("talker")
    node.get_logger().warning("something is wrong")
    node.get_logger().debug("not shown")
    spin_until(executor, lambda: rosout)
    (record,) = rosout
    assert record.level == LoggingSeverity.WARN
    assert record.name == "talker"
    assert record.msg == "something is wrong"
    assert record.function == "test_log_of_a_node_is_published"
    assert record.file.endswith("test_logging.py")
    assert record.line > 0
    assert record.stamp.sec > 0


def test_log_of_a_child_is_published(rosout, make_node, executor, spin_until):
    child = make_node("talker").get_logger().get_child("part")
    child.error("in a part")
    spin_until(executor, lambda: rosout)
    assert [(record.name, record.msg) for record in rosout] == [("talker.part", "in a part")]


def test_log_of_another_logger_is_not_published(rosout, make_node, executor, spin_until, logger):
    node = make_node("talker")
    logger.error("not of the node")
    node.get_logger().error("of the node")
    spin_until(executor, lambda: rosout)
    assert [record.msg for record in rosout] == ["of the node"]


def test_rosout_can_be_switched_off(make_node):
    node = make_node("quiet", enable_rosout=False)
    topics = [name for name, _ in node.get_publisher_names_and_types_by_node("quiet", "/")]
    assert "/rosout" not in topics
