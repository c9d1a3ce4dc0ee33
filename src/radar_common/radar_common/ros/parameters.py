# SPDX-License-Identifier: Apache-2.0
"""A `Parameters` class as the parameters of a node, with ranges, choices and reasons for refusal."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Generic, TypeVar

from rcl_interfaces.msg import (
    FloatingPointRange,
    IntegerRange,
    ParameterDescriptor,
    SetParametersResult,
)
from rclpy.node import Node
from rclpy.parameter import Parameter

from radar_common.parameters import Description, ParameterError, Parameters, describe

ParametersT = TypeVar("ParametersT", bound=Parameters)

_INTEGER_LIMIT = 2**63 - 1
_FLOAT_LIMIT = float.fromhex("0x1.fffffffffffffp+1023")


class NodeParameters(Generic[ParametersT]):
    """Declares a parameter set on a node and keeps its present values."""

    def __init__(
        self,
        node: Node,
        cls: type[ParametersT],
        on_change: Callable[[ParametersT], None] | None = None,
    ) -> None:
        """Declare all parameters and read what the user gave.

        Args:
            node: owner.
            cls: the set.
            on_change: called with the new set after a change at run time has been accepted.

        Raises:
            ParameterError: the values given by the user do not go together.
        """
        self._names = {item.name for item in describe(cls)}
        self._on_change = on_change
        for item in describe(cls):
            node.declare_parameter(item.name, item.default, _descriptor(item))
        given = {name: node.get_parameter(name).value for name in self._names}
        self.values: ParametersT = cls().changed(given)
        node.add_on_set_parameters_callback(self._check)
        node.add_post_set_parameters_callback(self._accept)

    def _check(self, parameters: Sequence[Parameter]) -> SetParametersResult:
        try:
            self._after(parameters)
        except ParameterError as error:
            return SetParametersResult(successful=False, reason=str(error))
        return SetParametersResult(successful=True)

    def _accept(self, parameters: Sequence[Parameter]) -> None:
        new = self._after(parameters)
        if new != self.values:
            self.values = new
            if self._on_change is not None:
                self._on_change(new)

    def _after(self, parameters: Sequence[Parameter]) -> ParametersT:
        ours = {p.name: p.value for p in parameters if p.name in self._names}
        return self.values.changed(ours)


def _descriptor(item: Description) -> ParameterDescriptor:
    descriptor = ParameterDescriptor(
        name=item.name,
        description=f"{item.text} [{item.unit}]" if item.unit else item.text,
        read_only=item.read_only,
    )
    if item.choices:
        descriptor.additional_constraints = "one of: " + ", ".join(item.choices)
    if item.low is None and item.high is None:
        return descriptor
    if item.kind is int:
        low = -_INTEGER_LIMIT if item.low is None else int(item.low)
        high = _INTEGER_LIMIT if item.high is None else int(item.high)
        # Step 0 means continuous: every whole number is allowed.
        descriptor.integer_range = [IntegerRange(from_value=low, to_value=high, step=0)]
    else:
        low_value = -_FLOAT_LIMIT if item.low is None else float(item.low)
        high_value = _FLOAT_LIMIT if item.high is None else float(item.high)
        descriptor.floating_point_range = [
            FloatingPointRange(from_value=low_value, to_value=high_value, step=0.0)
        ]
    return descriptor
