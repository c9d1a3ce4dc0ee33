# SPDX-License-Identifier: Apache-2.0
"""Check of node names."""

from __future__ import annotations

from typing import Literal

from rclpy._names import node_name_problem, raise_problem
from rclpy.exceptions import InvalidNodeNameException


def validate_node_name(name: str) -> Literal[True]:
    """Check the name of a node.

    Args:
        name: The name.

    Returns:
        True.

    Raises:
        InvalidNodeNameException: The name is not allowed.
    """
    raise_problem(node_name_problem(name), name, InvalidNodeNameException)
    return True
