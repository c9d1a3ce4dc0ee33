# SPDX-License-Identifier: Apache-2.0
"""What nodes know of each other."""

from __future__ import annotations

import pytest
from rclpy.node import NodeNameNonExistentError
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.topic_endpoint_info import TopicEndpointTypeEnum
from std_msgs.msg import Int64, String
from std_srvs.srv import Trigger


@pytest.fixture
def others(make_node, domain_id, executor):
    """A node that looks around, and one in another context that is looked at."""
    import rclpy
    from rclpy.context import Context
    from rclpy.node import Node

    context = Context()
    rclpy.init(args=[], context=context, domain_id=domain_id)
    looker, other = make_node("looker"), Node("other", namespace="/far", context=context)
    executor.add_node(looker)
    yield looker, other
    other.destroy_node()
    context.shutdown()


def test_nodes_come_and_go(others, executor, spin_until):
    looker, other = others
    spin_until(executor, lambda: ("other", "/far") in looker.get_node_names_and_namespaces())
    assert ("looker", "/") in looker.get_node_names_and_namespaces()
    assert {"looker", "other"} <= set(looker.get_node_names())
    assert "/far/other" in looker.get_fully_qualified_node_names()
    assert looker.wait_for_node("/far/other", timeout=20.0)
    assert not looker.wait_for_node("/far/nobody", timeout=0.05)
    other.destroy_node()
    spin_until(executor, lambda: ("other", "/far") not in looker.get_node_names_and_namespaces())


def test_topics(others, executor, topic, spin_until):
    looker, other = others
    other.create_publisher(String, topic, 10)
    spin_until(
        executor, lambda: (topic, ["std_msgs/msg/String"]) in looker.get_topic_names_and_types()
    )
    looker.create_subscription(Int64, f"{topic}_b", lambda message: None, 10)
    assert (f"{topic}_b", ["std_msgs/msg/Int64"]) in looker.get_topic_names_and_types()


def test_counts(others, executor, topic, spin_until):
    looker, other = others
    assert looker.count_publishers(topic) == looker.count_subscribers(topic) == 0
    publisher = other.create_publisher(String, topic, 10)
    other.create_subscription(String, topic, lambda message: None, 10)
    looker.create_subscription(String, topic, lambda message: None, 10)
    spin_until(executor, lambda: looker.count_publishers(topic) == 1)
    spin_until(executor, lambda: looker.count_subscribers(topic) == 2)
    other.destroy_publisher(publisher)
    spin_until(executor, lambda: looker.count_publishers(topic) == 0)


def test_count_of_relative_name(make_node, executor, spin_until):
    node = make_node("me", namespace="/ns")
    executor.add_node(node)
    node.create_publisher(String, "rel", 10)
    spin_until(executor, lambda: node.count_publishers("rel") == 1)
    assert node.count_publishers("/ns/rel") == 1


def test_services(others, executor, topic, spin_until):
    looker, other = others
    other.create_service(Trigger, topic, lambda request, response: response)
    other.create_client(Trigger, topic)
    entry = (topic, ["std_srvs/srv/Trigger"])
    spin_until(executor, lambda: entry in looker.get_service_names_and_types())
    spin_until(executor, lambda: looker.count_services(topic) == 1)
    spin_until(executor, lambda: looker.count_clients(topic) == 1)
    spin_until(executor, lambda: "other" in looker.get_node_names())

    def listed(method):
        try:
            return entry in method("other", "/far")
        except NodeNameNonExistentError:
            return False

    spin_until(executor, lambda: listed(looker.get_service_names_and_types_by_node))
    spin_until(executor, lambda: listed(looker.get_client_names_and_types_by_node))


def test_topics_by_node(others, executor, topic, spin_until):
    looker, other = others
    other.create_publisher(String, topic, 10)
    other.create_subscription(Int64, f"{topic}_b", lambda message: None, 10)
    spin_until(executor, lambda: "other" in looker.get_node_names())
    spin_until(
        executor,
        lambda: (
            (topic, ["std_msgs/msg/String"])
            in looker.get_publisher_names_and_types_by_node("other", "/far")
        ),
    )
    spin_until(
        executor,
        lambda: (
            (f"{topic}_b", ["std_msgs/msg/Int64"])
            in looker.get_subscriber_names_and_types_by_node("other", "/far")
        ),
    )


def test_unknown_node_is_refused(node):
    with pytest.raises(NodeNameNonExistentError):
        node.get_publisher_names_and_types_by_node("nobody", "/")
    with pytest.raises(NodeNameNonExistentError):
        node.get_service_names_and_types_by_node("nobody", "/")


def test_endpoint_info(others, executor, topic, spin_until):
    looker, other = others
    profile = QoSProfile(
        depth=5,
        reliability=ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.TRANSIENT_LOCAL,
    )
    other.create_publisher(String, topic, profile)
    looker.create_subscription(String, topic, lambda message: None, profile)

    def known():
        infos = looker.get_publishers_info_by_topic(topic)
        return infos and infos[0].node_name == "other"

    spin_until(executor, known)
    (info,) = looker.get_publishers_info_by_topic(topic)
    assert info.node_namespace == "/far"
    assert info.topic_type == "std_msgs/msg/String"
    assert info.endpoint_type == TopicEndpointTypeEnum.PUBLISHER
    assert len(info.endpoint_gid) >= 16
    assert info.qos_profile.reliability == ReliabilityPolicy.BEST_EFFORT
    assert info.qos_profile.durability == DurabilityPolicy.TRANSIENT_LOCAL
    assert str(info.topic_type_hash) == (
        "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18"
    )
    (own,) = looker.get_subscriptions_info_by_topic(topic)
    assert own.node_name == "looker"
    assert own.endpoint_type == TopicEndpointTypeEnum.SUBSCRIPTION


def test_lists_of_a_node(make_node, topic):
    node = make_node()
    publisher = node.create_publisher(String, topic, 10)
    subscription = node.create_subscription(String, topic, lambda message: None, 10)
    timer = node.create_timer(1.0, lambda: None)
    client = node.create_client(Trigger, topic)
    guard = node.create_guard_condition(lambda: None)
    assert publisher in node.publishers
    assert subscription in node.subscriptions
    assert list(node.timers) == [timer]
    assert list(node.clients) == [client]
    assert list(node.guards) == [guard]
    node.destroy_node()
    assert list(node.publishers) == list(node.timers) == list(node.services) == []
