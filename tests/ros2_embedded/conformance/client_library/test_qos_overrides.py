# SPDX-License-Identifier: Apache-2.0
"""Quality of service changed by parameters."""

from __future__ import annotations

import pytest
from rcl_interfaces.msg import SetParametersResult
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSPolicyKind, QoSProfile, ReliabilityPolicy
from rclpy.qos_overriding_options import InvalidQosOverridesError, QoSOverridingOptions
from std_msgs.msg import String


def override(entity, policy, value):
    return Parameter(f"qos_overrides./site/plots.{entity}.{policy}", value=value)


@pytest.fixture
def make(make_node):
    """Make a node in the namespace ``/site`` with values for parameters."""

    def make(*overrides):
        return make_node("overridden", namespace="/site", parameter_overrides=list(overrides))

    return make


def test_default_policies_become_parameters(make):
    node = make()
    node.create_publisher(
        String, "plots", 10, qos_overriding_options=QoSOverridingOptions.with_default_policies()
    )
    names = node.list_parameters(["qos_overrides"], 0).names
    prefix = "qos_overrides./site/plots.publisher."
    assert sorted(names) == [prefix + "depth", prefix + "history", prefix + "reliability"]
    assert node.get_parameter(prefix + "reliability").value == "reliable"
    assert node.get_parameter(prefix + "depth").value == 10
    assert node.describe_parameter(prefix + "depth").read_only


def test_overrides_change_a_subscription(make):
    node = make(
        override("subscription", "reliability", "best_effort"),
        override("subscription", "depth", 3),
        override("subscription", "history", "keep_all"),
    )
    subscription = node.create_subscription(
        String,
        "plots",
        lambda message: None,
        10,
        qos_overriding_options=QoSOverridingOptions.with_default_policies(),
    )
    profile = subscription.qos_profile
    assert profile.reliability == ReliabilityPolicy.BEST_EFFORT
    assert profile.depth == 3
    assert profile.history == HistoryPolicy.KEEP_ALL


def test_overrides_reach_the_middleware(make):
    node = make(override("publisher", "durability", "transient_local"))
    node.create_publisher(
        String,
        "plots",
        QoSProfile(depth=1),
        qos_overriding_options=QoSOverridingOptions([QoSPolicyKind.DURABILITY]),
    )
    (info,) = node.get_publishers_info_by_topic("plots")
    assert info.qos_profile.durability == DurabilityPolicy.TRANSIENT_LOCAL


def test_without_options_nothing_is_declared(make):
    node = make(override("publisher", "depth", 3))
    publisher = node.create_publisher(String, "plots", 10)
    assert publisher.qos_profile.depth == 10
    assert node.list_parameters(["qos_overrides"], 0).names == []


def test_entity_id_tells_endpoints_apart(make):
    node = make(override("publisher_second", "depth", 4))
    options = QoSOverridingOptions([QoSPolicyKind.DEPTH], entity_id="second")
    publisher = node.create_publisher(String, "plots", 10, qos_overriding_options=options)
    assert publisher.qos_profile.depth == 4


def test_callback_can_refuse(make):
    def refuse(profile):
        return SetParametersResult(successful=profile.depth > 5, reason="too shallow")

    options = QoSOverridingOptions([QoSPolicyKind.DEPTH], callback=refuse)
    make().create_publisher(String, "plots", 10, qos_overriding_options=options)
    with pytest.raises(InvalidQosOverridesError, match="too shallow"):
        make(override("publisher", "depth", 1)).create_publisher(
            String, "plots", 10, qos_overriding_options=options
        )


def test_unknown_policy_value_is_refused(make):
    node = make(override("publisher", "reliability", "perfect"))
    with pytest.raises(RuntimeError):
        node.create_publisher(
            String,
            "plots",
            10,
            qos_overriding_options=QoSOverridingOptions.with_default_policies(),
        )
