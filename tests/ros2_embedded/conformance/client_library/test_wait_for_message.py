# SPDX-License-Identifier: Apache-2.0
"""Waiting for one message."""

from __future__ import annotations

import threading

from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.wait_for_message import wait_for_message
from std_msgs.msg import String

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


def test_message_comes(make_node, topic):
    publisher = make_node("talker").create_publisher(String, topic, LATCHED)
    publisher.publish(String(data="here"))
    found, message = wait_for_message(
        String, make_node("waiter"), topic, qos_profile=LATCHED, time_to_wait=20.0
    )
    assert found
    assert message == String(data="here")


def test_no_message_comes(node, topic):
    assert wait_for_message(String, node, topic, time_to_wait=0.05) == (False, None)
    assert list(node.subscriptions) == []


def test_message_from_another_thread(make_node, topic):
    publisher = make_node("talker").create_publisher(String, topic, 10)
    results = []
    waiter = threading.Thread(
        target=lambda: results.append(
            wait_for_message(String, make_node("waiter"), topic, time_to_wait=20.0)
        )
    )
    waiter.start()
    while waiter.is_alive():
        publisher.publish(String(data="now"))
        waiter.join(timeout=0.01)
    assert results == [(True, String(data="now"))]
