# SPDX-License-Identifier: Apache-2.0
"""`ros2 param load`."""

from __future__ import annotations

import argparse

from rclpy.parameter import parameter_dict_from_yaml_file

from ros2_embedded.cli.param.node_parameters import add_target_arguments, parameters_of_target


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments.

    Args:
        parser: The parser of the verb.
    """
    add_target_arguments(parser)
    parser.add_argument("parameter_file", help="Parameter file")
    parser.add_argument(
        "--no-use-wildcard",
        action="store_true",
        help="Do not load parameters of '/**' into the node",
    )


def main(args: argparse.Namespace) -> None:
    """Set the parameters that a file holds, whichever node it holds them for.

    Args:
        args: The parsed arguments.

    Raises:
        RuntimeError: The file cannot be read, or there is no such node.
    """
    try:
        loaded = parameter_dict_from_yaml_file(
            args.parameter_file, use_wildcard=not args.no_use_wildcard
        )
    except OSError as error:
        raise RuntimeError(f"Cannot read '{args.parameter_file}': {error.strerror}") from error
    with parameters_of_target(args) as parameters:
        parameters.set(list(loaded.values()))
