# SPDX-License-Identifier: Apache-2.0
"""`ros2 param get`."""

from __future__ import annotations

import argparse

from rcl_interfaces.msg import ParameterType
from rclpy.parameter import parameter_value_to_python

from ros2_embedded.cli.param.node_parameters import add_target_arguments, parameters_of_target

_LABELS = {
    ParameterType.PARAMETER_BOOL: "Boolean value is:",
    ParameterType.PARAMETER_INTEGER: "Integer value is:",
    ParameterType.PARAMETER_DOUBLE: "Double value is:",
    ParameterType.PARAMETER_STRING: "String value is:",
    ParameterType.PARAMETER_BYTE_ARRAY: "Byte values are:",
    ParameterType.PARAMETER_BOOL_ARRAY: "Boolean values are:",
    ParameterType.PARAMETER_INTEGER_ARRAY: "Integer values are:",
    ParameterType.PARAMETER_DOUBLE_ARRAY: "Double values are:",
    ParameterType.PARAMETER_STRING_ARRAY: "String values are:",
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments.

    Args:
        parser: The parser of the verb.
    """
    add_target_arguments(parser)
    parser.add_argument("parameter_name", help="Name of the parameter")
    parser.add_argument("--hide-type", action="store_true", help="Hide the type information")


def main(args: argparse.Namespace) -> str | None:
    """Print the value of a parameter.

    Args:
        args: The parsed arguments.

    Returns:
        The error, None if there is none.
    """
    with parameters_of_target(args) as parameters:
        values = parameters.values([args.parameter_name])
    if not values:
        return "Parameter not set"
    value = parameter_value_to_python(values[0])
    label = _LABELS.get(values[0].type)
    if args.hide_type:
        print(value)
    elif label is None:
        print("Parameter not set.")
    else:
        print(label, value)
    return None
