# SPDX-License-Identifier: Apache-2.0
"""Check of parameter names."""

from __future__ import annotations

from typing import Literal

from rclpy.exceptions import InvalidParameterException


def validate_parameter_name(name: str) -> Literal[True]:
    """Check the name of a parameter.

    Args:
        name: The name.

    Returns:
        True.

    Raises:
        InvalidParameterException: The name is empty.
    """
    if not name:
        raise InvalidParameterException(name)
    return True
