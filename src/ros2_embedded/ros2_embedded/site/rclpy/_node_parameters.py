# SPDX-License-Identifier: Apache-2.0
"""The parameters of a node: declaring, getting and setting them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from rcl_interfaces.msg import ParameterDescriptor, ParameterEvent, SetParametersResult
from rclpy._parameter_checks import RELATIVE_TOLERANCE
from rclpy._parameter_declaration import read_declaration
from rclpy.clock import Clock
from rclpy.exceptions import (
    InvalidParameterTypeException,
    InvalidParameterValueException,
    ParameterAlreadyDeclaredException,
    ParameterImmutableException,
    ParameterNotDeclaredException,
    ParameterUninitializedException,
)
from rclpy.parameter import PARAMETER_SEPARATOR_STRING, Parameter
from rclpy.publisher import Publisher

PreSetCallback = Callable[[list[Parameter[Any]]], list[Parameter[Any]]]
OnSetCallback = Callable[[list[Parameter[Any]]], SetParametersResult]
PostSetCallback = Callable[[list[Parameter[Any]]], None]


class NodeParameters:
    """The part of a node that holds its parameters."""

    PARAM_REL_TOL = RELATIVE_TOLERANCE

    _clock: Clock
    _parameter_event_publisher: Publisher[ParameterEvent] | None
    _allow_undeclared_parameters: bool

    def __init__(self) -> None:
        """Start without parameters."""
        self._parameters: dict[str, Parameter[Any]] = {}
        self._descriptors: dict[str, ParameterDescriptor] = {}
        self._parameter_overrides: dict[str, Parameter[Any]] = {}
        self._pre_set_parameters_callbacks: list[PreSetCallback] = []
        self._on_set_parameters_callbacks: list[OnSetCallback] = []
        self._post_set_parameters_callbacks: list[PostSetCallback] = []

    def declare_parameter(
        self,
        name: str,
        value: Any = None,
        descriptor: ParameterDescriptor | None = None,
        ignore_override: bool = False,
    ) -> Parameter[Any]:
        """Declare a parameter.

        Args:
            name: Full name.
            value: Its value, or its type (:class:`.Parameter.Type`) if it has none yet.
            descriptor: What it is and may be; name and type in it are overwritten.
            ignore_override: Whether values from the command line are not used.

        Returns:
            The parameter.

        Raises:
            ParameterAlreadyDeclaredException: It was declared before.
            InvalidParameterException: The name is not allowed.
            InvalidParameterTypeException: The value from the command line has another type.
            InvalidParameterValueException: The descriptor or a callback refuses the value.
        """
        if value is None and descriptor is None:
            declaration: tuple[Any, ...] = (name,)
        else:
            declaration = (name, value, descriptor or ParameterDescriptor())
        return self.declare_parameters("", [declaration], ignore_override)[0]

    def declare_parameters(
        self,
        namespace: str,
        parameters: Sequence[tuple[Any, ...]],
        ignore_override: bool = False,
    ) -> list[Parameter[Any]]:
        """Declare several parameters.

        Args:
            namespace: Put before the names with a dot, unless empty.
            parameters: Name, value or type, and descriptor of each; the last two may be
                missing.
            ignore_override: Whether values from the command line are not used.

        Returns:
            The parameters.

        Raises:
            TypeError: A tuple has another form.
            ParameterAlreadyDeclaredException: One was declared before.
            InvalidParameterException: A name is not allowed.
            InvalidParameterTypeException: A value from the command line has another type.
            InvalidParameterValueException: A descriptor or a callback refuses a value.
        """
        declared: list[Parameter[Any]] = []
        descriptors: dict[str, ParameterDescriptor] = {}
        for index, declaration in enumerate(parameters):
            name, value, descriptor = read_declaration(namespace, index, declaration)
            if not ignore_override and name in self._parameter_overrides:
                value = self._parameter_overrides[name].value
            declared.append(Parameter(name, value=value))
            descriptors[name] = descriptor
        known = [parameter.name for parameter in declared if parameter.name in self._parameters]
        if known:
            raise ParameterAlreadyDeclaredException(known)
        for parameter in declared:
            result = self._set_checked([parameter], descriptors, keep_unset=True)
            if result.successful:
                continue
            if result.reason.startswith("Wrong parameter type"):
                kind = Parameter.Type(descriptors[parameter.name].type)
                raise InvalidParameterTypeException(parameter, kind.name)
            raise InvalidParameterValueException(parameter.name, parameter.value, result.reason)
        return [self._parameters[parameter.name] for parameter in declared]

    def undeclare_parameter(self, name: str) -> None:
        """Forget a parameter.

        Args:
            name: Full name.

        Raises:
            ParameterNotDeclaredException: It was not declared.
            ParameterImmutableException: It is read-only.
        """
        if not self.has_parameter(name):
            raise ParameterNotDeclaredException(name)
        if self._descriptors[name].read_only:
            raise ParameterImmutableException(name)
        del self._parameters[name]
        del self._descriptors[name]

    def has_parameter(self, name: str) -> bool:
        """Tell whether a parameter is declared.

        Args:
            name: Full name.

        Returns:
            Whether it is.
        """
        return name in self._parameters

    def get_parameter_types(self, names: list[str]) -> list[Any]:
        """Get the types of several parameters; see :meth:`get_parameter_type`.

        Args:
            names: Full names.

        Returns:
            Their types.

        Raises:
            TypeError: A name is no str.
            ParameterNotDeclaredException: One was not declared.
        """
        _check_names(names)
        return [self.get_parameter_type(name) for name in names]

    def get_parameter_type(self, name: str) -> Any:
        """Get the type of a parameter.

        Args:
            name: Full name.

        Returns:
            The number of its type; ``Parameter.Type.NOT_SET`` of one that is not declared
            where that is allowed.

        Raises:
            ParameterNotDeclaredException: It was not declared.
        """
        if self.has_parameter(name):
            return self._parameters[name].type_.value
        if self._allow_undeclared_parameters:
            return Parameter.Type.NOT_SET
        raise ParameterNotDeclaredException(name)

    def get_parameters(self, names: list[str]) -> list[Parameter[Any]]:
        """Get several parameters; see :meth:`get_parameter`.

        Args:
            names: Full names.

        Returns:
            The parameters.

        Raises:
            TypeError: A name is no str.
            ParameterNotDeclaredException: One was not declared.
            ParameterUninitializedException: One has no value yet.
        """
        _check_names(names)
        return [self.get_parameter(name) for name in names]

    def get_parameter(self, name: str) -> Parameter[Any]:
        """Get a parameter.

        Args:
            name: Full name.

        Returns:
            The parameter; one without value if it is not declared where that is allowed.

        Raises:
            ParameterNotDeclaredException: It was not declared.
            ParameterUninitializedException: It has no value yet.
        """
        if self.has_parameter(name):
            parameter = self._parameters[name]
            unset = parameter.type_ is Parameter.Type.NOT_SET
            if unset and not self._descriptors[name].dynamic_typing:
                raise ParameterUninitializedException(name)
            return parameter
        if self._allow_undeclared_parameters:
            return Parameter(name, Parameter.Type.NOT_SET, None)
        raise ParameterNotDeclaredException(name)

    def get_parameter_or(
        self, name: str, alternative_value: Parameter[Any] | None = None
    ) -> Parameter[Any]:
        """Get a parameter, or another if it is not declared or has no value.

        Args:
            name: Full name.
            alternative_value: The other; None for one without value.

        Returns:
            The parameter or the other.
        """
        parameter = self._parameters.get(name)
        if parameter is not None and parameter.type_ is not Parameter.Type.NOT_SET:
            return parameter
        return alternative_value or Parameter(name, Parameter.Type.NOT_SET)

    def get_parameters_by_prefix(self, prefix: str) -> dict[str, Parameter[Any]]:
        """Get the parameters below a name.

        Args:
            prefix: The name; empty for all.

        Returns:
            The parameters by the rest of their names.
        """
        start = prefix + PARAMETER_SEPARATOR_STRING if prefix else ""
        return {
            name.removeprefix(start): parameter
            for name, parameter in self._parameters.items()
            if name.startswith(start)
        }

    def _set_checked(
        self,
        parameter_list: list[Parameter[Any]],
        descriptors: dict[str, ParameterDescriptor] | None = None,
        keep_unset: bool = False,
    ) -> SetParametersResult:
        raise NotImplementedError


def _check_names(names: list[str]) -> None:
    if not all(isinstance(name, str) for name in names):
        raise TypeError("All names must be instances of type str")
