# SPDX-License-Identifier: Apache-2.0
"""The parameters of another node, through the services that it offers for them."""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import rclpy
from rcl_interfaces.msg import Parameter, ParameterDescriptor, ParameterType, ParameterValue
from rcl_interfaces.srv import (
    DescribeParameters,
    GetParameters,
    ListParameters,
    SetParameters,
)
from rclpy.node import Node

from ros2_embedded.cli.direct_node import add_node_arguments, direct_node
from ros2_embedded.cli.graph import node_names
from ros2_embedded.cli.service_call import call_service

_TYPE_NAMES = {
    ParameterType.PARAMETER_NOT_SET: "not set",
    ParameterType.PARAMETER_BOOL: "boolean",
    ParameterType.PARAMETER_INTEGER: "integer",
    ParameterType.PARAMETER_DOUBLE: "double",
    ParameterType.PARAMETER_STRING: "string",
    ParameterType.PARAMETER_BYTE_ARRAY: "byte array",
    ParameterType.PARAMETER_BOOL_ARRAY: "boolean array",
    ParameterType.PARAMETER_INTEGER_ARRAY: "integer array",
    ParameterType.PARAMETER_DOUBLE_ARRAY: "double array",
    ParameterType.PARAMETER_STRING_ARRAY: "string array",
}


def type_name(kind: int) -> str:
    """Return a parameter type in words.

    Args:
        kind: A constant of `rcl_interfaces/msg/ParameterType`.
    """
    return _TYPE_NAMES[kind]


class NodeParameters:
    """Calls the parameter services of a node; each method raises RuntimeError if it cannot.

    Args:
        node: The node that calls.
        target: Full name of the node that has the parameters.
    """

    def __init__(self, node: Node, target: str) -> None:
        self._node = node
        self._target = target

    def names(self, prefixes: Sequence[str] = ()) -> list[str]:
        """Return the names of the declared parameters, sorted.

        Args:
            prefixes: Only those below these prefixes; none gives all.
        """
        request = ListParameters.Request(prefixes=list(prefixes))
        return sorted(self._call(ListParameters, "list_parameters", request).result.names)

    def values(self, names: list[str]) -> list[ParameterValue]:
        """Return values; none at all if one of the names is not declared.

        Args:
            names: The names.
        """
        request = GetParameters.Request(names=names)
        return list(self._call(GetParameters, "get_parameters", request).values)

    def descriptors(self, names: list[str]) -> list[ParameterDescriptor]:
        """Return descriptors; none at all if one of the names is not declared.

        Args:
            names: The names.
        """
        request = DescribeParameters.Request(names=names)
        return list(self._call(DescribeParameters, "describe_parameters", request).descriptors)

    def set(self, parameters: Sequence[Parameter]) -> None:
        """Set values one by one, and print what became of each.

        Args:
            parameters: Names and values.
        """
        request = SetParameters.Request(parameters=list(parameters))
        results = self._call(SetParameters, "set_parameters", request).results
        for parameter, result in zip(parameters, results, strict=True):
            name = f" {parameter.name}" if len(parameters) > 1 else ""
            reason = f": {result.reason}" if result.reason else ""
            if result.successful:
                print(f"Set parameter{name} successful{reason}")
            else:
                print(f"Setting parameter{name} failed{reason}", file=sys.stderr)

    def _call(self, kind: type[Any], service: str, request: Any) -> Any:
        return call_service(self._node, kind, f"{self._target}/{service}", request)


def add_target_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of a verb about one node.

    Args:
        parser: The parser of the verb.
    """
    add_node_arguments(parser)
    parser.add_argument("node_name", help="Name of the ROS node")
    parser.add_argument(
        "--include-hidden-nodes", action="store_true", help="Consider hidden nodes as well"
    )
    parser.add_argument(
        "--timeout",
        metavar="N",
        type=float,
        default=1.0,
        help="Wait for N seconds until node becomes available (default %(default)g sec)",
    )


@contextmanager
def parameters_of_target(args: argparse.Namespace) -> Iterator[NodeParameters]:
    """Offer the parameters of the node that the user has named.

    Args:
        args: The parsed arguments.

    Yields:
        Its parameters.

    Raises:
        RuntimeError: There is no such node.
    """
    target = absolute(args.node_name)
    with direct_node(args) as node:
        deadline = time.monotonic() + args.timeout
        while target not in node_names(node, include_hidden=args.include_hidden_nodes):
            if time.monotonic() > deadline or not rclpy.ok():
                raise RuntimeError("Node not found")
            rclpy.spin_once(node, timeout_sec=0.1)
        yield NodeParameters(node, target)


def absolute(name: str) -> str:
    """Return a node's name with its leading slash.

    Args:
        name: The name, with it or without.
    """
    return name if name.startswith("/") else f"/{name}"
