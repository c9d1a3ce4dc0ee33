# SPDX-License-Identifier: Apache-2.0
"""Setting the parameters of a node, with callbacks, and describing them."""

from __future__ import annotations

from typing import Any

from rcl_interfaces.msg import (
    ListParametersResult,
    ParameterDescriptor,
    ParameterEvent,
    ParameterValue,
    SetParametersResult,
)
from rcl_interfaces.msg import Parameter as ParameterMsg
from rclpy._node_parameters import (
    NodeParameters,
    OnSetCallback,
    PostSetCallback,
    PreSetCallback,
)
from rclpy._parameter_checks import ACCEPTED, apply_descriptor, refused
from rclpy._parameter_listing import list_names
from rclpy.exceptions import (
    InvalidParameterValueException,
    ParameterImmutableException,
    ParameterNotDeclaredException,
)
from rclpy.parameter import Parameter


class NodeParameterSetting(NodeParameters):
    """The part of a node that changes its parameters."""

    def set_parameters(self, parameter_list: list[Parameter[Any]]) -> list[SetParametersResult]:
        """Set parameters one after the other.

        Args:
            parameter_list: The parameters with their new values.

        Returns:
            Whether each was set, and the reason if not.

        Raises:
            ParameterNotDeclaredException: One was not declared; those before it are set.
        """
        return [self.set_parameters_atomically([parameter]) for parameter in parameter_list]

    def set_parameters_atomically(
        self, parameter_list: list[Parameter[Any]]
    ) -> SetParametersResult:
        """Set all parameters or none.

        Args:
            parameter_list: The parameters with their new values.

        Returns:
            Whether they were set, and the reason if not.

        Raises:
            TypeError: One is no parameter.
            ParameterNotDeclaredException: One was not declared.
        """
        if self._pre_set_parameters_callbacks:
            changed: list[Parameter[Any]] = []
            for callback in self._pre_set_parameters_callbacks:
                changed.extend(callback(parameter_list))
            parameter_list = changed
            if not parameter_list:
                return refused(
                    "parameter list cannot be empty, this might be due to "
                    "pre_set_parameters_callback modifying the original parameters list."
                )
        if not all(isinstance(parameter, Parameter) for parameter in parameter_list):
            raise TypeError(f"parameter must be instance of type '{Parameter!r}'")
        unknown = [p.name for p in parameter_list if p.name not in self._parameters]
        if unknown and not self._allow_undeclared_parameters:
            raise ParameterNotDeclaredException(unknown)
        return self._set_checked(parameter_list)

    def _set_checked(
        self,
        parameter_list: list[Parameter[Any]],
        descriptors: dict[str, ParameterDescriptor] | None = None,
        keep_unset: bool = False,
    ) -> SetParametersResult:
        """Set parameters that need not be declared.

        Args:
            parameter_list: The parameters.
            descriptors: New descriptors of all of them; None to keep the old ones.
            keep_unset: Whether a parameter without value is stored, not undeclared.

        Returns:
            Whether they were set, and the reason if not.
        """
        known = self._descriptors if descriptors is None else descriptors
        for parameter in parameter_list:
            if parameter.name in known:
                result = apply_descriptor(
                    parameter,
                    known[parameter.name],
                    check_read_only=descriptors is None,
                    declared=self.has_parameter(parameter.name),
                )
                if not result.successful:
                    return result
        for callback in self._on_set_parameters_callbacks:
            result = callback(parameter_list)
            if not result.successful:
                return result
        self._store(parameter_list, descriptors, keep_unset)
        for done in self._post_set_parameters_callbacks:
            done(parameter_list)
        return SetParametersResult(successful=True)

    def _store(
        self,
        parameter_list: list[Parameter[Any]],
        descriptors: dict[str, ParameterDescriptor] | None,
        keep_unset: bool,
    ) -> None:
        event = ParameterEvent(node=self.get_fully_qualified_name())
        for parameter in parameter_list:
            name = parameter.name
            if parameter.type_ is Parameter.Type.NOT_SET and not keep_unset:
                event.deleted_parameters.append(parameter.to_parameter_msg())
                self._parameters.pop(name, None)
                self._descriptors.pop(name, None)
                continue
            if descriptors is not None:
                self._descriptors[name] = descriptors[name]
            else:
                self._descriptors.setdefault(name, ParameterDescriptor(dynamic_typing=True))
            if self.get_parameter_or(name).type_ is Parameter.Type.NOT_SET:
                event.new_parameters.append(parameter.to_parameter_msg())
            else:
                event.changed_parameters.append(parameter.to_parameter_msg())
            self._parameters[name] = parameter
        event.stamp = self._clock.now().to_msg()
        if self._parameter_event_publisher is not None:
            self._parameter_event_publisher.publish(event)

    def get_fully_qualified_name(self) -> str:
        """Get namespace and name.

        Returns:
            Such as ``/namespace/name``.
        """
        raise NotImplementedError

    def list_parameters(self, prefixes: list[str], depth: int) -> ListParametersResult:
        """List parameters.

        Args:
            prefixes: Show those with or below these names only; empty for all.
            depth: How many generations below; 0 for all.

        Returns:
            The names and the names above them.

        Raises:
            TypeError: An argument has another type.
            ValueError: The depth is negative.
        """
        return list_names(self._parameters, prefixes, depth)

    def describe_parameter(self, name: str) -> ParameterDescriptor:
        """Get the descriptor of a parameter.

        Args:
            name: Full name.

        Returns:
            The descriptor; an empty one if it is not declared where that is allowed.

        Raises:
            ParameterNotDeclaredException: It was not declared.
        """
        if name in self._descriptors:
            return self._descriptors[name]
        if self._allow_undeclared_parameters:
            return ParameterDescriptor()
        raise ParameterNotDeclaredException(name)

    def describe_parameters(self, names: list[str]) -> list[ParameterDescriptor]:
        """Get several descriptors; see :meth:`describe_parameter`.

        Args:
            names: Full names.

        Returns:
            The descriptors.

        Raises:
            ParameterNotDeclaredException: One was not declared.
        """
        return [self.describe_parameter(name) for name in names]

    def set_descriptor(
        self,
        name: str,
        descriptor: ParameterDescriptor,
        alternative_value: ParameterValue | None = None,
    ) -> ParameterValue:
        """Change the descriptor of a parameter.

        Args:
            name: Full name.
            descriptor: The new one.
            alternative_value: Set if the value does not fit.

        Returns:
            The value that the parameter has then.

        Raises:
            ParameterNotDeclaredException: It was not declared.
            ParameterImmutableException: It is read-only.
            InvalidParameterValueException: No value fits.
        """
        if not self.has_parameter(name):
            if not self._allow_undeclared_parameters:
                raise ParameterNotDeclaredException(name)
            return self.get_parameter(name).get_parameter_value()
        if self.describe_parameter(name).read_only:
            raise ParameterImmutableException(name)
        candidates = [self.get_parameter(name)]
        if alternative_value is not None:
            message = ParameterMsg(name=name, value=alternative_value)
            candidates.append(Parameter.from_parameter_msg(message))
        result = ACCEPTED
        for candidate in candidates:
            result = apply_descriptor(candidate, descriptor, check_read_only=False, declared=True)
            if result.successful:
                self._parameters[name] = candidate
                self._descriptors[name] = descriptor
                return candidate.get_parameter_value()
        raise InvalidParameterValueException(name, candidates[-1].value, result.reason)

    def add_pre_set_parameters_callback(self, callback: PreSetCallback) -> None:
        """Have parameters changed before they are checked; not at declarations.

        Args:
            callback: Gets the parameters and returns those to set.
        """
        self._pre_set_parameters_callbacks.insert(0, callback)

    def add_on_set_parameters_callback(self, callback: OnSetCallback) -> None:
        """Have parameters checked before they are set or declared.

        Args:
            callback: Gets the parameters and tells whether they may be set.
        """
        self._on_set_parameters_callbacks.insert(0, callback)

    def add_post_set_parameters_callback(self, callback: PostSetCallback) -> None:
        """Have something done after parameters were set or declared.

        Args:
            callback: Gets the parameters.
        """
        self._post_set_parameters_callbacks.insert(0, callback)

    def remove_pre_set_parameters_callback(self, callback: PreSetCallback) -> None:
        """Stop calling.

        Args:
            callback: The callback.

        Raises:
            ValueError: It was not added.
        """
        self._pre_set_parameters_callbacks.remove(callback)

    def remove_on_set_parameters_callback(self, callback: OnSetCallback) -> None:
        """Stop calling.

        Args:
            callback: The callback.

        Raises:
            ValueError: It was not added.
        """
        self._on_set_parameters_callbacks.remove(callback)

    def remove_post_set_parameters_callback(self, callback: PostSetCallback) -> None:
        """Stop calling.

        Args:
            callback: The callback.

        Raises:
            ValueError: It was not added.
        """
        self._post_set_parameters_callbacks.remove(callback)
