# SPDX-License-Identifier: Apache-2.0
"""Messages as text for people: YAML and comma-separated values."""

from __future__ import annotations

import array
import re
import sys
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
import yaml

_COLLECTIONS = (list, tuple, array.array, np.ndarray)
_BRACKETS = re.compile(r"(?P<element>.*)\[(?P<size>\d+)\]")


@dataclass(frozen=True, kw_only=True)
class TextOptions:
    """How much of a message is shown.

    Attributes:
        truncate_length: Show as many elements or characters of a field; None shows all.
        no_arr: Show type and length of an array in place of its elements.
        no_str: Show the length of a string in place of the string.
        flow_style: One line of YAML instead of one a field.
    """

    truncate_length: int | None = None
    no_arr: bool = False
    no_str: bool = False
    flow_style: bool = False


def message_to_yaml(message: Any, options: TextOptions) -> str:
    """Return a message as a YAML document with the fields in the order of the definition.

    Args:
        message: The message.
        options: How much of it is shown.
    """
    return yaml.dump(
        message_to_dict(message, options),
        allow_unicode=True,
        width=sys.maxsize,
        default_flow_style=options.flow_style,
        sort_keys=False,
    )


def message_to_csv(message: Any, options: TextOptions) -> str:
    """Return all values of a message, those of its parts too, separated by commas.

    Args:
        message: The message.
        options: How much of it is shown.
    """
    return _joined(
        _csv(getattr(message, name), field_type, options)
        for name, field_type in message.get_fields_and_field_types().items()
    )


def message_to_dict(message: Any, options: TextOptions) -> dict[str, Any]:
    """Return a message as nested dictionaries of plain Python values.

    Args:
        message: The message.
        options: How much of it is shown.
    """
    return {
        name: _plain(getattr(message, name), field_type, options)
        for name, field_type in message.get_fields_and_field_types().items()
    }


def _plain(value: Any, field_type: str | None, options: TextOptions) -> Any:
    limit = options.truncate_length
    if isinstance(value, bytes):
        return _cut(value.decode("latin-1"), limit)
    if isinstance(value, str):
        return f"<string length: <{len(value)}>>" if options.no_str else _cut(value, limit)
    if isinstance(value, _COLLECTIONS):
        if options.no_arr and field_type is not None:
            return _abbreviated(field_type, len(value))
        shown = [_plain(element, None, options) for element in value[:limit]]
        return shown if len(shown) == len(value) else [*shown, "..."]
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, bool | float | int):
        return value
    return message_to_dict(value, options)


def _csv(value: Any, field_type: str | None, options: TextOptions) -> str:
    limit = options.truncate_length
    if isinstance(value, str):
        return f"<string length: <{len(value)}>>" if options.no_str else _cut(value, limit)
    if isinstance(value, bytes):
        return str(value if limit is None or len(value) <= limit else value[:limit] + b"...")
    if isinstance(value, _COLLECTIONS):
        if options.no_arr and field_type is not None:
            return _abbreviated(field_type, len(value))
        shown = [_csv(element, None, options) for element in value[:limit]]
        return _joined(shown if len(shown) == len(value) else [*shown, "..."])
    if isinstance(value, bool | float | int | np.generic):
        return str(value)
    return message_to_csv(value, options)


def _joined(values: Iterable[str]) -> str:
    """Join with commas; empty values at the start leave no trace, as in the full tool."""
    text = ""
    for value in values:
        text = f"{text},{value}" if text else value
    return text


def _cut(text: str, limit: int | None) -> str:
    return text if limit is None or len(text) <= limit else text[:limit] + "..."


def _abbreviated(field_type: str, length: int) -> str:
    """Describe an array by its type as `get_fields_and_field_types` writes it."""
    fixed = _BRACKETS.fullmatch(field_type)
    if fixed is not None:
        return f"<array type: {_full(fixed['element'])}[{fixed['size']}]>"
    element, _, bound = field_type.removeprefix("sequence<").removesuffix(">").partition(", ")
    size = f"[{bound}]" if bound else ""
    return f"<sequence type: {_full(element)}{size}, length: {length}>"


def _full(element: str) -> str:
    """Write an element type as the full tool does: strings unbounded, messages by full name."""
    if element.startswith(("string<", "wstring<")):
        return element.partition("<")[0]
    package, slash, name = element.partition("/")
    return f"{package}/msg/{name}" if slash else element
