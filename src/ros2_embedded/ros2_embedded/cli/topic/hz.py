# SPDX-License-Identifier: Apache-2.0
"""`ros2 topic hz`."""

from __future__ import annotations

import argparse
from typing import Any

import rclpy
from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from rclpy.qos import qos_profile_sensor_data

from ros2_embedded.cli.arguments import positive_int
from ros2_embedded.cli.direct_node import add_node_arguments, direct_node
from ros2_embedded.cli.graph import topic_class
from ros2_embedded.cli.topic.rate_meter import RateMeter

DEFAULT_WINDOW = 10_000


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments.

    Args:
        parser: The parser of the verb.
    """
    add_node_arguments(parser)
    parser.add_argument("topic_name", help="Name of the ROS topic to listen to (e.g. '/chatter')")
    parser.add_argument(
        "-w",
        "--window",
        type=positive_int,
        default=DEFAULT_WINDOW,
        help="window size, in # of messages, for calculating rate (default: %(default)d)",
    )
    parser.add_argument(
        "--wall-time",
        action="store_true",
        help="use wall time, which helps when clock is not published during simulation",
    )


def main(args: argparse.Namespace) -> None:
    """Print the rate of a topic until interrupted.

    Args:
        args: The parsed arguments.
    """
    with direct_node(args) as node:
        kind = topic_class(node, args.topic_name, wait=True)
        if kind is None:
            return
        clock = Clock(clock_type=ClockType.SYSTEM_TIME) if args.wall_time else node.get_clock()
        meter = RateMeter(args.window)

        def on_message(_message: Any) -> None:
            now = clock.now().nanoseconds
            # Simulated time stands at zero until the first clock message.
            if now:
                meter.record(now)

        # Only arrivals count, so nothing needs to be deserialised.
        node.create_subscription(
            kind, args.topic_name, on_message, qos_profile_sensor_data, raw=True
        )
        while rclpy.ok():
            rclpy.spin_once(node)
            rate = meter.report()
            if rate is not None:
                print(rate)
