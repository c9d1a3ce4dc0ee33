# SPDX-License-Identifier: Apache-2.0
"""`ros2 node info`."""

from __future__ import annotations

import argparse
import sys

from ros2_embedded.cli.direct_node import add_node_arguments, direct_node
from ros2_embedded.cli.graph import node_names
from ros2_embedded.cli.names import is_hidden, split_node_name


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments.

    Args:
        parser: The parser of the verb.
    """
    add_node_arguments(parser)
    parser.add_argument("node_name", help="Node name to request information")
    parser.add_argument(
        "--include-hidden",
        action="store_true",
        help="Display hidden topics and services as well",
    )


def main(args: argparse.Namespace) -> str | None:
    """Print what a node subscribes to, publishes, serves and calls.

    Args:
        args: The parsed arguments.

    Returns:
        The error, None if there is none.
    """
    with direct_node(args) as node:
        count = node_names(node, include_hidden=args.include_hidden).count(args.node_name)
        if count == 0:
            return f"Unable to find node '{args.node_name}'"
        if count > 1:
            print(
                f"There are {count} nodes in the graph with the exact name "
                f'"{args.node_name}". You are seeing information about only one of them.',
                file=sys.stderr,
            )
        name, namespace = split_node_name(args.node_name)
        print(args.node_name)
        for title, ask in (
            ("Subscribers", node.get_subscriber_names_and_types_by_node),
            ("Publishers", node.get_publisher_names_and_types_by_node),
            ("Service Servers", node.get_service_names_and_types_by_node),
            ("Service Clients", node.get_client_names_and_types_by_node),
        ):
            print(f"  {title}:")
            lines = [
                f"    {entity}: {', '.join(types)}"
                for entity, types in ask(name, namespace)
                if args.include_hidden or not is_hidden(entity)
            ]
            print("\n".join(lines))
        # Headings that scripts look for; the embedded runtime has no actions.
        print("  Action Servers:\n\n  Action Clients:\n")
    return None
