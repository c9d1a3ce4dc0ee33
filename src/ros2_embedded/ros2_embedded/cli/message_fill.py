# SPDX-License-Identifier: Apache-2.0
"""Fills a message from the values that a user wrote in YAML."""

from __future__ import annotations

import array
import re
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

import numpy as np

from ros2_embedded.cli.interfaces import message_class

_ELEMENT = re.compile(r"(?:sequence<)?(?P<type>\w+/\w+)(?:, \d+>|>|\[\d+\])")


def fill_message(message: Any, values: Mapping[str, Any]) -> list[Callable[[Any], None]]:
    """Set fields of a message, those of its parts too.

    `auto` stands for a header stamped when it is published, `now` for such a time.

    Args:
        message: The message.
        values: The values by field name; what is not named keeps its default.

    Returns:
        Functions that set the stamps asked for; each takes a `builtin_interfaces/msg/Time`.

    Raises:
        AttributeError: The message has no such field.
        TypeError: A value is not of its field's type.
        ValueError: A value does not fit its field.
        AssertionError: A value is refused by its field's check.
    """
    if not isinstance(values, Mapping):
        raise TypeError(
            f"Value '{values}' is expected to be a dictionary but is a {type(values).__name__}"
        )
    stamps: list[Callable[[Any], None]] = []
    for name, value in values.items():
        field = getattr(message, name)
        kind = type(field)
        stamp = _stamp_setter(message, name, value)
        if stamp is not None:
            stamps.append(stamp)
        elif isinstance(field, array.array):
            setattr(message, name, array.array(field.typecode, value))
        elif isinstance(field, np.ndarray):
            setattr(message, name, np.array(value, dtype=field.dtype))
        elif hasattr(field, "get_fields_and_field_types"):
            part = kind()
            stamps += fill_message(part, value)
            setattr(message, name, part)
        elif isinstance(field, list):
            setattr(message, name, _elements(message, name, value, stamps))
        else:
            setattr(message, name, value if type(value) is kind else kind(value))
    return stamps


def _stamp_setter(message: Any, name: str, value: Any) -> Callable[[Any], None] | None:
    if value not in ("auto", "now"):
        return None
    field_type = message.get_fields_and_field_types()[name]
    if value == "auto" and field_type == "std_msgs/Header":
        return partial(setattr, getattr(message, name), "stamp")
    if value == "now" and field_type == "builtin_interfaces/Time":
        return partial(setattr, message, name)
    return None


def _elements(
    message: Any, name: str, value: Any, stamps: list[Callable[[Any], None]]
) -> list[Any]:
    """Return the elements of a sequence; those that are messages are filled one by one."""
    element = _ELEMENT.fullmatch(message.get_fields_and_field_types()[name])
    if element is None:
        return list(value)
    parts = []
    for entry in value:
        part = message_class(element["type"])()
        stamps += fill_message(part, entry)
        parts.append(part)
    return parts
