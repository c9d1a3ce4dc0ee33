# SPDX-License-Identifier: Apache-2.0
"""`ros2 topic info`."""

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
    parser.add_argument("topic_name", help="Name of the ROS topic to get info (e.g. '/chatter')")
    parser.add_argument(
        "-v",
        "--verbose",
        action="store_true",
        help="Print node, type hash, GUID and QoS profile of each publisher and subscription",
    )


def main(args: argparse.Namespace) -> str | None:
    """Print type and endpoints of a topic.

    Args:
        args: The parsed arguments.

    Returns:
        The error, None if there is none.
    """
    name = args.topic_name
    end = "\n\n" if args.verbose else "\n"
    with direct_node(args) as node:
        types = dict(topics(node, include_hidden=True)).get(name)
        if types is None:
            return f"Unknown topic '{name}'"
        print(f"Type: {types[0] if len(types) == 1 else types}", end=end)
        print(f"Publisher count: {node.count_publishers(name)}", end=end)
        if args.verbose:
            for publisher in node.get_publishers_info_by_topic(name):
                print(publisher, end=end)
        print(f"Subscription count: {node.count_subscribers(name)}", end=end)
        if args.verbose:
            for subscription in node.get_subscriptions_info_by_topic(name):
                print(subscription, end=end)
    return None
