# SPDX-License-Identifier: Apache-2.0
"""`ros2 topic type`."""

from __future__ import annotations

import argparse

from ros2_embedded.cli.direct_node import add_node_arguments, direct_node
from ros2_embedded.cli.graph import topics


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments.

    Args:
        parser: The parser of the verb.
    """
    add_node_arguments(parser)
    parser.add_argument("topic_name", help="Name of the ROS topic to get type (e.g. '/chatter')")


def main(args: argparse.Namespace) -> int:
    """Print the types of a topic.

    Args:
        args: The parsed arguments.

    Returns:
        0, or 1 if nobody uses the topic.
    """
    with direct_node(args) as node:
        found = dict(topics(node, include_hidden=args.include_hidden_topics))
    types = found.get(args.topic_name, [])
    for name in types:
        print(name)
    return 0 if types else 1
