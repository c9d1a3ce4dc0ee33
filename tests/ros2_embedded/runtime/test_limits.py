# SPDX-License-Identifier: Apache-2.0
"""What the runtime does not offer, and says so; and what differs from the wrapped libraries."""

from __future__ import annotations

import importlib
import os
import subprocess
import sys

import pytest
import rclpy
from rclpy.context import Context
from rclpy.event_handler import SubscriptionEventCallbacks, UnsupportedEventTypeError
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


@pytest.fixture
def node():
    """A node in a context of its own."""
    context = Context()
    rclpy.init(args=[], context=context, domain_id=1 + os.getpid() % 100)
    node = Node("limited", context=context)
    yield node
    node.destroy_node()
    context.shutdown()


@pytest.mark.parametrize(
    ("module", "feature"),
    [
        ("rclpy.action", "actions"),
        ("rclpy.lifecycle", "lifecycle nodes"),
        ("rclpy.waitable", "waitables"),
        ("rclpy.parameter_client", "parameter clients"),
        ("rclpy.parameter_event_handler", "parameter event handlers"),
        ("rclpy.service_introspection", "service introspection"),
        ("rclpy.type_description_service", "type description service"),
    ],
)
def test_import_names_the_feature(module, feature):
    with pytest.raises(NotImplementedError, match=feature):
        importlib.import_module(module)


def test_calls_name_the_feature(node):
    with pytest.raises(NotImplementedError, match="waitables"):
        node.add_waitable(object())
    client = node.create_client(Trigger, "reset")
    with pytest.raises(NotImplementedError, match="introspection"):
        client.configure_introspection(None, None, None)


def test_events_of_types_are_refused(node):
    with pytest.raises(UnsupportedEventTypeError):
        node.create_subscription(
            String,
            "events",
            lambda message: None,
            10,
            event_callbacks=SubscriptionEventCallbacks(incompatible_type=print),
        )


@pytest.mark.parametrize(("setting", "refused"), [(None, True), ("1", True), ("0", False)])
def test_fields_are_checked_unless_switched_off(setting, refused):
    environment = {k: v for k, v in os.environ.items() if k != "ROS_PYTHON_CHECK_FIELDS"}
    if setting is not None:
        environment["ROS_PYTHON_CHECK_FIELDS"] = setting
    source = "from std_msgs.msg import Float64; Float64().data = 1"
    result = subprocess.run(
        [sys.executable, "-c", source], capture_output=True, text=True, env=environment, check=False
    )
    assert ("AssertionError" in result.stderr) is refused
