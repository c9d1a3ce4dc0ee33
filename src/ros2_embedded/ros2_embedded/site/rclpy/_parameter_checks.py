# SPDX-License-Identifier: Apache-2.0
"""Whether a value fits the descriptor of its parameter."""

from __future__ import annotations

import math
from typing import Any

from rcl_interfaces.msg import ParameterDescriptor, SetParametersResult
from rclpy.parameter import Parameter

#: Relative tolerance of the limits and steps of floating-point parameters.
RELATIVE_TOLERANCE = 1e-6

ACCEPTED = SetParametersResult(successful=True)


def refused(reason: str) -> SetParametersResult:
    """Make a refusal.

    Args:
        reason: Why.

    Returns:
        The result.
    """
    return SetParametersResult(successful=False, reason=reason)


def apply_descriptor(
    parameter: Parameter[Any],
    descriptor: ParameterDescriptor,
    *,
    check_read_only: bool,
    declared: bool,
) -> SetParametersResult:
    """Check a parameter; its name, and if typing is dynamic its type, go into the descriptor.

    Args:
        parameter: The parameter with its new value.
        descriptor: What it may be.
        check_read_only: Whether to refuse a change of a read-only parameter.
        declared: Whether the parameter exists.

    Returns:
        Whether it fits, and the reason if not.
    """
    descriptor.name = parameter.name
    unset = parameter.type_ is Parameter.Type.NOT_SET
    if check_read_only and descriptor.read_only:
        return refused(f"Trying to set a read-only parameter: {parameter.name}.")
    if descriptor.dynamic_typing:
        descriptor.type = parameter.type_.value
    elif declared and unset:
        return refused("Static parameter cannot be undeclared")
    elif not unset and parameter.type_.value != descriptor.type:
        return refused(
            f"Wrong parameter type, expected '{Parameter.Type(descriptor.type)}' "
            f"got '{parameter.type_}'"
        )
    if parameter.type_ is Parameter.Type.INTEGER and descriptor.integer_range:
        return _check_integer(parameter, descriptor.integer_range[0])
    if parameter.type_ is Parameter.Type.DOUBLE and descriptor.floating_point_range:
        return _check_double(parameter, descriptor.floating_point_range[0])
    return ACCEPTED


def _check_integer(parameter: Parameter[Any], limits: Any) -> SetParametersResult:
    low, high = sorted((limits.from_value, limits.to_value))
    value = parameter.value
    # The ends are allowed even if no step leads there.
    if value in (low, high):
        return ACCEPTED
    if not low < value < high:
        return refused(
            f"Parameter {parameter.name} out of range. Min: {low}, Max: {high}, value: {value}"
        )
    if limits.step and (value - low) % limits.step:
        return refused(
            f"The parameter value for {parameter.name} is not a valid step. "
            f"Min: {low}, max: {high}, value: {value}, step: {limits.step}"
        )
    return ACCEPTED


def _check_double(parameter: Parameter[Any], limits: Any) -> SetParametersResult:
    low, high = sorted((limits.from_value, limits.to_value))
    value = parameter.value
    if any(math.isclose(value, end, rel_tol=RELATIVE_TOLERANCE) for end in (low, high)):
        return ACCEPTED
    if not low < value < high:
        return refused(
            f"Parameter {parameter.name} out of range Min: {low}, Max: {high}, value: {value}"
        )
    if limits.step:
        nearest = low + round((value - low) / limits.step) * limits.step
        if not math.isclose(nearest, value, rel_tol=RELATIVE_TOLERANCE):
            return refused(
                f"The parameter value for {parameter.name} is not close enough to a valid step. "
                f"Min: {low}, max: {high}, value: {value}, step: {limits.step}"
            )
    return ACCEPTED
