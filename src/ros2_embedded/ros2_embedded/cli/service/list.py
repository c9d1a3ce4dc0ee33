# SPDX-License-Identifier: Apache-2.0
"""`ros2 service list`."""

from __future__ import annotations

import argparse

from ros2_embedded.cli.direct_node import add_node_arguments, direct_node
from ros2_embedded.cli.graph import services


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments.

    Args:
        parser: The parser of the verb.
    """
    add_node_arguments(parser)
    add = parser.add_argument
    add("-t", "--show-types", action="store_true", help="Additionally show the service type")
    add("-c", "--count-services", action="store_true", help="Only display the number of services")
    add("--include-hidden-services", action="store_true", help="Consider hidden services as well")


def main(args: argparse.Namespace) -> None:
    """Print the services on offer.

    Args:
        args: The parsed arguments.
    """
    with direct_node(args) as node:
        found = services(node, include_hidden=args.include_hidden_services)
    if args.count_services:
        print(len(found))
        return
    for name, types in found:
        print(f"{name} [{', '.join(types)}]" if args.show_types else name)
