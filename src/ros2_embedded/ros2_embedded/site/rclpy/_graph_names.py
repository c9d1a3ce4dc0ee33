# SPDX-License-Identifier: Apache-2.0
"""ROS names of DDS topics and types."""

from __future__ import annotations

import re


def topic_of(dds_topic: str, dds_type: str) -> tuple[str, str]:
    """Get the ROS topic of a DDS topic.

    Args:
        dds_topic: Such as ``rt/chatter``.
        dds_type: Such as ``std_msgs::msg::dds_::String_``.

    Returns:
        Topic and type, such as ``/chatter`` and ``std_msgs/msg/String``; empty names if it
        is no ROS topic.
    """
    if not dds_topic.startswith("rt/"):
        return "", ""
    return dds_topic[2:], _ros_type(dds_type)


def service_of(dds_topic: str, dds_type: str, prefixes: tuple[str, ...]) -> tuple[str, str]:
    """Get the service of a DDS topic.

    Args:
        dds_topic: Such as ``rq/resetRequest``.
        dds_type: Such as ``std_srvs::srv::dds_::Empty_Request_``.
        prefixes: ``rq`` for requests, ``rr`` for responses.

    Returns:
        Service and type, such as ``/reset`` and ``std_srvs/srv/Empty``; empty names if it is
        no topic of a service.
    """
    match = re.fullmatch(r"(rq|rr)(/.*)(?:Request|Reply)", dds_topic)
    if match is None or match[1] not in prefixes:
        return "", ""
    return match[2], re.sub(r"_(Request|Response)$", "", _ros_type(dds_type))


def _ros_type(dds_type: str) -> str:
    match = re.fullmatch(r"(.*::)dds_::(.*)_", dds_type)
    return match[1].replace("::", "/") + match[2] if match else dds_type
