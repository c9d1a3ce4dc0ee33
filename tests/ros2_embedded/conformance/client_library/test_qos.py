# SPDX-License-Identifier: Apache-2.0
"""Quality of service: profiles, and who can talk to whom."""

from __future__ import annotations

import pytest
from rclpy.duration import Duration
from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks
from rclpy.qos import (
    DurabilityPolicy,
    HistoryPolicy,
    InvalidQoSProfileException,
    LivelinessPolicy,
    QoSCompatibility,
    QoSPolicyKind,
    QoSPresetProfiles,
    QoSProfile,
    ReliabilityPolicy,
    qos_check_compatible,
    qos_profile_parameters,
    qos_profile_sensor_data,
    qos_profile_services_default,
    qos_profile_system_default,
)
from std_msgs.msg import Int64, String

RELIABLE = QoSProfile(depth=10)
BEST_EFFORT = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)
LATCHED = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)


def test_defaults():
    profile = QoSProfile(depth=7)
    assert profile.history == HistoryPolicy.KEEP_LAST
    assert profile.depth == 7
    assert profile.reliability == ReliabilityPolicy.RELIABLE
    assert profile.durability == DurabilityPolicy.VOLATILE
    assert profile.liveliness == LivelinessPolicy.SYSTEM_DEFAULT
    assert profile.deadline == profile.lifespan == Duration()
    assert profile.avoid_ros_namespace_conventions is False


def test_presets():
    assert qos_profile_sensor_data.reliability == ReliabilityPolicy.BEST_EFFORT
    assert qos_profile_sensor_data.depth == 5
    assert qos_profile_services_default.depth == 10
    assert qos_profile_parameters.depth == 1000
    assert qos_profile_system_default.reliability == ReliabilityPolicy.SYSTEM_DEFAULT
    assert QoSPresetProfiles.SENSOR_DATA.value == qos_profile_sensor_data
    assert QoSPresetProfiles.get_from_short_key("sensor_data") == qos_profile_sensor_data
    assert ReliabilityPolicy.get_from_short_key("best_effort") == 2
    assert DurabilityPolicy.TRANSIENT_LOCAL.short_key == "transient_local"


@pytest.mark.parametrize("keywords", [{}, {"history": HistoryPolicy.KEEP_LAST}])
def test_history_without_depth_is_refused(keywords):
    with pytest.raises(InvalidQoSProfileException):
        QoSProfile(**keywords)


@pytest.mark.parametrize(
    "keywords",
    [
        {"depth": 1, "unknown": 1},
        {"depth": "1"},
        {"depth": 1, "reliability": "reliable"},
        {"depth": 1, "lifespan": 1.0},
        {"depth": 1, "avoid_ros_namespace_conventions": 1},
    ],
)
def test_wrong_policies_are_refused(keywords):
    with pytest.raises(AssertionError):
        QoSProfile(**keywords)


def test_policy_numbers_must_exist():
    with pytest.raises(ValueError, match="99"):
        QoSProfile(depth=1, reliability=99)


def test_equality():
    assert QoSProfile(depth=1) == QoSProfile(depth=1)
    assert QoSProfile(depth=1) != QoSProfile(depth=2)
    assert QoSProfile(depth=1) != 1


@pytest.mark.parametrize(
    ("offered", "asked", "expected"),
    [
        (RELIABLE, RELIABLE, QoSCompatibility.OK),
        (RELIABLE, BEST_EFFORT, QoSCompatibility.OK),
        (BEST_EFFORT, RELIABLE, QoSCompatibility.ERROR),
        (LATCHED, RELIABLE, QoSCompatibility.OK),
        (RELIABLE, LATCHED, QoSCompatibility.ERROR),
    ],
)
def test_check_compatible(offered, asked, expected):
    compatibility, reason = qos_check_compatible(offered, asked)
    assert compatibility == expected
    assert bool(reason) == (expected != QoSCompatibility.OK)


@pytest.mark.parametrize(
    ("offered", "asked"),
    [(RELIABLE, BEST_EFFORT), (BEST_EFFORT, BEST_EFFORT), (LATCHED, RELIABLE)],
)
def test_compatible_endpoints_match(offered, asked, node, executor, topic, spin_until):
    received = []
    executor.add_node(node)
    node.create_subscription(String, topic, received.append, asked)
    publisher = node.create_publisher(String, topic, offered)
    spin_until(executor, lambda: publisher.get_subscription_count() == 1)
    publisher.publish(String(data="x"))
    spin_until(executor, lambda: received)


@pytest.mark.parametrize(
    ("offered", "asked", "policy"),
    [
        (BEST_EFFORT, RELIABLE, QoSPolicyKind.RELIABILITY),
        (RELIABLE, LATCHED, QoSPolicyKind.DURABILITY),
    ],
)
def test_incompatible_endpoints_are_told(offered, asked, policy, node, executor, topic, spin_until):
    events = {}
    executor.add_node(node)
    node.create_subscription(
        String,
        topic,
        lambda message: None,
        asked,
        event_callbacks=SubscriptionEventCallbacks(
            incompatible_qos=lambda event: events.update(subscription=event)
        ),
    )
    publisher = node.create_publisher(
        String,
        topic,
        offered,
        event_callbacks=PublisherEventCallbacks(
            incompatible_qos=lambda event: events.update(publisher=event)
        ),
    )
    spin_until(executor, lambda: len(events) == 2)
    for event in events.values():
        assert event.total_count == 1
        assert event.last_policy_kind == policy
    assert publisher.get_subscription_count() == 0


def test_late_subscription_gets_latched_messages(node, executor, topic, spin_until):
    received = []
    executor.add_node(node)
    publisher = node.create_publisher(
        Int64, topic, QoSProfile(depth=2, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    )
    for number in range(4):
        publisher.publish(Int64(data=number))
    node.create_subscription(Int64, topic, lambda message: received.append(message.data), LATCHED)
    spin_until(executor, lambda: len(received) == 2)
    assert received == [2, 3]


def test_late_volatile_subscription_gets_new_messages_only(node, executor, topic, spin_until):
    received = []
    executor.add_node(node)
    publisher = node.create_publisher(Int64, topic, LATCHED)
    publisher.publish(Int64(data=1))
    node.create_subscription(Int64, topic, lambda message: received.append(message.data), RELIABLE)
    spin_until(executor, lambda: publisher.get_subscription_count() == 1)
    publisher.publish(Int64(data=2))
    spin_until(executor, lambda: received)
    assert received == [2]


def test_keep_last_drops_the_oldest(node, executor, topic, spin_until):
    received = []
    subscription = node.create_subscription(
        Int64, topic, lambda message: received.append(message.data), 3
    )
    publisher = node.create_publisher(Int64, topic, 3)
    executor.add_node(node)
    spin_until(executor, lambda: publisher.get_subscription_count() == 1)
    spin_until(executor, lambda: subscription.get_publisher_count() == 1)
    for number in range(10):
        publisher.publish(Int64(data=number))
    spin_until(executor, lambda: 9 in received)
    assert received == [7, 8, 9]


def test_keep_all_keeps_everything(node, executor, topic, spin_until):
    received = []
    profile = QoSProfile(history=HistoryPolicy.KEEP_ALL)
    subscription = node.create_subscription(
        Int64, topic, lambda message: received.append(message.data), profile
    )
    publisher = node.create_publisher(Int64, topic, profile)
    executor.add_node(node)
    spin_until(executor, lambda: publisher.get_subscription_count() == 1)
    spin_until(executor, lambda: subscription.get_publisher_count() == 1)
    for number in range(50):
        publisher.publish(Int64(data=number))
    spin_until(executor, lambda: len(received) == 50)


def test_matched_event(node, executor, topic, spin_until):
    events = []
    executor.add_node(node)
    node.create_publisher(
        String, topic, 10, event_callbacks=PublisherEventCallbacks(matched=events.append)
    )
    subscription = node.create_subscription(String, topic, lambda message: None, 10)
    spin_until(executor, lambda: events)
    assert events[0].current_count == 1
    node.destroy_subscription(subscription)
    spin_until(executor, lambda: len(events) == 2)
    assert events[1].current_count == 0
    assert events[1].current_count_change == -1


def test_deadline_event(node, executor, topic, spin_until):
    events = []
    executor.add_node(node)
    profile = QoSProfile(depth=10, deadline=Duration(nanoseconds=20_000_000))
    node.create_subscription(
        String,
        topic,
        lambda message: None,
        profile,
        event_callbacks=SubscriptionEventCallbacks(deadline=events.append),
    )
    publisher = node.create_publisher(String, topic, profile)
    spin_until(executor, lambda: publisher.get_subscription_count() == 1)
    publisher.publish(String())
    spin_until(executor, lambda: events)
    assert events[0].total_count >= 1


@pytest.mark.parametrize("wrong", ["10", None, 1.0])
def test_quality_of_service_must_be_profile_or_depth(wrong, node, topic):
    with pytest.raises(TypeError):
        node.create_publisher(String, topic, wrong)
    with pytest.raises(TypeError):
        node.create_subscription(String, topic, lambda message: None, wrong)


def test_negative_depth_is_refused(node, topic):
    with pytest.raises(ValueError, match="depth"):
        node.create_publisher(String, topic, -1)
