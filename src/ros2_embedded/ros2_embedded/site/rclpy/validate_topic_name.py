# SPDX-License-Identifier: Apache-2.0
"""Check of topic and service names that may be relative."""

from __future__ import annotations

from typing import Literal

from rclpy._names import raise_problem, topic_name_problem
from rclpy.exceptions import InvalidServiceNameException, InvalidTopicNameException

TOPIC_SEPARATOR_STRING = "/"


def validate_topic_name(name: str, *, is_service: bool = False) -> Literal[True]:
    """Check the name of a topic or service.

    Args:
        name: The name.
        is_service: True for a service.

    Returns:
        True.

    Raises:
        InvalidTopicNameException: The name of a topic is not allowed.
        InvalidServiceNameException: The name of a service is not allowed.
    """
    exception = InvalidServiceNameException if is_service else InvalidTopicNameException
    raise_problem(topic_name_problem(name), name, exception)
    return True
