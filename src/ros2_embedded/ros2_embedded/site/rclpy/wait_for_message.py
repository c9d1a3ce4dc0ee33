# SPDX-License-Identifier: Apache-2.0
"""Waiting for one message without an executor."""

from __future__ import annotations

import time
from typing import Any

from rclpy.constants import S_TO_NS
from rclpy.node import Node
from rclpy.qos import QoSProfile

from ros2_embedded.dds.waitset import Guard, WaitSet


def wait_for_message(
    msg_type: Any,
    node: Node,
    topic: str,
    *,
    qos_profile: QoSProfile | int = 1,
    time_to_wait: float = -1,
) -> tuple[bool, Any]:
    """Wait for the next message of a topic.

    Args:
        msg_type: Class of the message.
        node: Node that subscribes.
        topic: Name of the topic.
        qos_profile: Quality of service, or the depth of the history.
        time_to_wait: Longest wait in seconds; negative for any.

    Returns:
        True and the message; False and None after the time or a shutdown.
    """
    context = node.context
    guard, wait_set = Guard(context.participant), WaitSet(context.participant)
    context.wake_on_shutdown(guard)
    subscription = node.create_subscription(
        msg_type, topic, lambda _: None, qos_profile=qos_profile
    )
    try:
        give_up = time.monotonic() + time_to_wait
        while context.ok():
            left = int((give_up - time.monotonic()) * S_TO_NS) if time_to_wait >= 0 else None
            if left is not None and left < 0:
                break
            handle = subscription.wait_handle
            assert handle is not None
            wait_set.wait({handle, guard.condition}, left)
            taken = subscription.take_message()
            if taken is not None:
                return True, taken[0]
    finally:
        node.destroy_subscription(subscription)
        wait_set.close()
        guard.close()
    return False, None
