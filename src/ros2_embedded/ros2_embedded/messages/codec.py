# SPDX-License-Identifier: Apache-2.0
"""Messages to and from CDR, the wire format of DDS, with the code generator of rosbags."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any, NamedTuple, cast

from rosbags.interfaces import Nodetype
from rosbags.serde.cdr import (
    generate_deserialize_cdr,
    generate_getsize_cdr,
    generate_serialize_cdr,
)

from ros2_embedded.messages.classes import Message, message_class
from ros2_embedded.messages.definitions import EMPTY_MEMBER, type_store

if TYPE_CHECKING:
    from collections.abc import Callable

#: Encapsulation header: CDR, little-endian, no options.
LITTLE_ENDIAN_HEADER = b"\x00\x01\x00\x00"


class WireFunctions(NamedTuple):
    """Generated functions of one type, under the names that generated code looks up."""

    fields: list[tuple[str, Any]]
    cls: Callable[..., object]
    size_cdr: int
    getsize_cdr: Callable[..., int]
    serialize_cdr_le: Callable[..., int]
    deserialize_cdr_le: Callable[..., tuple[Any, int]]
    deserialize_cdr_be: Callable[..., tuple[Any, int]]


class _WireStore:
    """Stands for a rosbags type store in generated code; it finds the nested types."""

    max_sequence_length = 2**32 - 1

    def __init__(self) -> None:
        self.get_msgdef = cache(self._generate)

    def _generate(self, typename: str) -> WireFunctions:
        cls = message_class(typename)
        converted = {field.name for field in cls.__ros_fields__ if field.to_wire}
        fields = [
            (_attribute(name, name in converted), _byte_as_uint8(desc))
            for name, desc in type_store().fielddefs[typename][1]
        ]
        store = cast("Any", self)
        getsize, size = generate_getsize_cdr(fields, store)
        return WireFunctions(
            fields,
            cls.__from_wire__,
            size,
            cast("Any", getsize),
            cast("Any", generate_serialize_cdr(fields, store, "le")),
            cast("Any", generate_deserialize_cdr(fields, store, "le")),
            cast("Any", generate_deserialize_cdr(fields, store, "be")),
        )


def _attribute(name: str, converted: bool) -> str:
    if name == EMPTY_MEMBER:
        return "_empty_member"
    return f"_wire_{name}" if converted else f"_{name}"


def _byte_as_uint8(desc: Any) -> Any:
    # rosbags writes bytes as signed numbers, which cannot be above 127.
    kind, value = cast("tuple[Nodetype, Any]", desc)
    if kind == Nodetype.BASE:
        return (kind, ("uint8", 0) if value[0] == "byte" else value)
    if kind == Nodetype.NAME:
        return desc
    element, size = value
    return (kind, (_byte_as_uint8(element), size))


_STORE = _WireStore()


def serialize(message: Message, prefix: bytes = b"") -> bytearray:
    """Write a message as CDR.

    Args:
        message: The message.
        prefix: Bytes between the header and the message, a multiple of eight of them.

    Returns:
        Header, prefix and message, padded to a multiple of four bytes as DDS needs it.

    Raises:
        struct.error: A number does not fit its field (where checks are switched off).
    """
    functions = _STORE.get_msgdef(message.__ros_type__)
    start = len(LITTLE_ENDIAN_HEADER) + len(prefix)
    size = start + functions.getsize_cdr(0, message, _STORE)
    buffer = bytearray(-(-size // 4) * 4)
    buffer[:start] = LITTLE_ENDIAN_HEADER + prefix
    functions.serialize_cdr_le(memoryview(buffer)[start:], 0, message, _STORE)
    return buffer


def deserialize(data: bytes | memoryview, ros_type: str, skip: int = 0) -> Message:
    """Read a message from CDR.

    Args:
        data: Header and message.
        ros_type: Type of the message.
        skip: Bytes between the header and the message to pass over.

    Returns:
        The message; it owns its data.

    Raises:
        ValueError: The data are not a message of this type.
    """
    view = memoryview(data)
    if len(view) < 4 + skip or view[0] or view[1] > 1:
        raise ValueError(f"data are not CDR: {bytes(view[:4])!r}")
    functions = _STORE.get_msgdef(ros_type)
    read = functions.deserialize_cdr_le if view[1] else functions.deserialize_cdr_be
    try:
        message, _ = read(view[4 + skip :], 0, functions.cls, _STORE)
    except Exception as error:
        raise ValueError(f"cannot read a {ros_type}: {error}") from error
    return cast("Message", message)


@cache
def type_hash(ros_type: str) -> str:
    """Get the hash that tells two versions of a message definition apart (REP-2011).

    Args:
        ros_type: Message type.

    Returns:
        The hash, such as ``RIHS01_df668c…``.
    """
    return type_store().hash_rihs01(ros_type)


def nested_types(ros_type: str) -> set[str]:
    """Find the message types that a type uses, directly or through others.

    Args:
        ros_type: Message type.

    Returns:
        Names of the types used.
    """
    found: set[str] = set()
    for _, desc in type_store().fielddefs[ros_type][1]:
        kind, value = cast("tuple[Nodetype, Any]", desc)
        if kind in (Nodetype.ARRAY, Nodetype.SEQUENCE):
            kind, value = value[0]
        if kind == Nodetype.NAME and value not in found:
            found |= {value} | nested_types(value)
    return found
