# SPDX-License-Identifier: Apache-2.0
"""`ros2 param list`."""

from __future__ import annotations

import argparse

from ros2_embedded.cli.arguments import pattern
from ros2_embedded.cli.direct_node import add_node_arguments, direct_node
from ros2_embedded.cli.graph import node_names
from ros2_embedded.cli.param.node_parameters import NodeParameters, absolute, type_name


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments.

    Args:
        parser: The parser of the verb.
    """
    add_node_arguments(parser)
    add = parser.add_argument
    add("node_name", nargs="?", help="Name of the ROS node; all nodes without it")
    add("--filter", type=pattern, help="Only parameters matching this expression")
    add("--include-hidden-nodes", action="store_true", help="Consider hidden nodes as well")
    add("--param-prefixes", nargs="+", default=[], help="Only parameters with these prefixes")
    add("--param-type", action="store_true", help="Print parameter types with the names")


def main(args: argparse.Namespace) -> str | None:
    """Print the names of the parameters of one node, or of all.

    Args:
        args: The parsed arguments.

    Returns:
        The error, None if there is none.
    """
    with direct_node(args) as node:
        targets = sorted(set(node_names(node, include_hidden=args.include_hidden_nodes)))
        if args.node_name is not None:
            target = absolute(args.node_name)
            if target not in targets:
                return "Node not found"
            targets = [target]
        for target in targets:
            parameters = NodeParameters(node, target)
            try:
                names = parameters.names(args.param_prefixes)
            except RuntimeError as error:
                # Nodes may have their parameter services turned off.
                print(error)
                continue
            if args.filter is not None:
                names = [name for name in names if args.filter.match(name)]
            if args.node_name is None and names:
                print(f"{target}:")
            _print(names, parameters, with_type=args.param_type)
    return None


def _print(names: list[str], parameters: NodeParameters, *, with_type: bool) -> None:
    if not with_type:
        for name in names:
            print(f"  {name}")
        return
    for descriptor in parameters.descriptors(names):
        print(f"  {descriptor.name} (type: {type_name(descriptor.type)})")
