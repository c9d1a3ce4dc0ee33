# SPDX-License-Identifier: Apache-2.0
"""The hidden node through which a verb looks at the graph."""

from __future__ import annotations

import argparse
import os
from collections.abc import Iterator
from contextlib import contextmanager

import rclpy
from rclpy.node import Node
from rclpy.parameter import Parameter

DISCOVERY_SECONDS = 0.5


def add_node_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments that every verb with a node takes.

    Args:
        parser: The parser of the verb.
    """
    parser.add_argument(
        "--spin-time",
        type=float,
        default=DISCOVERY_SECONDS,
        help="Spin time in seconds to wait for discovery",
    )
    parser.add_argument(
        "-s", "--use-sim-time", action="store_true", help="Enable ROS simulation time"
    )
    # There is no daemon to turn off; scripts that ask for none are right.
    parser.add_argument("--no-daemon", action="store_true", help="Accepted; there is no daemon")


@contextmanager
def direct_node(args: argparse.Namespace, *, name: str | None = None) -> Iterator[Node]:
    """Offer a node that has had the time to discover its peers.

    Args:
        args: The parsed arguments, those of `add_node_arguments` among them.
        name: The node's name; a hidden one if None.

    Yields:
        The node; it and the context end with the block.
    """
    rclpy.init(args=[])
    try:
        node = rclpy.create_node(
            name or f"_ros2cli_{os.getpid()}",
            start_parameter_services=False,
            parameter_overrides=[Parameter("use_sim_time", value=args.use_sim_time)],
        )
        try:
            _spin_for(node, args.spin_time)
            yield node
        finally:
            node.destroy_node()
    finally:
        rclpy.try_shutdown()


def _spin_for(node: Node, seconds: float) -> None:
    if seconds <= 0:
        return
    elapsed = False

    def stop() -> None:
        nonlocal elapsed
        elapsed = True

    timer = node.create_timer(seconds, stop)
    while rclpy.ok() and not elapsed:
        rclpy.spin_once(node)
    node.destroy_timer(timer)
