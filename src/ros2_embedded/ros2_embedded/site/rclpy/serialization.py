# SPDX-License-Identifier: Apache-2.0
"""Messages as bytes."""

from __future__ import annotations

from typing import Any

from rclpy._rclpy_pybind11 import RMWError
from rclpy.type_support import check_for_type_support

from ros2_embedded.messages.codec import deserialize, serialize


def serialize_message(message: Any) -> bytes:
    """Write a message as CDR.

    Args:
        message: The message.

    Returns:
        Its CDR with the header.
    """
    check_for_type_support(type(message))
    return bytes(serialize(message))


def deserialize_message(serialized_message: bytes, message_type: Any) -> Any:
    """Read a message from CDR.

    Args:
        serialized_message: The CDR with its header.
        message_type: Class of the message.

    Returns:
        The message.

    Raises:
        RMWError: The bytes are not such a message.
    """
    check_for_type_support(message_type)
    try:
        return deserialize(serialized_message, message_type.__ros_type__)
    except ValueError as error:
        raise RMWError(f"failed to deserialize ROS message: {error}") from error
