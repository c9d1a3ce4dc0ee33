# SPDX-License-Identifier: Apache-2.0
"""`ros2 topic list`."""

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
    parser.add_argument(
        "-t", "--show-types", action="store_true", help="Additionally show the topic type"
    )
    parser.add_argument(
        "-c",
        "--count-topics",
        action="store_true",
        help="Only display the number of topics discovered",
    )
    parser.add_argument(
        "--include-hidden-topics", action="store_true", help="Consider hidden topics as well"
    )
    parser.add_argument(
        "-v", "--verbose", action="store_true", help="List full details about each topic"
    )


def main(args: argparse.Namespace) -> None:
    """Print the topics in use.

    Args:
        args: The parsed arguments.
    """
    with direct_node(args) as node:
        found = topics(node, include_hidden=args.include_hidden_topics)
        if args.verbose:
            publishers = {name: node.count_publishers(name) for name, _ in found}
            subscribers = {name: node.count_subscribers(name) for name, _ in found}
    if args.count_topics:
        print(len(found))
    elif args.verbose:
        _print_counts("Published topics:", "publisher", found, publishers)
        _print_counts("Subscribed topics:", "subscriber", found, subscribers)
    else:
        for name, types in found:
            print(f"{name} [{', '.join(types)}]" if args.show_types else name)


def _print_counts(
    title: str, role: str, found: list[tuple[str, list[str]]], counts: dict[str, int]
) -> None:
    print(title)
    for name, types in found:
        if counts[name]:
            plural = "s" if counts[name] > 1 else ""
            print(f" * {name} [{', '.join(types)}] {counts[name]} {role}{plural}")
    print()
