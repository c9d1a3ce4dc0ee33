# SPDX-License-Identifier: Apache-2.0
"""`ros2 topic bw`."""

from __future__ import annotations

import argparse
from collections import deque

import rclpy
from rclpy.qos import qos_profile_sensor_data

from ros2_embedded.cli.arguments import positive_int
from ros2_embedded.cli.direct_node import add_node_arguments, direct_node
from ros2_embedded.cli.graph import topic_class

DEFAULT_WINDOW = 100


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments.

    Args:
        parser: The parser of the verb.
    """
    add_node_arguments(parser)
    parser.add_argument("topic", help="Topic name to monitor for bandwidth utilization")
    parser.add_argument(
        "-w",
        "--window",
        type=positive_int,
        default=DEFAULT_WINDOW,
        help="maximum window size, in # of messages, for calculating rate (default: %(default)d)",
    )


def main(args: argparse.Namespace) -> None:
    """Print the bandwidth of a topic until interrupted.

    Args:
        args: The parsed arguments.
    """
    with direct_node(args) as node:
        kind = topic_class(node, args.topic, wait=True)
        if kind is None:
            return
        clock = node.get_clock()
        received: deque[tuple[int, int]] = deque(maxlen=args.window)

        def on_message(data: bytes) -> None:
            received.append((clock.now().nanoseconds, len(data)))

        def report() -> None:
            text = describe_bandwidth(list(received), clock.now().nanoseconds)
            if text is not None:
                print(text)

        node.create_subscription(kind, args.topic, on_message, qos_profile_sensor_data, raw=True)
        print(f"Subscribed to [{args.topic}]")
        node.create_timer(1.0, report)
        rclpy.spin(node)


def describe_bandwidth(received: list[tuple[int, int]], now: int) -> str | None:
    """Return the two lines that `ros2 topic bw` prints.

    Args:
        received: Arrival time (ns) and size (bytes) of each message of the window.
        now: The present time (ns).

    Returns:
        The text; None if there are too few messages for a rate.
    """
    if len(received) < 2 or now <= received[0][0]:
        return None
    sizes = [size for _, size in received]
    rate = sum(sizes) * 1e9 / (now - received[0][0])
    mean = sum(sizes) / len(sizes)
    texts = [_bytes(value, rate) for value in (rate, mean, min(sizes), max(sizes))]
    return (
        f"{texts[0]}/s from {len(sizes)} messages\n"
        f"\tMessage size mean: {texts[1]} min: {texts[2]} max: {texts[3]}"
    )


def _bytes(value: float, rate: float) -> str:
    """Write all numbers in the unit that suits the rate."""
    if rate < 1000:
        return f"{value:.0f} B"
    if rate < 1_000_000:
        return f"{value / 1000:.2f} KB"
    return f"{value / 1_000_000:.2f} MB"
