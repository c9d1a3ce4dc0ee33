# SPDX-License-Identifier: Apache-2.0
"""`ros2 param describe`."""

from __future__ import annotations

import argparse

from rcl_interfaces.msg import ParameterDescriptor

from ros2_embedded.cli.param.node_parameters import (
    add_target_arguments,
    parameters_of_target,
    type_name,
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments.

    Args:
        parser: The parser of the verb.
    """
    add_target_arguments(parser)
    parser.add_argument("parameter_names", nargs="+", help="Names of the parameters")


def main(args: argparse.Namespace) -> None:
    """Print the descriptors of parameters.

    Args:
        args: The parsed arguments.
    """
    with parameters_of_target(args) as parameters:
        for descriptor in parameters.descriptors(args.parameter_names):
            _print(descriptor)


def _print(descriptor: ParameterDescriptor) -> None:
    print(f"Parameter name: {descriptor.name}")
    print(f"  Type: {type_name(descriptor.type)}")
    if descriptor.description:
        print(f"  Description: {descriptor.description}")
    print("  Constraints:")
    if descriptor.read_only:
        print("    Read only: true")
    for limits in [*descriptor.floating_point_range, *descriptor.integer_range][:1]:
        print(f"    Min value: {limits.from_value}")
        print(f"    Max value: {limits.to_value}")
        if limits.step:
            print(f"    Step: {limits.step}")
    if descriptor.additional_constraints:
        print(f"    Additional constraints: {descriptor.additional_constraints}")
