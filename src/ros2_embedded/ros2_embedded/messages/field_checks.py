# SPDX-License-Identifier: Apache-2.0
"""Which values the fields of messages accept, by their declared types."""

from __future__ import annotations

import math
from collections import UserList, UserString
from collections.abc import Callable, Sequence, Set
from typing import Any

import numpy as np
from rosbags.interfaces import Nodetype

#: Raises AssertionError for a value that does not fit.
Check = Callable[[Any], None]

#: Name of each base type in ``get_fields_and_field_types``.
IDL_NAMES = {"bool": "boolean", "byte": "octet", "float32": "float", "float64": "double"}

#: Number types whose sequences are array.array and whose arrays are numpy.ndarray.
TYPECODES = {
    "float32": "f",
    "float64": "d",
    "int8": "b",
    "uint8": "B",
    "int16": "h",
    "uint16": "H",
    "int32": "i",
    "uint32": "I",
    "int64": "q",
    "uint64": "Q",
}

_FLOAT_BOUNDS = {"float32": 3.402823466e38, "float64": 1.7976931348623157e308}
_PYTHON_TYPES: dict[str, type] = {"bool": bool, "byte": bytes, "string": str}
_PYTHON_TYPES |= {name: float if name in _FLOAT_BOUNDS else int for name in TYPECODES}


def element_text(kind: Nodetype, value: Any) -> str:
    """Get the type of a field or its elements as ``get_fields_and_field_types`` shows it.

    Args:
        kind: Base type or message.
        value: Which one, as rosbags has it.

    Returns:
        Such as ``uint8`` or ``std_msgs/Header``.
    """
    if kind == Nodetype.NAME:
        package, _, name = value.split("/")
        return f"{package}/{name}"
    base, bound = value
    if base == "string":
        return f"string<{bound}>" if bound else "string"
    return IDL_NAMES.get(base, str(base))


def element_check(
    name: str, kind: Nodetype, value: Any, message_class: Callable[[str], type]
) -> tuple[type, Check]:
    """Make the check of a single value.

    Args:
        name: Name of the field, for messages.
        kind: Base type or message.
        value: Which one, as rosbags has it.
        message_class: Gets the class of a message type name.

    Returns:
        The Python type of values, and their check.
    """
    if kind == Nodetype.NAME:
        cls = message_class(value)

        def check_message(item: Any) -> None:
            assert isinstance(item, cls), (
                f"The '{name}' field must be a sub message of type '{cls.__name__}'"
            )

        return cls, check_message
    base, bound = value
    return _PYTHON_TYPES[base], _base_check(name, base, bound)


def _base_check(name: str, base: str, bound: int) -> Check:
    if base in _FLOAT_BOUNDS:
        largest = _FLOAT_BOUNDS[base]

        def check_float(value: Any) -> None:
            assert isinstance(value, float), f"The '{name}' field must be of type 'float'"
            assert not (value < -largest or value > largest) or math.isinf(value), (
                f"The '{name}' field must be a {IDL_NAMES[base]} in [{-largest}, {largest}]"
            )

        return check_float
    if base in TYPECODES:
        bits = np.iinfo(base)
        low, high = int(bits.min), int(bits.max)

        def check_int(value: Any) -> None:
            assert isinstance(value, int), f"The '{name}' field must be of type 'int'"
            assert low <= value <= high, f"The '{name}' field must be an integer in [{low}, {high}]"

        return check_int
    if base == "byte":

        def check_byte(value: Any) -> None:
            is_byte = isinstance(value, bytes | bytearray) and len(value) == 1
            assert is_byte, f"The '{name}' field must be of type 'bytes' with length 1"

        return check_byte
    if base == "bool":

        def check_bool(value: Any) -> None:
            assert isinstance(value, bool), f"The '{name}' field must be of type 'bool'"

        return check_bool

    def check_string(value: Any) -> None:
        kinds = (str, UserString) if bound else (str,)
        assert isinstance(value, kinds), f"The '{name}' field must be of type 'str'"
        assert not bound or len(value) <= bound, (
            f"The '{name}' field must not be longer than {bound}"
        )

    return check_string


def list_check(
    name: str,
    python_type: type,
    check: Check,
    fixed: int | None,
    bound: int | None,
) -> Check:
    """Make the check of a list of values.

    Args:
        name: Name of the field, for messages.
        python_type: Type of the values.
        check: Check of each value.
        fixed: Length that the list must have, or None.
        bound: Length that it must not exceed, or None.

    Returns:
        The check.
    """

    def check_list(value: Any) -> None:
        is_text = isinstance(value, str | UserString)
        assert not is_text, f"The '{name}' field must not be a string"
        assert isinstance(value, Sequence | Set | UserList), (
            f"The '{name}' field must be a set or sequence of '{python_type.__name__}'"
        )
        assert fixed is None or len(value) == fixed, (
            f"The '{name}' field must be a set or sequence with length {fixed}"
        )
        assert bound is None or len(value) <= bound, (
            f"The '{name}' field must be a set or sequence with length <= {bound}"
        )
        for item in value:
            check(item)

    return check_list
