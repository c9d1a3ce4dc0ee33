# SPDX-License-Identifier: Apache-2.0
"""Message and service classes, made from the definitions when first asked for."""

from __future__ import annotations

import os
import re
from copy import copy
from functools import cache
from operator import attrgetter
from typing import TYPE_CHECKING, Any, ClassVar, Self

from rosbags.typesys.base import normalize_fieldname

from ros2_embedded.messages.definitions import (
    EMPTY_MEMBER,
    FIELD_DEFAULTS,
    service_halves,
    type_store,
)
from ros2_embedded.messages.fields import Field, make_field

if TYPE_CHECKING:
    from collections.abc import Callable

# rosidl checks fields by default up to Iron and, from Jazzy on, if this variable is 1.
# Checking is the default here: a program that passes it runs on all of them.
CHECK_FIELDS = os.environ.get("ROS_PYTHON_CHECK_FIELDS", "1") == "1"


class Message:
    """Base of all message classes; behaves as the classes that rosidl generates."""

    __slots__ = ()
    __hash__ = None  # type: ignore[assignment]

    # Under names that cannot be those of fields or their slots.
    __ros_type__: ClassVar[str]
    __ros_fields__: ClassVar[tuple[Field, ...]]
    __ros_names__: ClassVar[frozenset[str]]
    #: Stands for the member that an empty structure has on the wire.
    _empty_member = 0

    def __init__(self, **kwargs: Any) -> None:
        """Create a message.

        Args:
            **kwargs: Values of fields; ``check_fields`` switches the checks on or off.

        Raises:
            AssertionError: A keyword is no field, or a value does not fit its field.
        """
        checked: bool = kwargs.get("check_fields", CHECK_FIELDS)
        object.__setattr__(self, "_check_fields", checked)
        if kwargs:
            if checked:
                unknown = sorted(kwargs.keys() - self.__ros_names__)
                assert not unknown, f"Invalid arguments passed to constructor: {', '.join(unknown)}"
            for field in self.__ros_fields__:
                if field.name in kwargs:
                    value = kwargs[field.name]
                    setattr(self, field.name, field.keyword(value) if field.keyword else value)
                else:
                    setattr(self, "_" + field.name, field.default())
        else:
            for field in self.__ros_fields__:
                setattr(self, "_" + field.name, field.default())

    def __repr__(self) -> str:
        """Show it as an expression."""
        package = self.__class__.__module__.rpartition(".")[0]
        values = []
        for field in self.__ros_fields__:
            value = getattr(self, field.name)
            shown = value.tolist() if field.is_number_sequence else value
            values.append(f"{field.name}={shown!r}")
        return f"{package}.{self.__class__.__name__}({', '.join(values)})"

    def __eq__(self, other: object) -> bool:
        """Compare all fields."""
        if not isinstance(other, self.__class__):
            return False
        for field in self.__ros_fields__:
            unequal = getattr(self, field.name) != getattr(other, field.name)
            # As in rosidl, arrays differ only if every element does. A program must not
            # get a better answer here than it will get there.
            if unequal.all() if field.is_number_array else unequal:
                return False
        return True

    @classmethod
    def get_fields_and_field_types(cls) -> dict[str, str]:
        """Get the types of the fields by name.

        Returns:
            A new dictionary from field name to type, such as ``sequence<uint8>``.
        """
        return copy({field.name: field.type_text for field in cls.__ros_fields__})

    @classmethod
    def __from_wire__(cls, *values: Any) -> Self:
        """Make a message of the values of all its fields as rosbags read them.

        Args:
            *values: Values in the order of the fields.

        Returns:
            The message, which owns all its data.
        """
        raise NotImplementedError


@cache
def message_class(ros_type: str) -> type[Message]:
    """Get the class of a message type.

    Args:
        ros_type: Type name such as ``std_msgs/msg/String`` or ``std_srvs/srv/SetBool_Request``.

    Returns:
        The class, always the same one.

    Raises:
        KeyError: There is no such type.
    """
    constants, definitions = type_store().fielddefs[ros_type]
    defaults = FIELD_DEFAULTS.get(ros_type, {})
    fields = tuple(
        make_field(normalize_fieldname(name), desc, message_class)
        for name, desc in definitions
        if name != EMPTY_MEMBER
    )
    values: dict[str, object] = {
        name: bytes((value,)) if kind == "byte" else value  # type: ignore[arg-type]
        for name, kind, value in constants
    }
    values |= {f"{name.upper()}__DEFAULT": value for name, value in defaults.items()}
    fields = tuple(_with_default(field, defaults) for field in fields)
    package, kind, name = ros_type.split("/")
    namespace: dict[str, Any] = {
        "__slots__": [f"_{field.name}" for field in fields] + ["_check_fields"],
        "__module__": f"{package}.{kind}._{_snake_case(name.removesuffix(_half(name)))}",
        "__doc__": f"Message class '{name}'.",
        "__ros_type__": ros_type,
        "__ros_fields__": fields,
        "__ros_names__": frozenset(field.name for field in fields) | {"check_fields"},
        **values,
    }
    for field in fields:
        namespace[field.name] = property(
            attrgetter(f"_{field.name}"), _setter(field), None, f"Message field '{field.name}'."
        )
        if field.to_wire is not None:
            namespace[f"_wire_{field.name}"] = property(_wire_getter(field))
    cls: type[Message] = _metaclass(name, values)(name, (Message,), namespace)
    cls.__from_wire__ = _make_from_wire(cls)  # type: ignore[method-assign]
    return cls


@cache
def service_class(ros_type: str) -> type:
    """Get the class of a service type, which holds ``Request`` and ``Response``.

    Args:
        ros_type: Type name such as ``std_srvs/srv/SetBool``.

    Returns:
        The class, always the same one.

    Raises:
        KeyError: There is no such type.
    """
    request, response = map(message_class, service_halves(ros_type))
    package, _, name = ros_type.split("/")

    def refuse(self: object) -> None:
        raise NotImplementedError("Service classes can not be instantiated")

    return type(
        name,
        (),
        {
            "__module__": f"{package}.srv._{_snake_case(name)}",
            "__doc__": f"Service class '{name}'.",
            "__init__": refuse,
            "__ros_type__": ros_type,
            "Request": request,
            "Response": response,
        },
    )


def _half(name: str) -> str:
    return next((half for half in ("_Request", "_Response") if name.endswith(half)), "")


def _snake_case(name: str) -> str:
    name = re.sub("(.)([A-Z][a-z]+)", r"\1_\2", name)
    return re.sub("([a-z0-9])([A-Z])", r"\1_\2", name).lower()


def _with_default(field: Field, defaults: dict[str, object]) -> Field:
    if field.name not in defaults:
        return field
    value = defaults[field.name]
    return Field(field.name, field.type_text, lambda: value, field.assign)


def _metaclass(name: str, constants: dict[str, object]) -> type:
    """Make constants read-only attributes of the class, as rosidl does."""
    properties = {
        key: property(_constant(value), None, None, f"Message constant '{key}'.")
        for key, value in constants.items()
    }
    return type(f"Metaclass_{name}", (type,), properties)


def _constant(value: object) -> Callable[[type], object]:
    return lambda cls: value


def _setter(field: Field) -> Callable[[Message, Any], None]:
    slot, assign = f"_{field.name}", field.assign

    def set_value(self: Any, value: Any) -> None:
        setattr(self, slot, assign(value, self._check_fields))

    return set_value


def _wire_getter(field: Field) -> Callable[[Message], object]:
    slot, to_wire = attrgetter(f"_{field.name}"), field.to_wire
    assert to_wire is not None
    return lambda self: to_wire(slot(self))


def _make_from_wire(cls: type[Message]) -> Callable[..., Message]:
    # Written as source, as dataclasses does: one call per message and no loop over fields.
    lines = ["def from_wire(*values):", " message = new(cls)"]
    lines.append(" message._check_fields = check_fields")
    scope: dict[str, Any] = {"new": cls.__new__, "cls": cls, "check_fields": CHECK_FIELDS}
    for index, field in enumerate(cls.__ros_fields__):
        scope[f"convert_{index}"] = field.from_wire
        value = f"convert_{index}(values[{index}])" if field.from_wire else f"values[{index}]"
        lines.append(f" message._{field.name} = {value}")
    lines.append(" return message")
    exec("\n".join(lines), scope)
    made: Callable[..., Message] = scope["from_wire"]
    return made
