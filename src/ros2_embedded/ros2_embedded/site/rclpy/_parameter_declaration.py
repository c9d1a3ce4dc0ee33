# SPDX-License-Identifier: Apache-2.0
"""What the arguments of a declaration of parameters mean."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from typing import Any

from rcl_interfaces.msg import ParameterDescriptor, ParameterType, ParameterValue
from rclpy.parameter import Parameter
from rclpy.validate_parameter_name import validate_parameter_name


def read_declaration(
    namespace: str, index: int, declaration: Sequence[Any]
) -> tuple[str, Any, ParameterDescriptor]:
    """Check a declaration and complete it.

    Args:
        namespace: Put before the name with a dot, if there is one.
        index: Place of the declaration among others, for messages.
        declaration: Name, value or type, and descriptor; the last two may be missing.

    Returns:
        Full name, value (None if only the type is given) and the descriptor with the type.

    Raises:
        TypeError: The declaration has another form.
        ValueError: It says neither a value nor a type, or both.
        InvalidParameterException: The name is not allowed.
    """
    if not 1 <= len(declaration) <= 3:
        raise TypeError(
            f"Invalid parameter tuple length at index {index} in parameters list: "
            f"{declaration}; expecting length between 1 and 3"
        )
    name = declaration[0]
    if not isinstance(name, str):
        raise TypeError(f"First element {name} at index {index} in parameters list is not a str.")
    name = f"{namespace}.{name}" if namespace else name
    validate_parameter_name(name)
    value = declaration[1] if len(declaration) > 1 else None
    descriptor = declaration[2] if len(declaration) > 2 else ParameterDescriptor()
    if not isinstance(descriptor, ParameterDescriptor):
        raise TypeError(
            f"Third element {descriptor} at index {index} in parameters list is not a "
            "ParameterDescriptor."
        )
    if len(declaration) == 1:
        warnings.warn(
            f"when declaring parameter named '{name}', declaring a parameter only providing its "
            "name is deprecated. Give a default value, a type, or a descriptor with "
            "dynamic_typing=True",
            stacklevel=4,
        )
        descriptor.dynamic_typing = True
    if isinstance(value, Parameter.Type):
        _set_type(name, value, descriptor)
        value = None
    elif not descriptor.dynamic_typing:
        kind = _type_of(value)
        if kind == ParameterType.PARAMETER_NOT_SET:
            raise ValueError(
                "Cannot declare a statically typed parameter with default value of type "
                "PARAMETER_NOT_SET"
            )
        descriptor.type = kind
    return name, value, descriptor


def _set_type(name: str, kind: Parameter.Type, descriptor: ParameterDescriptor) -> None:
    if kind is Parameter.Type.NOT_SET:
        raise ValueError(f"Cannot declare parameter {{{name}}} as statically typed of type NOT_SET")
    if descriptor.dynamic_typing:
        raise ValueError(
            f"When declaring parameter {{{name}}} passing a descriptor with "
            "`dynamic_typing=True` is not allowed when the parameter type is provided"
        )
    descriptor.type = kind.value


def _type_of(value: Any) -> int:
    if isinstance(value, ParameterValue):
        return int(value.type)
    return int(Parameter.Type.from_parameter_value(value).value)
