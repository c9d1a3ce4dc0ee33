# SPDX-License-Identifier: Apache-2.0
"""Parameters and their values."""

from __future__ import annotations

import array
from enum import Enum
from pathlib import Path
from typing import Any, Generic, TypeVar

import yaml
from rcl_interfaces.msg import Parameter as ParameterMsg
from rcl_interfaces.msg import ParameterType, ParameterValue

PARAMETER_SEPARATOR_STRING = "."

AllowableParameterValue = (
    None
    | bool
    | int
    | float
    | str
    | list[bytes]
    | tuple[bytes, ...]
    | list[bool]
    | tuple[bool, ...]
    | list[int]
    | tuple[int, ...]
    | list[float]
    | tuple[float, ...]
    | list[str]
    | tuple[str, ...]
    | Any
)

T = TypeVar("T")

#: Fields of a ParameterValue message by type.
_FIELDS = {
    ParameterType.PARAMETER_BOOL: "bool_value",
    ParameterType.PARAMETER_INTEGER: "integer_value",
    ParameterType.PARAMETER_DOUBLE: "double_value",
    ParameterType.PARAMETER_STRING: "string_value",
    ParameterType.PARAMETER_BYTE_ARRAY: "byte_array_value",
    ParameterType.PARAMETER_BOOL_ARRAY: "bool_array_value",
    ParameterType.PARAMETER_INTEGER_ARRAY: "integer_array_value",
    ParameterType.PARAMETER_DOUBLE_ARRAY: "double_array_value",
    ParameterType.PARAMETER_STRING_ARRAY: "string_array_value",
}


class Parameter(Generic[T]):
    """A named value of one of a few types."""

    class Type(Enum):
        """Types of parameters."""

        NOT_SET = ParameterType.PARAMETER_NOT_SET
        BOOL = ParameterType.PARAMETER_BOOL
        INTEGER = ParameterType.PARAMETER_INTEGER
        DOUBLE = ParameterType.PARAMETER_DOUBLE
        STRING = ParameterType.PARAMETER_STRING
        BYTE_ARRAY = ParameterType.PARAMETER_BYTE_ARRAY
        BOOL_ARRAY = ParameterType.PARAMETER_BOOL_ARRAY
        INTEGER_ARRAY = ParameterType.PARAMETER_INTEGER_ARRAY
        DOUBLE_ARRAY = ParameterType.PARAMETER_DOUBLE_ARRAY
        STRING_ARRAY = ParameterType.PARAMETER_STRING_ARRAY

        @classmethod
        def from_parameter_value(cls, parameter_value: Any) -> Parameter.Type:
            """Find the type of a value.

            Args:
                parameter_value: The value.

            Returns:
                Its type; that of an empty list is ``BYTE_ARRAY``.

            Raises:
                TypeError: A parameter cannot have this value.
            """
            if parameter_value is None:
                return Parameter.Type.NOT_SET
            for python_type, name in _SCALARS:
                if isinstance(parameter_value, python_type):
                    return Parameter.Type[name]
            if not isinstance(parameter_value, list | tuple | array.array):
                raise TypeError(
                    f"The given value is not one of the allowed types '{parameter_value}'."
                )
            for python_type, name in _ELEMENTS:
                if all(isinstance(value, python_type) for value in parameter_value):
                    return Parameter.Type[name]
            raise TypeError(
                f"The given value is not a list of one of the allowed types '{parameter_value}'."
            )

        def check(self, parameter_value: Any) -> bool:
            """Tell whether a value is of this type.

            Args:
                parameter_value: The value.

            Returns:
                Whether it is.
            """
            if self is Parameter.Type.NOT_SET:
                return parameter_value is None
            if self.name in _SCALAR_TYPES:
                return isinstance(parameter_value, _SCALAR_TYPES[self.name])
            sequences: tuple[type[Any], ...] = (list, tuple)
            if self.name in ("INTEGER_ARRAY", "DOUBLE_ARRAY"):
                sequences = (list, tuple, array.array)
            element = _ELEMENT_TYPES[self.name]
            return isinstance(parameter_value, sequences) and all(
                isinstance(value, element) and (element is not bytes or len(value) == 1)
                for value in parameter_value
            )

    @classmethod
    def from_parameter_msg(cls, param_msg: ParameterMsg) -> Parameter[Any]:
        """Make a parameter of a message.

        Args:
            param_msg: The message.

        Returns:
            The parameter.
        """
        kind = Parameter.Type(value=param_msg.value.type)
        return cls(param_msg.name, kind, _message_value(param_msg.value))

    def __init__(self, name: str, type_: Parameter.Type | None = None, value: Any = None) -> None:
        """Create a parameter.

        Args:
            name: Its name.
            type_: Its type; None for that of the value.
            value: Its value.

        Raises:
            TypeError: The type is none, or a parameter cannot have this value.
            ValueError: The value is not of the type.
        """
        if type_ is None:
            type_ = Parameter.Type.from_parameter_value(value)
        if not isinstance(type_, Parameter.Type):
            raise TypeError(f"type must be an instance of '{Parameter.Type!r}'")
        if not type_.check(value):
            raise ValueError(f"Type '{type_}' and value '{value}' do not agree")
        self._type_ = type_
        self._name = name
        self._value = value

    @property
    def name(self) -> str:
        """Name of the parameter."""
        return self._name

    @property
    def type_(self) -> Parameter.Type:
        """Type of the parameter."""
        return self._type_

    @property
    def value(self) -> Any:
        """Value of the parameter."""
        return self._value

    def get_parameter_value(self) -> ParameterValue:
        """Make a message of the value.

        Returns:
            The message.
        """
        message = ParameterValue(type=self.type_.value)
        if self.type_ is not Parameter.Type.NOT_SET:
            setattr(message, _FIELDS[self.type_.value], self.value)
        return message

    def to_parameter_msg(self) -> ParameterMsg:
        """Make a message of the parameter.

        Returns:
            The message.
        """
        return ParameterMsg(name=self.name, value=self.get_parameter_value())


# In the order in which they are tried: a bool is an int as well.
_SCALARS: tuple[tuple[type, str], ...] = (
    (bool, "BOOL"),
    (int, "INTEGER"),
    (float, "DOUBLE"),
    (str, "STRING"),
)
_ELEMENTS: tuple[tuple[type, str], ...] = (
    (bytes, "BYTE_ARRAY"),
    *((python_type, f"{name}_ARRAY") for python_type, name in _SCALARS),
)
_SCALAR_TYPES = {name: python_type for python_type, name in _SCALARS}
_ELEMENT_TYPES: dict[str, Any] = {name: python_type for python_type, name in _ELEMENTS}


def _message_value(value: ParameterValue) -> Any:
    if value.type == ParameterType.PARAMETER_NOT_SET:
        return None
    return getattr(value, _FIELDS[value.type])


def get_parameter_value(string_value: str) -> ParameterValue:
    """Guess the value that a text means.

    Args:
        string_value: A YAML scalar or list.

    Returns:
        The value; a string if it is nothing else.
    """
    try:
        guess = yaml.safe_load(string_value)
    except yaml.parser.ParserError:
        guess = string_value
    try:
        kind = Parameter.Type.from_parameter_value(guess)
    except TypeError:
        kind = Parameter.Type.STRING
    if guess == []:
        kind = Parameter.Type.BOOL_ARRAY
    if kind in (Parameter.Type.NOT_SET, Parameter.Type.STRING) and not isinstance(guess, str):
        kind, guess = Parameter.Type.STRING, string_value
    return Parameter("", kind, guess).get_parameter_value()


def parameter_value_to_python(parameter_value: ParameterValue) -> Any:
    """Get the Python value of a message.

    Args:
        parameter_value: The message.

    Returns:
        The value, arrays as lists; None if it is not set.

    Raises:
        RuntimeError: The message has a type that does not exist.
    """
    kind = parameter_value.type
    if kind not in _FIELDS and kind != ParameterType.PARAMETER_NOT_SET:
        raise RuntimeError(f"unexpected parameter type {kind}")
    value = _message_value(parameter_value)
    return list(value) if kind >= ParameterType.PARAMETER_BYTE_ARRAY else value


def parameter_dict_from_yaml_file(
    parameter_file: str,
    use_wildcard: bool = False,
    target_nodes: list[str] | None = None,
    namespace: str = "",
) -> dict[str, ParameterMsg]:
    """Read a parameter file.

    Args:
        parameter_file: The YAML file.
        use_wildcard: Whether to read what stands under ``/**``.
        target_nodes: Nodes whose parameters to read; None for all.
        namespace: Put before the names.

    Returns:
        The parameters by name.

    Raises:
        RuntimeError: The file has no parameters of such nodes or is no parameter file.
    """
    content = yaml.safe_load(Path(parameter_file).read_text(encoding="utf-8"))
    keys = ["/**"] if use_wildcard and "/**" in content else []
    if missing := [node for node in target_nodes or () if node not in content]:
        raise RuntimeError(
            f"Param file does not contain parameters for {missing[0]},"
            f"only for nodes: {list(content)} "
        )
    keys += target_nodes or [key for key in content if key != "/**"]
    if not keys:
        raise RuntimeError("Param file does not contain selected parameters")
    values: dict[str, Any] = {}
    for key in keys:
        if not isinstance(content[key], dict) or "ros__parameters" not in content[key]:
            raise RuntimeError(f"YAML file is not a valid ROS parameter file for node {key}")
        values.update(content[key]["ros__parameters"])
    return _flatten(namespace, values)


def _flatten(prefix: str, values: dict[str, Any]) -> dict[str, ParameterMsg]:
    parameters: dict[str, ParameterMsg] = {}
    for key, value in values.items():
        name = f"{prefix}{key}"
        if isinstance(value, dict):
            parameters |= _flatten(name + PARAMETER_SEPARATOR_STRING, value)
        else:
            parameters[name] = ParameterMsg(name=name, value=get_parameter_value(str(value)))
    return parameters
