# SPDX-License-Identifier: Apache-2.0
"""`ros2 bag record`."""

from __future__ import annotations

import argparse
import sqlite3
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions

from ros2_embedded.cli.arguments import pattern, positive_int
from ros2_embedded.cli.bag.recorder import Recorder
from ros2_embedded.cli.bag.recording import STORAGES, Recording
from ros2_embedded.cli.bag.selection import TopicSelection
from ros2_embedded.cli.bag.stopping import StopRequest, stop_on_signals
from ros2_embedded.cli.graph import full_topic_name

_CHECKPOINT_SECONDS = 1.0
_WAIT_SECONDS = 0.1
_DRAIN_SECONDS = 5.0
_IDLE_ROUNDS, _IDLE_SECONDS = 5, 0.02


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments.

    Args:
        parser: The parser of the verb.
    """
    add = parser.add_argument
    add("-o", "--output", type=Path, help="Directory to create; by default named after the time")
    add("-s", "--storage", default="mcap", choices=sorted(STORAGES), help="Storage identifier")
    topics = parser.add_mutually_exclusive_group()
    topics.add_argument("topics_positional", nargs="*", default=[], metavar="Topic")
    topics.add_argument("--topics", nargs="+", default=[], metavar="Topic", help="What to record")
    add("--topic-types", nargs="+", default=[], metavar="TopicType", help="Types to record")
    add("-a", "--all", action="store_true", help="Record all topics (exclude hidden topics)")
    add("--all-topics", action="store_true", help="Record all topics (exclude hidden topics)")
    add("-e", "--regex", type=pattern, help="Record topics containing this expression")
    add("--exclude-regex", type=pattern, help="Exclude topics containing this expression")
    add("--exclude-topics", nargs="+", default=[], metavar="Topic", help="Topics to exclude")
    add(
        "--exclude-topic-types", nargs="+", default=[], metavar="TopicType", help="Types to exclude"
    )
    add("--include-unpublished-topics", action="store_true", help="Subscribe without a publisher")
    add("--include-hidden-topics", action="store_true", help="Record hidden topics as well")
    add("--no-discovery", action="store_true", help="Only topics present at startup are recorded")
    add(
        *("-p", "--polling-interval"),
        type=positive_int,
        default=100,
        help="Time in ms between queries for new topics (default: %(default)d)",
    )
    add("--node-name", default="rosbag2_recorder", help="Node name (default: %(default)s)")
    add("--custom-data", nargs="*", default=[], metavar="KEY=VALUE", help="Entries of the metadata")
    add("--disable-keyboard-controls", action="store_true", help="Accepted; there are none")


def main(args: argparse.Namespace) -> str | None:
    """Record until SIGINT or SIGTERM, then complete the bag.

    Args:
        args: The parsed arguments.

    Returns:
        The error, None if there is none.
    """
    path = args.output or Path(time.strftime("rosbag2_%Y_%m_%d-%H_%M_%S"))
    failure = _check(args, path)
    if failure is not None:
        return f"[ERROR] [ros2bag]: {failure}"
    with stop_on_signals() as stop, _recorder_node(args.node_name) as node:
        selection = _selection(args, node)
        try:
            with Recording(path, args.storage, _custom_data(args.custom_data)) as recording:
                recorder = Recorder(
                    node,
                    recording,
                    selection,
                    include_unpublished=args.include_unpublished_topics,
                )
                _record(node, recorder, recording, args, stop)
        except (OSError, sqlite3.Error) as error:
            return f"[ERROR] [ros2bag]: Could not write bag '{path}': {error}"
        node.get_logger().info(
            f"Recording stopped: {recording.messages} messages on {recording.topics} topics "
            f"in '{path}'"
        )
    return None


@contextmanager
def _recorder_node(name: str) -> Iterator[Node]:
    # The handlers of rclpy would end the context while the recorder still writes.
    rclpy.init(args=[], signal_handler_options=SignalHandlerOptions.NO)
    try:
        yield rclpy.create_node(name, start_parameter_services=False)
    finally:
        rclpy.try_shutdown()


def _record(
    node: Node,
    recorder: Recorder,
    recording: Recording,
    args: argparse.Namespace,
    stop: StopRequest,
) -> None:
    node.get_logger().info("Listening for topics...")
    recorder.discover()
    timers = [node.create_timer(_CHECKPOINT_SECONDS, recording.checkpoint)]
    if not args.no_discovery:
        timers.append(node.create_timer(args.polling_interval / 1000, recorder.discover))
    node.get_logger().info("Recording...")
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    while not stop:
        executor.spin_once(timeout_sec=_WAIT_SECONDS)
    for timer in timers:
        node.destroy_timer(timer)
    _drain(executor, recording)
    executor.shutdown()


def _drain(executor: SingleThreadedExecutor, recording: Recording) -> None:
    """Write what has arrived before the end was asked for; publishers know it as delivered."""
    deadline = time.monotonic() + _DRAIN_SECONDS
    idle = 0
    # A round may be spent on something else than a message, or come before the reader has been woken.
    while idle < _IDLE_ROUNDS and time.monotonic() < deadline:
        written = recording.messages
        executor.spin_once(timeout_sec=_IDLE_SECONDS)
        idle = idle + 1 if written == recording.messages else 0


def _check(args: argparse.Namespace, path: Path) -> str | None:
    everything = args.all or args.all_topics
    by_rule = everything or args.topic_types or args.regex
    if not (by_rule or args.topics or args.topics_positional):
        return (
            "Need to specify at least one option out of --all, --all-topics, --topics, "
            "--topic-types or --regex"
        )
    for option in ("exclude_regex", "exclude_topics", "exclude_topic_types"):
        if getattr(args, option) and not by_rule:
            name = option.replace("_", "-")
            return (
                f"--{name} argument requires either --all, --all-topics, --topic-types or --regex"
            )
    if any("=" not in entry for entry in args.custom_data):
        return "--custom-data takes KEY=VALUE"
    if path.exists():
        return f"Output folder '{path}' already exists."
    return None


def _selection(args: argparse.Namespace, node: Node) -> TopicSelection:
    wanted = [*args.topics, *args.topics_positional]
    return TopicSelection(
        everything=args.all or args.all_topics,
        topics=frozenset(full_topic_name(node, topic) for topic in wanted),
        types=frozenset(args.topic_types),
        pattern=args.regex,
        excluded_topics=frozenset(full_topic_name(node, topic) for topic in args.exclude_topics),
        excluded_types=frozenset(args.exclude_topic_types),
        excluded_pattern=args.exclude_regex,
        hidden=args.include_hidden_topics,
    )


def _custom_data(entries: list[str]) -> dict[str, str]:
    return dict(entry.split("=", 1) for entry in entries)
