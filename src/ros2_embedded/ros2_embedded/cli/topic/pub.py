# SPDX-License-Identifier: Apache-2.0
"""`ros2 topic pub`."""

from __future__ import annotations

import argparse
import sys
import time
from typing import Any

import rclpy
import yaml
from rclpy.node import Node
from rclpy.publisher import Publisher

from ros2_embedded.cli.arguments import non_negative_int, positive_float
from ros2_embedded.cli.direct_node import add_node_arguments, direct_node
from ros2_embedded.cli.interfaces import requested_message_class
from ros2_embedded.cli.message_fill import fill_message
from ros2_embedded.cli.qos_options import add_qos_arguments, profile_of

_POLL_SECONDS = 0.1


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments.

    Args:
        parser: The parser of the verb.
    """
    add_node_arguments(parser)
    add_qos_arguments(parser, "publish", "default")
    add = parser.add_argument
    add("topic_name", help="Name of the ROS topic to publish to (e.g. '/chatter')")
    add("message_type", help="Type of the ROS message (e.g. 'std_msgs/String')")
    source = parser.add_mutually_exclusive_group()
    source.add_argument(
        "values", nargs="?", default="{}", help="Values in YAML format (e.g. 'data: Hello World')"
    )
    source.add_argument("--stdin", action="store_true", help="Read values from standard input")
    add("-r", "--rate", metavar="N", type=positive_float, default=1.0, help="Rate in Hz")
    add("-p", "--print", metavar="N", type=int, default=1, help="Only print every N-th message")
    count = parser.add_mutually_exclusive_group()
    count.add_argument("-1", "--once", action="store_true", help="Publish one message and exit")
    count.add_argument(
        "-t", "--times", type=non_negative_int, default=0, help="Publish so many times and exit"
    )
    add(
        *("-w", "--wait-matching-subscriptions"),
        type=non_negative_int,
        help="Wait for so many subscriptions; 1 with --once or --times, otherwise 0",
    )
    add("--max-wait-time-secs", type=positive_float, help="Wait no longer for subscriptions")
    add("--keep-alive", metavar="N", type=positive_float, default=0.1, help="Linger N seconds")
    add("-n", "--node-name", help="Name of the created publishing node")


def main(args: argparse.Namespace) -> str | None:
    """Publish a message, once, several times or until interrupted.

    Args:
        args: The parsed arguments.

    Returns:
        The error, None if there is none.
    """
    times = 1 if args.once else args.times
    wanted = args.wait_matching_subscriptions
    if wanted is None:
        wanted = int(times != 0)
    if wanted == 0 and args.max_wait_time_secs is not None:
        return (
            "--max-wait-time-secs option is only effective"
            " with --wait-matching-subscriptions, --once or --times"
        )
    kind = requested_message_class(args.message_type)
    try:
        values = yaml.safe_load(sys.stdin.read() if args.stdin else args.values)
    except yaml.YAMLError as error:
        return f"The passed value is not YAML: {error}"
    if not isinstance(values, dict):
        return "The passed value needs to be a dictionary in YAML format"
    message = kind()
    try:
        stamps = fill_message(message, values)
    except (AttributeError, TypeError, ValueError, AssertionError, OverflowError) as error:
        return f"Failed to populate field: {error}"

    with direct_node(args, name=args.node_name) as node:
        publisher = node.create_publisher(kind, args.topic_name, profile_of(args))
        failure = _wait_for_subscriptions(publisher, wanted, args.max_wait_time_secs)
        if failure is not None:
            return failure
        print("publisher: beginning loop")
        _publish(node, publisher, message, stamps, times=times, args=args)
        # What has just been written still has to leave.
        time.sleep(args.keep_alive)
    return None


def _wait_for_subscriptions(publisher: Publisher, wanted: int, limit: float | None) -> str | None:
    deadline = None if limit is None else time.monotonic() + limit
    polls = 0
    while (found := publisher.get_subscription_count()) < wanted:
        if polls % 10 == 0:
            print(f"Waiting for at least {wanted} matching subscription(s)...")
        if deadline is not None and time.monotonic() >= deadline:
            return (
                f"Timed out waiting for subscribers: Expected {wanted} subscribers"
                f" but only got {found} subscribers"
            )
        polls += 1
        time.sleep(_POLL_SECONDS)
    return None


def _publish(
    node: Node,
    publisher: Publisher,
    message: Any,
    stamps: list[Any],
    *,
    times: int,
    args: argparse.Namespace,
) -> None:
    count = 0

    def publish() -> None:
        nonlocal count
        now = node.get_clock().now().to_msg()
        for set_stamp in stamps:
            set_stamp(now)
        count += 1
        if args.print and count % args.print == 0:
            print(f"publishing #{count}: {message!r}\n")
        publisher.publish(message)

    publish()
    if times == 1:
        return
    node.create_timer(1.0 / args.rate, publish)
    while rclpy.ok() and (times == 0 or count < times):
        rclpy.spin_once(node)
