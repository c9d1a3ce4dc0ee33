# SPDX-License-Identifier: Apache-2.0
"""Questions to the graph that several verbs ask."""

from __future__ import annotations

import time
from typing import Any

import rclpy
from rclpy.exceptions import InvalidTopicNameException
from rclpy.node import Node

from ros2_embedded.cli.interfaces import message_class
from ros2_embedded.cli.names import is_hidden

_POLL_SECONDS = 0.1


def topics(node: Node, *, include_hidden: bool = False) -> list[tuple[str, list[str]]]:
    """Return names and types of the topics, sorted by name.

    Args:
        node: The node that asks.
        include_hidden: Return hidden topics as well.
    """
    found = node.get_topic_names_and_types()
    return sorted((name, types) for name, types in found if include_hidden or not is_hidden(name))


def services(node: Node, *, include_hidden: bool = False) -> list[tuple[str, list[str]]]:
    """Return names and types of the services, sorted by name.

    Args:
        node: The node that asks.
        include_hidden: Return hidden services as well.
    """
    found = node.get_service_names_and_types()
    return sorted((name, types) for name, types in found if include_hidden or not is_hidden(name))


def node_names(node: Node, *, include_hidden: bool = False) -> list[str]:
    """Return the fully qualified names of the nodes, sorted; a name comes once a node.

    Args:
        node: The node that asks.
        include_hidden: Return hidden nodes as well.
    """
    return sorted(
        f"{namespace.rstrip('/')}/{name}"
        for name, namespace in node.get_node_names_and_namespaces()
        if include_hidden or not name.startswith("_")
    )


def full_topic_name(node: Node, topic: str) -> str:
    """Expand a topic's name.

    Args:
        node: The node whose namespace counts.
        topic: The name as the user gave it.

    Raises:
        RuntimeError: The name is not valid.
    """
    try:
        name: str = node.resolve_topic_name(topic)
    except (InvalidTopicNameException, ValueError) as error:
        raise RuntimeError(str(error)) from error
    return name


def topic_class(node: Node, topic: str, *, wait: bool = False) -> type[Any] | None:
    """Return the message class of a topic in use.

    Args:
        node: The node that asks.
        topic: The topic's name.
        wait: Wait until somebody uses the topic.

    Returns:
        The class; None if nobody uses the topic.

    Raises:
        RuntimeError: The topic has several types, or one that is not known here.
    """
    name = full_topic_name(node, topic)
    found = _topic_class(node, topic, name)
    if found is None:
        print(f"WARNING: topic [{topic}] does not appear to be published yet")
    while wait and found is None and rclpy.ok():
        time.sleep(_POLL_SECONDS)
        found = _topic_class(node, topic, name)
    return found


def _topic_class(node: Node, topic: str, name: str) -> type[Any] | None:
    types = dict(topics(node, include_hidden=True)).get(name)
    if types is None:
        return None
    if len(types) > 1:
        listed = ", ".join(types)
        raise RuntimeError(
            f"Cannot echo topic '{topic}', as it contains more than one type: [{listed}]"
        )
    return message_class(types[0])
