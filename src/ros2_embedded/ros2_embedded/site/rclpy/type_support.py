# SPDX-License-Identifier: Apache-2.0
"""Whether a class is a message or a service."""

from __future__ import annotations

from typing import Any

from rclpy.exceptions import NoTypeSupportImportedException


def check_for_type_support(msg_or_srv_type: Any) -> None:
    """Check that a class is a message or a service.

    Args:
        msg_or_srv_type: The class.

    Raises:
        AttributeError: It is another class.
        NoTypeSupportImportedException: Its support is missing.
    """
    try:
        name = msg_or_srv_type.__ros_type__
    except AttributeError as error:
        raise AttributeError(
            f"{error} This might be a ROS 1 message type but it should be a ROS 2 message type. "
            "Make sure to source your ROS 2 workspace after your ROS 1 workspace."
        ) from None
    if not name:
        raise NoTypeSupportImportedException()


def check_is_valid_msg_type(msg_type: Any) -> None:
    """Check that a class is a message.

    Args:
        msg_type: The class.

    Raises:
        AttributeError: It is neither message nor service.
        RuntimeError: It is a service.
    """
    check_for_type_support(msg_type)
    if hasattr(msg_type, "Request"):
        raise RuntimeError(
            f"The message type provided is not valid ({msg_type}), this might be a service or "
            "action"
        )


def check_is_valid_srv_type(srv_type: Any) -> None:
    """Check that a class is a service.

    Args:
        srv_type: The class.

    Raises:
        AttributeError: It is neither message nor service.
        RuntimeError: It is a message.
    """
    check_for_type_support(srv_type)
    if not (hasattr(srv_type, "Request") and hasattr(srv_type, "Response")):
        raise RuntimeError(
            f"The service type provided is not valid ({srv_type}), this might be a message or "
            "action"
        )
