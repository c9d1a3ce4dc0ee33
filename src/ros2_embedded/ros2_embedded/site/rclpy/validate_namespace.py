# SPDX-License-Identifier: Apache-2.0
"""Check of namespaces."""

from __future__ import annotations

from typing import Literal

from rclpy._names import full_name_problem, raise_problem
from rclpy.exceptions import InvalidNamespaceException


def validate_namespace(name: str) -> Literal[True]:
    """Check a namespace.

    Args:
        name: The name.

    Returns:
        True.

    Raises:
        InvalidNamespaceException: The name is not allowed.
    """
    raise_problem(full_name_problem(name, "namespace"), name, InvalidNamespaceException)
    return True
