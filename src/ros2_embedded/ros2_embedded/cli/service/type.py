# SPDX-License-Identifier: Apache-2.0
"""`ros2 service type`."""

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
    parser.add_argument("service_name", help="Name of the ROS service (e.g. '/talker/get_loggers')")


def main(args: argparse.Namespace) -> int:
    """Print the types of a service.

    Args:
        args: The parsed arguments.

    Returns:
        0, or 1 if nobody offers the service.
    """
    with direct_node(args) as node:
        types = dict(services(node, include_hidden=True)).get(args.service_name, [])
    for name in types:
        print(name)
    return 0 if types else 1
