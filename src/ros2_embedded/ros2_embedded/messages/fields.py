# SPDX-License-Identifier: Apache-2.0
"""How one field of a message behaves: default, checks on assignment, wire form.

The rules are those of the Python classes that rosidl generates: unbounded sequences of
numbers are ``array.array``, fixed-size ones ``numpy.ndarray``, everything else lists and
scalars of exactly the declared Python type.
"""

from __future__ import annotations

import array
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from rosbags.interfaces import Nodetype

from ros2_embedded.messages.field_checks import (
    TYPECODES,
    Check,
    element_check,
    element_text,
    list_check,
)

if TYPE_CHECKING:
    from rosbags.interfaces.typing import FieldDesc


@dataclass(frozen=True, slots=True)
class Field:
    """Behaviour of one message field.

    Attributes:
        name: Name of the field.
        type_text: Type as ``get_fields_and_field_types`` shows it.
        default: Makes the initial value.
        keyword: Converts a constructor argument before it is assigned, or None.
        assign: Checks a value (if the second argument is true) and gives what is stored.
        from_wire: Converts what rosbags read, or None where it is right as it is.
        to_wire: Converts to what rosbags writes, or None where it is right as it is.
        is_number_sequence: True for ``array.array`` fields.
        is_number_array: True for ``numpy.ndarray`` fields.
    """

    name: str
    type_text: str
    default: Callable[[], object]
    assign: Callable[[Any, bool], object]
    keyword: Callable[[Any], object] | None = None
    from_wire: Callable[[Any], object] | None = None
    to_wire: Callable[[Any], object] | None = None
    is_number_sequence: bool = False
    is_number_array: bool = False


def make_field(name: str, desc: FieldDesc, message_class: Callable[[str], type]) -> Field:
    """Describe a field.

    Args:
        name: Name of the field.
        desc: Its parse tree from rosbags.
        message_class: Gets the class of a message type name.

    Returns:
        The behaviour of the field.
    """
    kind, value = cast("tuple[Nodetype, Any]", desc)
    if kind in (Nodetype.BASE, Nodetype.NAME):
        return _single(name, kind, value, message_class)
    (element_kind, element), size = value
    text = element_text(element_kind, element)
    limit = f", {size}" if size else ""
    text = f"{text}[{size}]" if kind == Nodetype.ARRAY else f"sequence<{text}{limit}>"
    fixed = size if kind == Nodetype.ARRAY else None
    bound = size or None if kind == Nodetype.SEQUENCE else None
    python_type, check = element_check(name, element_kind, element, message_class)
    check_list = list_check(name, python_type, check, fixed, bound)
    if element_kind == Nodetype.BASE and element[0] in TYPECODES:
        if fixed is not None:
            return _number_array(name, text, element[0], fixed, check_list)
        return _number_sequence(name, text, element[0], bound, check_list)
    return _list_field(name, text, element_kind, element, python_type, fixed, check_list)


def _single(name: str, kind: Nodetype, value: Any, message_class: Callable[[str], type]) -> Field:
    python_type, check = element_check(name, kind, value, message_class)

    def assign(item: Any, checked: bool) -> object:
        if checked:
            check(item)
        return item

    is_byte = python_type is bytes
    return Field(
        name,
        element_text(kind, value),
        (lambda: b"\x00") if is_byte else python_type,
        assign,
        from_wire=_int_to_byte if is_byte else None,
        to_wire=_byte_to_int if is_byte else None,
    )


def _number_sequence(
    name: str, text: str, base: str, bound: int | None, check_list: Check
) -> Field:
    typecode = TYPECODES[base]

    def from_wire(numbers: np.ndarray) -> array.array[Any]:
        owned = array.array(typecode)
        owned.frombytes(numbers.view(np.uint8).data)
        return owned

    def assign(value: Any, checked: bool) -> object:
        if checked:
            if isinstance(value, array.array):
                assert value.typecode == typecode, (
                    f"The '{name}' array.array() must have the type code of '{typecode}'"
                )
                assert bound is None or len(value) <= bound, (
                    f"The '{name}' array.array() must have a size <= {bound}"
                )
                return value
            check_list(value)
        return array.array(typecode, value)

    return Field(
        name,
        text,
        lambda: array.array(typecode),
        assign,
        keyword=lambda value: array.array(typecode, value),
        from_wire=from_wire,
        to_wire=np.asarray,
        is_number_sequence=True,
    )


def _number_array(name: str, text: str, base: str, size: int, check_list: Check) -> Field:
    dtype = np.dtype(base)

    def assign(value: Any, checked: bool) -> object:
        if checked:
            if isinstance(value, np.ndarray):
                assert value.dtype == dtype, (
                    f"The '{name}' numpy.ndarray() must have the dtype of '{dtype}'"
                )
                assert value.size == size, (
                    f"The '{name}' numpy.ndarray() must have a size of {size}"
                )
                return value
            check_list(value)
        return np.array(value, dtype=dtype)

    def keyword(value: Any) -> object:
        numbers = np.array(value, dtype=dtype)
        assert numbers.shape == (size,), f"The '{name}' field must have the shape ({size},)"
        return numbers

    return Field(
        name,
        text,
        lambda: np.zeros(size, dtype),
        assign,
        keyword=keyword,
        from_wire=np.ndarray.copy,
        to_wire=lambda value: np.ascontiguousarray(value, dtype).reshape(-1),
        is_number_array=True,
    )


def _list_field(
    name: str,
    text: str,
    kind: Nodetype,
    value: Any,
    python_type: type,
    fixed: int | None,
    check_list: Check,
) -> Field:
    def assign(items: Any, checked: bool) -> object:
        if checked:
            check_list(items)
        return items

    def default() -> list[object]:
        make = (lambda: b"\x00") if python_type is bytes else python_type
        return [make() for _ in range(fixed or 0)]

    base = value[0] if kind == Nodetype.BASE else None
    conversions: dict[str, tuple[Callable[[Any], object], Callable[[Any], object]]] = {
        "bool": (np.ndarray.tolist, lambda items: np.array(list(items), dtype=bool)),
        "byte": (_ints_to_bytes, lambda items: np.frombuffer(b"".join(items), np.uint8)),
    }
    from_wire, to_wire = conversions.get(base or "", (None, None))
    return Field(name, text, default, assign, from_wire=from_wire, to_wire=to_wire)


def _int_to_byte(value: int) -> bytes:
    return bytes((value,))


def _byte_to_int(value: bytes) -> int:
    return value[0]


def _ints_to_bytes(values: np.ndarray) -> list[bytes]:
    return [bytes((value,)) for value in values.view(np.uint8).tolist()]
