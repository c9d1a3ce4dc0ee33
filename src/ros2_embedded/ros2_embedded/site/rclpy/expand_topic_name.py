# SPDX-License-Identifier: Apache-2.0
"""Absolute names of topics and services."""

from __future__ import annotations

from rclpy._names import expand_name


def expand_topic_name(topic_name: str, node_name: str, node_namespace: str) -> str:
    """Make the name of a topic absolute; it is not remapped.

    Args:
        topic_name: Absolute, relative or private name.
        node_name: Node that uses it.
        node_namespace: Namespace of the node.

    Returns:
        The absolute name.

    Raises:
        ValueError: A name is not allowed.
    """
    return expand_name(topic_name, node_name, node_namespace)
