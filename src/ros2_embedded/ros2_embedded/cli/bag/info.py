# SPDX-License-Identifier: Apache-2.0
"""`ros2 bag info`."""

from __future__ import annotations

import argparse

from ros2_embedded.cli.bag.opening import add_bag_arguments, open_bag
from ros2_embedded.cli.bag.summary import BagSummary


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments.

    Args:
        parser: The parser of the verb.
    """
    add_bag_arguments(parser)
    parser.add_argument("-t", "--topic-name", action="store_true", help="Only display topic names")


def main(args: argparse.Namespace) -> None:
    """Print what a bag holds.

    Args:
        args: The parsed arguments.

    Raises:
        RuntimeError: The bag cannot be read.
    """
    with open_bag(args.bag_path) as reader:
        summary = BagSummary.of(reader)
    if args.topic_name:
        for topic in summary.topics:
            print(topic.name)
    else:
        print(summary)
