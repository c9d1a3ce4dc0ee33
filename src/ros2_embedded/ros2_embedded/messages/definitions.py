# SPDX-License-Identifier: Apache-2.0
"""The interface definitions known to the runtime, as one rosbags type store.

Messages come from the Jazzy store of rosbags. Services, which rosbags does not have, are
read from the ``.srv`` files in ``ros2_embedded/interfaces``.
"""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from rosbags.interfaces import Nodetype
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from rosbags.typesys.store import Typestore

if TYPE_CHECKING:
    from rosbags.interfaces.typing import FieldDesc, Typesdict

INTERFACES = Path(__file__).parent.parent / "interfaces"

#: Member that rosidl adds to an empty structure, since C has none; it travels on the wire.
EMPTY_MEMBER = "structure_needs_at_least_one_member"

#: Default values in the .msg files, which rosbags does not keep.
FIELD_DEFAULTS: dict[str, dict[str, object]] = {
    "geometry_msgs/msg/Quaternion": {"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0},
}


@cache
def type_store() -> Typestore:
    """Get the store of all definitions, as the wire sees them.

    ``char`` of a ROS 2 definition is an unsigned byte; it is entered as ``uint8``, which
    makes the type hashes equal those of rosidl.

    Returns:
        The one store of this process.
    """
    jazzy = get_typestore(Stores.ROS2_JAZZY)
    store = Typestore()
    for name, (constants, fields) in jazzy.fielddefs.items():
        _enter(store, name, constants, fields)
    for path in sorted(INTERFACES.glob("*/srv/*.srv")):
        _enter_service(store, f"{path.parts[-3]}/srv/{path.stem}", path.read_text())
    return store


def service_halves(name: str) -> tuple[str, str]:
    """Name the request and the response type of a service type.

    Args:
        name: Service type, such as ``std_srvs/srv/SetBool``.

    Returns:
        Names of the request and the response type.
    """
    return f"{name}_Request", f"{name}_Response"


def _enter_service(store: Typestore, name: str, text: str) -> None:
    halves = re.split(r"^---\s*$", text, flags=re.MULTILINE)
    package = name.split("/", maxsplit=1)[0]
    for half_name, half in zip(service_halves(name), halves, strict=True):
        types: Typesdict = get_types_from_msg(half, f"{package}/msg/{half_name.split('/')[-1]}")
        ((constants, fields),) = types.values()
        _enter(store, half_name, constants, fields)


def _enter(store: Typestore, name: str, constants: Any, fields: Any) -> None:
    wire_fields = [(field, _char_as_uint8(desc)) for field, desc in fields]
    store.fielddefs[name] = (
        constants,
        wire_fields or [(EMPTY_MEMBER, (Nodetype.BASE, ("uint8", 0)))],
    )


def _char_as_uint8(desc: FieldDesc) -> FieldDesc:
    kind, value = cast("tuple[Nodetype, Any]", desc)
    if kind == Nodetype.BASE:
        return cast("FieldDesc", (kind, ("uint8", 0) if value[0] == "char" else value))
    if kind == Nodetype.NAME:
        return desc
    element, size = value
    return cast("FieldDesc", (kind, (_char_as_uint8(element), size)))
