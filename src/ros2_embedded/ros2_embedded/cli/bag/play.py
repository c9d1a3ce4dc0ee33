# SPDX-License-Identifier: Apache-2.0
"""`ros2 bag play`."""

from __future__ import annotations

import argparse
import time
from collections.abc import Iterator
from contextlib import contextmanager

import rclpy
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions
from rosbags.interfaces import Connection
from rosbags.rosbag2 import Reader

from ros2_embedded.cli.arguments import (
    non_negative_float,
    non_negative_int,
    pattern,
    positive_float,
)
from ros2_embedded.cli.bag.opening import add_bag_arguments, open_bag
from ros2_embedded.cli.bag.player import Playback, Player
from ros2_embedded.cli.bag.selection import TopicSelection
from ros2_embedded.cli.bag.stopping import stop_on_signals

_CLOCK_HERTZ = 40.0


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments.

    Args:
        parser: The parser of the verb.
    """
    add_bag_arguments(parser)
    add = parser.add_argument
    add("-r", "--rate", type=positive_float, default=1.0, help="Seconds of the bag a second")
    add("--topics", nargs="+", default=[], metavar="topic", help="Topics to play")
    add("--exclude-topics", nargs="+", default=[], metavar="topic", help="Topics not to play")
    add("-e", "--regex", type=pattern, help="Play only topics that contain this expression")
    add(
        "-x",
        "--exclude-regex",
        type=pattern,
        help="Do not play topics that contain this expression",
    )
    add("-l", "--loop", action="store_true", help="Start again at the end, without limit")
    add("-m", "--remap", nargs="+", default=[], metavar="old:=new", help="Topics to rename")
    add(
        "--clock",
        type=positive_float,
        nargs="?",
        const=_CLOCK_HERTZ,
        metavar="HZ",
        help="Publish the time of the bag to /clock (default: %(const)g Hz); the bag's own "
        "/clock is left out",
    )
    add(
        *("-d", "--delay"),
        type=non_negative_float,
        default=0.0,
        help="Sleep before play (each loop), in seconds. The publishers exist already, so this "
        "is the time that volatile subscribers have to find them",
    )
    add("--start-offset", type=non_negative_float, default=0.0, help="Seconds to skip")
    add("--playback-duration", type=float, default=-1.0, help="Seconds of the bag to play")
    add(
        "--wait-for-all-acked",
        type=non_negative_int,
        metavar="TIMEOUT",
        help="Wait at the end until all messages are acknowledged, so many ms; 0 is no limit",
    )
    add("--read-ahead-queue-size", type=int, help="Accepted; reading needs no queue")
    add("--disable-keyboard-controls", action="store_true", help="Accepted; there are none")


def main(args: argparse.Namespace) -> None:
    """Play a bag.

    Args:
        args: The parsed arguments.

    Raises:
        RuntimeError: The bag cannot be read.
    """
    with (
        open_bag(args.bag_path) as reader,
        stop_on_signals() as stop,
        _player_node(args.remap) as node,
    ):
        player = Player(node, reader, _selected(args, reader.connections))
        if args.clock is not None:
            player.start_clock()
        playback = _playback(args, reader)
        while True:
            stop.sleep_until(time.monotonic_ns() + round(args.delay * 1e9))
            player.play(playback, stop)
            if stop or not args.loop:
                break
        if args.wait_for_all_acked is not None and not stop:
            player.wait_for_all_acked(args.wait_for_all_acked)


@contextmanager
def _player_node(remaps: list[str]) -> Iterator[Node]:
    rules = [word for remap in remaps for word in ("-r", remap)]
    rclpy.init(
        args=["--ros-args", *rules] if rules else [],
        signal_handler_options=SignalHandlerOptions.NO,
    )
    try:
        yield rclpy.create_node("rosbag2_player", start_parameter_services=False)
    finally:
        rclpy.try_shutdown()


def _selected(args: argparse.Namespace, connections: list[Connection]) -> list[Connection]:
    selection = TopicSelection(
        everything=not (args.topics or args.regex),
        topics=frozenset(map(_absolute, args.topics)),
        pattern=args.regex,
        excluded_topics=frozenset(map(_absolute, args.exclude_topics)),
        excluded_pattern=args.exclude_regex,
        hidden=True,
    )
    return [
        connection
        for connection in connections
        if selection.takes(connection.topic, connection.msgtype)
        # Two sources of time would make it jump.
        and not (connection.topic == "/clock" and args.clock is not None)
    ]


def _playback(args: argparse.Namespace, reader: Reader) -> Playback:
    start = reader.start_time + round(args.start_offset * 1e9)
    end = reader.end_time
    if args.playback_duration >= 0:
        end = min(end, start + round(args.playback_duration * 1e9))
    return Playback(
        rate=args.rate,
        start=start,
        end=end,
        clock_period=None if args.clock is None else round(1e9 / args.clock),
    )


def _absolute(topic: str) -> str:
    return topic if topic.startswith("/") else f"/{topic}"
