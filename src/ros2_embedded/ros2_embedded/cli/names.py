# SPDX-License-Identifier: Apache-2.0
"""Names of the graph, as text."""

from __future__ import annotations


def is_hidden(name: str) -> bool:
    """Tell whether a topic, service or node is hidden: a part of its name starts with `_`.

    Args:
        name: The full name.
    """
    return any(part.startswith("_") for part in name.split("/"))


def split_node_name(full_name: str) -> tuple[str, str]:
    """Split a node's name into base name and namespace.

    Args:
        full_name: The name, with or without the leading slash.

    Returns:
        Base name, then namespace.
    """
    namespace, _, name = full_name.rpartition("/")
    return name, "/" + namespace.strip("/")
