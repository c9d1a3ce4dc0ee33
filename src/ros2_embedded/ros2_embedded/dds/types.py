# SPDX-License-Identifier: Apache-2.0
"""DDS types of ROS message types.

Cyclone checks every sample against its type, so each message type needs a true IDL
structure, although its bytes are written by another serialiser.
"""

from __future__ import annotations

from functools import cache
from typing import Any, cast

from cyclonedds.idl import IdlStruct, make_idl_struct, types
from rosbags.interfaces import Nodetype

from ros2_embedded.messages.definitions import type_store

_BASE_TYPES = {
    "bool": bool,
    "byte": types.byte,
    "int8": types.int8,
    "uint8": types.uint8,
    "int16": types.int16,
    "uint16": types.uint16,
    "int32": types.int32,
    "uint32": types.uint32,
    "int64": types.int64,
    "uint64": types.uint64,
    "float32": types.float32,
    "float64": types.float64,
}


def dds_type_name(ros_type: str) -> str:
    """Get the DDS name of a ROS type.

    Args:
        ros_type: Such as ``std_msgs/msg/String``.

    Returns:
        Such as ``std_msgs::msg::dds_::String_``.
    """
    package, kind, name = ros_type.split("/")
    return f"{package}::{kind}::dds_::{name}_"


@cache
def idl_struct(ros_type: str, with_request_id: bool = False) -> type[IdlStruct]:
    """Get the IDL structure of a ROS message type.

    Args:
        ros_type: Message type, also a request or response of a service.
        with_request_id: Put the client's identity and sequence number first, as
            rmw_cyclonedds does for services.

    Returns:
        The structure.
    """
    members: dict[str, Any] = {}
    if with_request_id:
        members = {"request_client_id": types.uint64, "request_sequence": types.int64}
    members |= {name: _idl_type(desc) for name, desc in type_store().fielddefs[ros_type][1]}
    made: type[IdlStruct] = make_idl_struct(
        ros_type.replace("/", "_"), dds_type_name(ros_type), members
    )
    return made


def _idl_type(desc: Any) -> Any:
    kind, value = cast("tuple[Nodetype, Any]", desc)
    if kind == Nodetype.NAME:
        return idl_struct(value)
    if kind == Nodetype.BASE:
        base, bound = value
        if base == "string":
            return types.bounded_str[bound] if bound else str
        return _BASE_TYPES[base]
    element, size = value
    if kind == Nodetype.ARRAY:
        return types.array[_idl_type(element), size]
    return types.sequence[_idl_type(element), size] if size else types.sequence[_idl_type(element)]
