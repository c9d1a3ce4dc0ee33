# SPDX-License-Identifier: Apache-2.0
"""`ros2 param set`."""

from __future__ import annotations

import argparse

from rcl_interfaces.msg import Parameter
from rclpy.parameter import get_parameter_value

from ros2_embedded.cli.param.node_parameters import add_target_arguments, parameters_of_target


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments.

    Args:
        parser: The parser of the verb.
    """
    add_target_arguments(parser)
    parser.add_argument("parameter_name", help="Name of the parameter")
    parser.add_argument("value", help="Value of the parameter, in YAML")


def main(args: argparse.Namespace) -> None:
    """Set a parameter; a refusal is printed, and no error, as in the full tool.

    Args:
        args: The parsed arguments.
    """
    value = get_parameter_value(args.value)
    with parameters_of_target(args) as parameters:
        parameters.set([Parameter(name=args.parameter_name, value=value)])
