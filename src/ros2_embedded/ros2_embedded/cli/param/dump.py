# SPDX-License-Identifier: Apache-2.0
"""`ros2 param dump`."""

from __future__ import annotations

import argparse
from array import array
from typing import Any

import yaml
from rclpy.parameter import parameter_value_to_python

from ros2_embedded.cli.param.node_parameters import (
    absolute,
    add_target_arguments,
    parameters_of_target,
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments.

    Args:
        parser: The parser of the verb.
    """
    add_target_arguments(parser)


def main(args: argparse.Namespace) -> None:
    """Print the parameters of a node as a parameter file.

    Args:
        args: The parsed arguments.
    """
    with parameters_of_target(args) as parameters:
        names = parameters.names()
        values = parameters.values(names)
    tree: dict[str, Any] = {}
    for name, value in zip(names, values, strict=True):
        plain = parameter_value_to_python(value)
        _insert(tree, name.split("."), plain.tolist() if isinstance(plain, array) else plain)
    print(yaml.safe_dump({absolute(args.node_name): {"ros__parameters": tree}}))


def _insert(tree: dict[str, Any], path: list[str], value: Any) -> None:
    for part in path[:-1]:
        tree = tree.setdefault(part, {})
    tree[path[-1]] = value
